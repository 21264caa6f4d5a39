#include "sim/terms/steady_stress.h"

#include "sim/terms/stress_correction.h"

#include <math.h>

/* While water settles its motion is damped, and no wave has to keep its height. A mean over less time has then come
   near to S when the run begins, where it is set to S: loads do not change because a mean does. */
static const double SETTLING = 1 / 3.0;

/* The part of S that enters the mean in one step. */
static float share_of(const sb_sim *sim)
{
    const sb_state *state = &sim->state;
    const sb_settle *settle = &state->settle;
    if (settle->done > 0 && !settle->under_way && state->time == 0) return 1;
    const double unit = (double)(sim->constant.wave_speed / sim->constant.gravity); /* sqrt(D/g) */
    const double memory = sim->scene->numerics.stress_memory * unit;
    return (float)-expm1(-state->time_step / (settle->under_way ? SETTLING * memory : memory));
}

void sb_steady_stress_take(sb_sim *sim)
{
    if (!sim->needs.steady_stress) return;
    const sb_state *state = &sim->state;
    const sb_work *w = &sim->work;
    const float share = share_of(sim);
    const size_t n = state->n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        const float q = sb_stress_unknown(sim, i);
        state->steady_unknown[i] += share * (q - state->steady_unknown[i]);
        state->steady_stress_xx[i] += share * (w->stress_xx[i] - state->steady_stress_xx[i]);
        state->steady_stress[i] += sb_splat(share) * (w->stress[i] - state->steady_stress[i]);
        const float part = sb_steady_part(q, state->steady_unknown[i]);
        w->stress_xx[i] -= part * state->steady_stress_xx[i];
        w->stress[i] -= sb_splat(part) * state->steady_stress[i];
    }
}

void sb_steady_stress_clear(sb_state *state, size_t i)
{
    if (!state->steady_stress) return;
    state->steady_stress[i] = (sb_f4){0};
    state->steady_stress_xx[i] = state->steady_unknown[i] = 0;
}
