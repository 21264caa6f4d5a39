/* The number of threads of the simulation. Any number gives the same bits. */
#ifndef SB_APP_TEAM_H
#define SB_APP_TEAM_H

#include "app/check/warnings.h"

/* So many processes share the cores that this one may use; 1 until it is called. */
void sb_team_share(int processes);

/* Sets the number of threads. Call it once, before the first parallel loop. `threads` is the requested number; 0: one
   per core that this process may use. The number is smaller when the system does not allow so many threads in addition
   to those of the scene's outputs, because OpenMP would end the process. */
void sb_team_choose(const sb_scene *scene, int threads);

/* Number of cores that this process may use, by its affinity and the quota of its control group, divided by the
   processes that share them. At least 1. */
int sb_team_cores(void);

/* Warns when the system allowed fewer threads than requested, and when there are more threads than cores. */
void sb_team_warnings(sb_warning_visit *visit, void *context);

#endif
