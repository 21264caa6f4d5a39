/* Runs a pass over one group of particles after the other, in parallel. */
#ifndef SB_SIM_GROUPS_H
#define SB_SIM_GROUPS_H

#include "sim/search/around.h"

enum { SB_GROUPS_AT_A_TIME = 8 }; /* per unit of work: 600 particles where the water is deep */

/* A pass over one group. arguments: those of the pass. */
typedef void sb_group_pass(sb_sim *sim, const sb_group *group, const void *arguments);

static inline void sb_each_group(sb_sim *sim, sb_group_pass *pass, const void *arguments)
{
    const size_t groups = sim->groups.count;
#pragma omp parallel for schedule(dynamic, SB_GROUPS_AT_A_TIME)
    for (size_t g = 0; g < groups; g++) pass(sim, &sim->groups.group[g], arguments);
}

#endif
