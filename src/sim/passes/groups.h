/* Runs a pass over one group of particles after the other, in parallel. While values of other domains are on their way
   (sb_refresh_begin), the groups that read none of them come first. */
#ifndef SB_SIM_GROUPS_H
#define SB_SIM_GROUPS_H

#include "sim/exchange/exchange.h"
#include "sim/search/around.h"

#include <omp.h>

/* Groups per unit of work: 600 particles where the water is deep, half a tenth of a millisecond of a pass of the
   pressure. Messages are looked after once per unit, in a microsecond. */
enum { SB_GROUPS_AT_A_TIME = 8 };

/* A pass over one group. arguments: those of the pass. */
typedef void sb_group_pass(sb_sim *sim, const sb_group *group, const void *arguments);

/* The groups that read no ghosts, while messages move; then, when they have come, the others. */
static inline void sb_each_group_apart(sb_sim *sim, sb_group_pass *pass, const void *arguments)
{
    const sb_groups *g = &sim->groups;
    const size_t groups = g->count, inner = g->inner, done = sim->work.groups_ahead;
    sim->work.groups_ahead = 0;
#pragma omp parallel for schedule(dynamic, SB_GROUPS_AT_A_TIME)
    for (size_t k = done; k < inner; k++) {
        if (k % SB_GROUPS_AT_A_TIME == 0 && omp_get_thread_num() == 0) sim->exchange->progress(sim);
        pass(sim, &g->group[g->order[k]], arguments);
    }
    sim->exchange->land(sim);
#pragma omp parallel for schedule(dynamic, SB_GROUPS_AT_A_TIME)
    for (size_t k = inner; k < groups; k++) pass(sim, &g->group[g->order[k]], arguments);
}

/* Groups that read no ghosts, while sums over all domains are on their way, and no longer. Their number is left in
   sim->work.groups_ahead: the next pass begins after them. */
static inline void sb_each_group_ahead(sb_sim *sim, sb_group_pass *pass, const void *arguments)
{
    const sb_groups *g = &sim->groups;
    const size_t unit = SB_GROUPS_AT_A_TIME * (size_t)omp_get_max_threads();
    size_t done = 0;
    while (done < g->inner && !sim->exchange->sum_arrived(sim)) {
        const size_t end = done + unit < g->inner ? done + unit : g->inner;
#pragma omp parallel for schedule(dynamic, 1)
        for (size_t k = done; k < end; k++) pass(sim, &g->group[g->order[k]], arguments);
        done = end;
    }
    sim->work.groups_ahead = done;
}

static inline void sb_each_group(sb_sim *sim, sb_group_pass *pass, const void *arguments)
{
    if (sim->exchange->under_way && sim->exchange->under_way(sim)) {
        sb_each_group_apart(sim, pass, arguments);
        return;
    }
    if (sim->exchange->sum_under_way && sim->exchange->sum_under_way(sim)) {
        sb_each_group_ahead(sim, pass, arguments);
        return;
    }
    const size_t groups = sim->groups.count;
#pragma omp parallel for schedule(dynamic, SB_GROUPS_AT_A_TIME)
    for (size_t g = 0; g < groups; g++) pass(sim, &sim->groups.group[g], arguments);
}

#endif
