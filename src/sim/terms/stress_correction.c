#include "sim/terms/stress_correction.h"

#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/sea/strip.h"
#include "sim/step/ledger.h"
#include "sim/step/stages.h"
#include "sim/terms/cell_mean.h"
#include "sim/terms/steady_stress.h"

enum { SUMS = 4, MEANS = 2 /* one after the other: see docs/decisions/0044 */ };

/* Sums one group's changes of velocity: work (per unit of mass), momentum. Returns less the least id of the
   particles that are too fast afterwards, -INFINITY if none is. */
static double sum_changes(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    const sb_f4 *next = sim->work.corrected;
    const float limit = sim->constant.speed_limit * sim->constant.speed_limit;
    double fast = (double)INFINITY;
    for (size_t i = group->first; i < group->end; i++) {
        if (!(sb_sum3(next[i] * next[i]) <= limit)) fast = fmin(fast, (double)sim->state.id[i]);
        terms[0] += sb_ledger_work(sim->state.velocity[i], next[i], sim->state.velocity[i], next[i]);
        for (int axis = 0; axis < 3; axis++)
            terms[1 + axis] += (double)next[i][axis] - (double)sim->state.velocity[i][axis];
    }
    return -fast;
}

/* D_i, from the q of the last step; 0 in strips of given water, beyond whose outer edges pairs are missing that have
   pressure. */
static void find_deviators(sb_sim *sim)
{
    sb_work *w = &sim->work;
    const size_t n = sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) w->last_unknown[i] = sb_stress_unknown(sim, i);
    sb_pressure_load_begin(sim, w->last_unknown);
    sim->passes->deviator(sim);
    for (size_t k = 0; sim->strip && k < sim->strip->held_count; k++) {
        w->deviator_xx[sim->strip->held[k].particle] = 0;
        w->deviator[sim->strip->held[k].particle] = (sb_f4){0};
    }
}

static void load_stress(sb_sim *sim)
{
    sb_refresh(sim, sim->work.stress);
    sb_pressure_load(sim, sim->work.stress_xx);
}

/* <D>_i of the particles that are owned. Returns 0, or -1 without memory. */
static int find_mean(sb_sim *sim)
{
    sim->passes->mean_deviator(sim);
    for (int mean = 0; mean < MEANS; mean++) {
        load_stress(sim);
        if (sb_cell_mean(sim, sim->work.stress_xx, sim->work.stress) != 0) return -1;
    }
    return 0;
}

int sb_stress_mean(sb_sim *sim)
{
    if (find_mean(sim) != 0) return -1;
    load_stress(sim);
    return 0;
}

/* The failure by a particle; without a message if it is in another domain, which has the message. */
static sb_status diverged(const sb_sim *sim, uint32_t id, sb_error *error)
{
    for (size_t i = 0; i < sim->state.n; i++)
        if (sim->state.id[i] == id) return sb_sim_diverged(sim, i, sim->work.corrected[i], error);
    return sb_fail(error, SB_FAILED, "%s", "");
}

sb_status sb_stage_stress_correction(sb_sim *sim, sb_error *error)
{
    find_deviators(sim);
    sb_refresh(sim, sim->work.deviator);
    sb_pressure_load_begin(sim, sim->work.deviator_xx);
    sb_work_enter(&sim->work, SB_PHASE_STRESS);
    if (find_mean(sim) != 0) return sb_fail_memory(error, "means of the stress of the particle packing");
    sb_steady_stress_take(sim);
    load_stress(sim);
    sb_work_enter(&sim->work, SB_PHASE_CORRECTED);
    if (sim->passes->correct(sim) != 0) return sb_fail_memory(error, "forces on bodies");
    double sum[SUMS];
    const double fast = -sb_sum_groups(sim, SUMS, sum_changes, sum);
    if (fast < (double)INFINITY) return diverged(sim, (uint32_t)fast, error);
    const double mass = (double)sim->constant.mass;
    sim->state.ledger.stress += sim->policy->runs ? mass * sum[0] : 0;
    sim->work.stress_gain = sb_scale(sb_vec(sum[1], sum[2], sum[3]), mass);
    const size_t n = sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) sim->state.velocity[i] = sim->work.corrected[i];
    sb_refresh(sim, sim->state.velocity);
    return SB_OK;
}
