/* What the environment says about the program that has started this process. */
#ifndef SB_MPI_STARTER_H
#define SB_MPI_STARTER_H

#include <stdbool.h>

/* Whether a starter of MPI programs, as mpirun, has started this process. */
bool sb_world_started(void);
/* The number of processes that it has started; 1 also if it does not tell; 0: there is no such starter. */
int sb_world_started_count(void);
/* The rank that it gives this process; 0 if there is none or it does not tell. */
int sb_world_started_as(void);

#endif
