/* Ranks as threads of one process, for tests and to find errors: the same program, without processes. */
#ifndef SB_BASE_RANKS_THREADS_H
#define SB_BASE_RANKS_THREADS_H

#include "base/ranks.h"
#include "base/status.h"

/* The work of one rank, on a thread of its own. */
typedef void sb_rank_work(sb_ranks *ranks, void *context);

/* Runs `work` in `count` ranks and returns when all have returned. disturb: a seed by which messages are delayed and
   received in a random order; 0: not. SB_FAILED without memory or threads; then no rank has begun. A rank that waits
   longer than a minute, or gets a parcel of another size than it expects, ends the process by abort(). */
sb_status sb_ranks_threads_run(int count, uint64_t disturb, sb_rank_work *work, void *context, sb_error *error);

#endif
