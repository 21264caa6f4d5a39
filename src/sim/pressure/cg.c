/* Conjugate gradients with proportioning and gradient projection (MPRGP) for q >= 0, scaled by the
   diagonal D = -a_ii: minimises f(q) = -q.A q/2 + b.q, whose gradient is -e. */
#include "sim/exchange/sums.h"
#include "sim/pressure/pressure.h"
#include "sim/simulation.h"

#include <math.h>

/* Inner products along a direction. */
typedef struct along {
    double slope;     /* e . direction */
    double curvature; /* - direction . A direction */
    double feasible;  /* longest step that keeps q >= 0 */
} along;

/* |phi|^2_D, |beta|^2_D: the gradient on the free set, where q > 0, and the inward one on the chopped set, q = 0. */
static double set_terms(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    double free = 0, chopped = 0;
    for (size_t i = group->first; i < group->end; i++) {
        if (sim->work.diagonal[i] == 0) continue;
        const double e = (double)sim->work.residual[i];
        if (sim->work.unknown[i] > 0)
            free += e * e / (double)sim->work.diagonal[i];
        else if (e > 0)
            chopped += e * e / (double)sim->work.diagonal[i];
    }
    terms[0] = free;
    terms[1] = chopped;
    return 0;
}

/* Whether the gradient on the chopped set is the larger one. */
static bool is_chopped(sb_sim *sim)
{
    double sum[2];
    sb_sum_groups(sim, 2, set_terms, sum);
    return sum[1] > sum[0];
}

/* The slope and the curvature. Returns less the group's `feasible`. */
static double direction_terms(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    double slope = 0, curvature = 0, feasible = (double)INFINITY;
    for (size_t i = group->first; i < group->end; i++) {
        if (sim->work.diagonal[i] == 0) continue;
        const double d = (double)sim->work.direction[i], q = (double)sim->work.unknown[i];
        slope += (double)sim->work.residual[i] * d;
        curvature -= d * (double)sim->work.product[i];
        if (d < 0 && q < -feasible * d) feasible = -q / d;
    }
    terms[0] = slope;
    terms[1] = curvature;
    return -feasible;
}

static along sum_along(sb_sim *sim)
{
    double sum[2];
    const double feasible = -sb_sum_groups(sim, 2, direction_terms, sum);
    return (along){.slope = sum[0], .curvature = sum[1], .feasible = feasible};
}

/* direction = D^-1 (gradient on the free set, or on the chopped set) + gamma direction. */
static void aim(sb_sim *sim, bool chopped, float gamma)
{
    const size_t n = sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        float e = sim->work.residual[i];
        bool active = chopped ? sim->work.unknown[i] == 0 && e > 0 : sim->work.unknown[i] > 0;
        float d = active && sim->work.diagonal[i] > 0 ? e / sim->work.diagonal[i] : 0;
        sim->work.direction[i] = gamma != 0 ? d + gamma * sim->work.direction[i] : d;
    }
}

/* q += length direction, e += length A direction. */
static void advance(sb_sim *sim, float length)
{
    const size_t n = sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        float q = sim->work.unknown[i] + length * sim->work.direction[i];
        sim->work.unknown[i] = q > 0 ? q : 0;
        sim->work.residual[i] += length * sim->work.product[i];
    }
}

/* A clamped step along the free gradient: the active set may change much at once. */
static void project(sb_sim *sim)
{
    const size_t n = sim->state.n;
    /* In units of 1/D. With a longer step the shortest modes of D^-1 A would grow. */
    const float length = (float)(2 / sb_pressure_spectrum(sim));
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        if (sim->work.unknown[i] == 0 || sim->work.diagonal[i] == 0) continue;
        float q = sim->work.unknown[i] + length * sim->work.residual[i] / sim->work.diagonal[i];
        sim->work.unknown[i] = q > 0 ? q : 0;
    }
}

static double conjugation_terms(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    for (size_t i = group->first; i < group->end; i++)
        if (sim->work.unknown[i] > 0 && sim->work.diagonal[i] > 0)
            terms[0] += (double)sim->work.residual[i] / (double)sim->work.diagonal[i] * (double)sim->work.product[i];
    return 0;
}

/* Coefficient that makes the next direction conjugate to the last: (D^-1 phi) . A d / (d . A d). */
static double conjugation(sb_sim *sim, double curvature)
{
    double sum;
    sb_sum_groups(sim, 1, conjugation_terms, &sum);
    return sum / curvature;
}

static sb_status solve(sb_sim *sim, sb_error *error)
{
    (void)error;
    sb_pressure_residual(sim);
    sb_pressure_error judged = sb_pressure_judge(sim);
    aim(sim, false, 0);
    while (!sb_pressure_done(sim, &judged)) {
        const bool chopped = is_chopped(sim);
        if (chopped) aim(sim, true, 0);
        sb_pressure_load_begin(sim, sim->work.direction);
        sb_pressure_product(sim, sim->work.product);
        const along s = sum_along(sim);
        if (!(s.curvature > 0)) { /* no further descent */
            sim->work.solve.capped = !sb_pressure_met(sim, &judged);
            break;
        }
        double best = s.slope / s.curvature;
        if (chopped || best <= s.feasible) {
            advance(sim, (float)best);
            aim(sim, false, chopped ? 0 : (float)conjugation(sim, s.curvature));
        } else {
            advance(sim, (float)s.feasible);
            project(sim);
            sb_pressure_residual(sim);
            sim->work.solve.iterations++;
            aim(sim, false, 0);
        }
        judged = sb_pressure_judge(sim);
    }
    sb_pressure_load_begin(sim, sim->work.unknown);
    sb_pressure_accelerate(sim);
    return SB_OK;
}

const sb_pressure_solver sb_solver_cg = {
    .name = "cg",
    .summary = "conjugate gradients with projection (MPRGP), Jacobi-scaled",
    .reference = "Dostal and Schoeberl 2005",
    .needs_direction = true,
    .needs_product = true,
    .solve = solve,
};
