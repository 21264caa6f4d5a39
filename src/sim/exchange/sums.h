/* Sums over all particles that have the same bits however the particles are divided among threads or domains. Terms are
   summed within a group in the order of its particles, which is the same wherever the group lies, and exactly across
   groups. */
#ifndef SB_SIM_SUMS_H
#define SB_SIM_SUMS_H

#include "base/exact.h"
#include "sim/simulation.h"

enum { SB_SUMS_MAX = 8 };

/* Sums over the particles of one group, into terms, which are 0 before. Returns a value whose maximum over all groups
   is wanted. */
typedef double sb_group_terms(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX]);

/* total[k]: sum over all groups of all domains of terms[k], k < count <= SB_SUMS_MAX; NaN where a term is no finite
   number. Returns the largest value that `of` returned in any domain, -INFINITY without groups. */
double sb_sum_groups(sb_sim *sim, size_t count, sb_group_terms *of, double *total);

/* The same in two parts, of several domains: the sums are on their way in between (sb_exchange.sum_begin). */
void sb_sum_groups_begin(sb_sim *sim, size_t count, sb_group_terms *of);
double sb_sum_groups_end(sb_sim *sim, size_t count, double *total);

/* Adds `count` sums of one thread to those of all. Called in a parallel region. */
void sb_sums_merge(sb_exact *total, const sb_exact *own, size_t count);

#endif
