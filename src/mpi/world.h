/* The processes of one run that mpirun or srun has started: its ranks. Rank 0 leads: it gives the orders that the
   others follow. All functions but sb_world_join need the ranks that sb_world_join gave, and the thread that called it.
   Without MPI in this build only a process on its own can join. */
#ifndef SB_MPI_WORLD_H
#define SB_MPI_WORLD_H

#include "base/ranks.h"
#include "base/status.h"

#include <stddef.h>

/* Prints the line, calls sb_world_abort and does not return. Called when a rank has ended, has failed alone, or is not
   heard of until the deadline. */
typedef void sb_world_fatal(const char *line);

/* Joins the other processes. *ranks: NULL if this process is alone; no MPI is called without a starter. deadline: s
   that this rank waits for another one, within an order or at the begin and the end of MPI, before the run ends.
   SB_FAILED if the system refuses it, or if the starter tells of several processes and there is no MPI in this build,
   or MPI finds only this one. */
sb_status sb_world_join(double deadline, sb_world_fatal *fatal, sb_ranks **ranks, sb_error *error);
/* Ends MPI and frees *ranks. All ranks call it at their end; it waits for them without using the processor. NULL has no
   effect. */
void sb_world_leave(sb_ranks *ranks);
/* Ends all ranks; the exit status is 2. It returns, or ends this process after five seconds, only if MPI cannot. */
void sb_world_abort(sb_ranks *ranks);

/* The host of a rank; valid until sb_world_leave. */
const char *sb_world_host(const sb_ranks *ranks, int rank);
/* Number of hosts. */
int sb_world_hosts(const sb_ranks *ranks);
/* Number of ranks, this one included, that may use exactly the same cores as this one. */
int sb_world_sharing(const sb_ranks *ranks);

/* ---- orders ---- */

/* Rank 0 gives the others an order of `size` bytes, the same size each time. */
void sb_world_order(sb_ranks *ranks, const void *order, size_t size);
/* Another rank waits for the next order, without limit. */
void sb_world_await(sb_ranks *ranks, void *order, size_t size);

/* What all ranks did together has ended in this rank with `own`. Returns SB_OK if in all; else the status and *error of
   the first rank in which it has not, with its name unless all have failed. All ranks call it. */
sb_status sb_world_agree(sb_ranks *ranks, sb_status own, sb_error *error);

/* The order has failed in this rank, as it should in all ranks, which do not agree on it. If it has not in the others
   within five seconds, all ranks end with this reason. Rank 0 waits for the others. */
void sb_world_failed(sb_ranks *ranks, const sb_error *reason);

/* Another rank tells rank 0 that it has received this signal. */
void sb_world_tell_signal(sb_ranks *ranks, int signal);
/* In rank 0: a signal that another rank has told, or 0. It costs no message. */
int sb_world_signal_told(sb_ranks *ranks);

#endif
