/* Relaxed Jacobi with the clamp q >= 0 [I14; S16, Algorithm 2], in residual form. */
#include "sim/pressure/pressure.h"
#include "sim/simulation.h"

#include <math.h>

/* The relaxation factor. Above 2 / (largest eigenvalue) every sweep adds to the error. With wide supports that limit is
   below the usual 0.5. */
static float factor(const sb_sim *sim)
{
    const double requested = sim->scene->numerics.relaxation, bound = 2 / sb_pressure_spectrum(sim);
    return (float)(requested < bound ? requested : bound);
}

static sb_status solve(sb_sim *sim, sb_error *error)
{
    (void)error;
    float omega = factor(sim);
    double least = (double)INFINITY;
    for (;;) {
        const size_t n = sim->state.n;
        sb_pressure_residual(sim);
        sb_pressure_error judged = sb_pressure_judge(sim);
        if (sb_pressure_done(sim, &judged)) return SB_OK;
        if (sb_pressure_grown(&judged, &least)) omega /= (float)SB_PRESSURE_WIDER;
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < n; i++) {
            if (sim->work.diagonal[i] == 0) continue;
            float q = sim->work.unknown[i] + omega * sim->work.residual[i] / sim->work.diagonal[i];
            sim->work.unknown[i] = q > 0 ? q : 0;
        }
    }
}

const sb_pressure_solver sb_solver_jacobi = {
    .name = "jacobi",
    .summary = "relaxed Jacobi with clamp",
    .reference = "Ihmsen et al. 2014; Sampath et al. 2016, Algorithm 2",
    .solve = solve,
};
