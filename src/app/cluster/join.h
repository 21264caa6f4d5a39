/* How processes that mpirun or srun has started become the ranks of one run. */
#ifndef SB_APP_CLUSTER_JOIN_H
#define SB_APP_CLUSTER_JOIN_H

#include "app/options.h"
#include "base/ranks.h"

/* The command line was read with `own` (and *error). Joins the other processes, also when this one refuses its command
   line: rank 0 then says why. *ranks: NULL if this one is alone or could not join; it then speaks for itself. From now
   on this process ends with one line and exit status 2 when another rank ends or is not heard of. */
sb_status sb_cluster_join(const sb_options *options, sb_status own, sb_ranks **ranks, sb_error *error);

/* The scene was read with `own` (and *error). Checks that all ranks have read the same scene with the same options, and
   are of the same build on processors with the same instructions; of the latter rank 0 only warns with --mixed. The
   result is the same in all ranks; *error names the first rank that differs. */
sb_status sb_cluster_compare(sb_ranks *ranks, const sb_options *options, sb_status own, sb_error *error);

#endif
