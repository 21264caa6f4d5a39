/* How many threads the simulation gets. Results are the same bits for any number of them. */
#ifndef SB_APP_TEAM_H
#define SB_APP_TEAM_H

#include "app/warnings.h"

/* Once, before the first parallel loop: `threads` as asked for, 0 for one on each core that this process may use; fewer
   where the system does not allow so many beside those that the scene's outputs need, for OpenMP would end the process.
 */
void sb_team_choose(const sb_scene *scene, int threads);

/* Cores that this process may use: of the machine, by its affinity, by the quota of its control group. At least 1. */
int sb_team_cores(void);

/* Of threads that the system did not allow, and of more threads than cores. */
void sb_team_warnings(sb_warning_visit *visit, void *context);

#endif
