#include "sim/terms/sponge.h"

#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/step/ledger.h"

#include <math.h>

/* Sum over sponges of their greatest strength (or alpha, if viscous) times its share at a place. */
static double sum_at(const sb_sim *sim, sb_record at, bool viscous)
{
    const double x[] = {sim->space.origin.x + at[0] * sim->space.quantum,
                        sim->space.origin.y + at[1] * sim->space.quantum};
    double sum = 0;
    for (size_t s = 0; s < sim->scene->sponge_count; s++) {
        const sb_sponge *sponge = &sim->scene->sponges[s];
        if ((sponge->kind == SB_SPONGE_VISCOUS) != viscous) continue;
        const double beyond = (x[sponge->side / 2] - sponge->end) * (sponge->side % 2 ? 1 : -1);
        const double most = viscous ? sponge->alpha : sponge->strength;
        sum += most * sb_sponge_share(sponge->profile, 1 + beyond / sponge->length);
    }
    return sum;
}

/* Share of the velocity that a particle loses in this step. */
static float lost_share(const sb_sim *sim, sb_record at)
{
    const double strength = sum_at(sim, at, false);
    const double part = strength * sim->state.time_step;
    return (float)(part / (1 + part));
}

static sb_f4 change_of(const sb_sim *sim, size_t i)
{
    const sb_f4 share = sb_splat(lost_share(sim, sim->state.position[i]));
    sb_f4 change = -share * sim->state.velocity[i];
    change[3] = 0;
    return change;
}

sb_status sb_stage_sponge(sb_sim *sim, sb_error *error)
{
    (void)error;
    if (!sim->policy->runs) return SB_OK;
    const size_t n = sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) sim->work.predicted[i] += change_of(sim, i);
    return SB_OK;
}

sb_status sb_stage_viscous_sponge(sb_sim *sim, sb_error *error)
{
    (void)error;
    const sb_constants *c = &sim->constant;
    const double one = sb_sponge_viscosity(1, (double)c->support, (double)c->sound_speed, c->dimension);
    const size_t n = sim->state.n;
    const bool turbulent = sim->needs.turbulence;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        const float own = (float)(one * sum_at(sim, sim->state.position[i], true));
        sim->work.eddy[i] = turbulent ? sim->work.eddy[i] + own : own;
    }
    sb_refresh_values(sim, sim->work.eddy);
    return SB_OK;
}

static double drain(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    for (int k = 0; k < 4; k++) terms[k] = 0;
    for (size_t i = group->first; i < group->end; i++) {
        const sb_f4 change = change_of(sim, i);
        terms[0] += sb_ledger_work((sb_f4){0}, change, sb_ledger_start(sim, i), sim->work.end_velocity[i]);
        for (int axis = 0; axis < 3; axis++) terms[1 + axis] += (double)change[axis];
    }
    return 0;
}

sb_status sb_stage_drained(sb_sim *sim, sb_error *error)
{
    (void)error;
    double sum[4] = {0};
    if (sim->policy->runs) sb_sum_groups(sim, 4, drain, sum);
    sim->work.sponge_work = sum[0];
    sim->work.sponge_gain = sb_scale(sb_vec(sum[1], sum[2], sum[3]), (double)sim->constant.mass);
    return SB_OK;
}
