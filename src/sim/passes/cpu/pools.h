/* The pools that hold the lists of all groups. Threads append to them the lists that they have made; the place in a
   pool depends on timing, the contents do not. */
#ifndef SB_SIM_CPU_POOLS_H
#define SB_SIM_CPU_POOLS_H

#include "sim/passes/cpu/lists.h"

enum { SB_POOL_FOURS, SB_POOL_WALLS, SB_POOL_EDGES, SB_POOL_RUNS, SB_POOL_IMAGES, SB_POOL_PLANES, SB_POOLS };

/* Empties the pools and keeps their memory. */
void sb_pools_clear(sb_sim *sim);

/* Copies the lists to the ends of the pools, and empties `lists`. at: where each begins in its pool. Threads may call
   it at the same time. Returns false if a pool is too small: the sizes needed are counted, but lists are lost. */
bool sb_pools_append(sb_sim *sim, sb_list_builder *lists, size_t at[SB_POOLS]);

/* Enlarges the pools that were too small; their contents are lost. SB_FAILED: they would need more entries than their
   indices have. */
sb_status sb_pools_enlarge(sb_sim *sim, sb_error *error);

#endif
