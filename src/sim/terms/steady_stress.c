#include "sim/terms/steady_stress.h"

#include "sim/terms/stress_correction.h"

#include <math.h>

void sb_steady_stress_take(sb_sim *sim)
{
    if (!sim->needs.steady_stress) return;
    const sb_state *state = &sim->state;
    const sb_work *w = &sim->work;
    const double unit = (double)(sim->constant.wave_speed / sim->constant.gravity); /* sqrt(D/g) */
    const float share = (float)-expm1(-state->time_step / (sim->scene->numerics.stress_memory * unit));
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
