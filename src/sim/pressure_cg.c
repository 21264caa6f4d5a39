/* Conjugate gradients with proportioning and gradient projection (MPRGP) for q >= 0, scaled by the
   diagonal D = -a_ii: minimises f(q) = -q.A q/2 + b.q, whose gradient is -e. */
#include "sim/pressure.h"

#include <math.h>

/* Length of a projection step in units of 1/D. From 2/lambda_max of D^-1 A on, the shortest modes would grow. With wide
   supports that limit is below this value. */
static const double PROJECTION = 0.55;

static float projection(const sb_sim *sim)
{
    return (float)fmin(PROJECTION, 2 / sb_pressure_spectrum(sim));
}

/* Inner products of one sweep. */
typedef struct sums {
    double free, chopped; /* |phi|^2_D, |beta|^2_D: gradient on q > 0, and inward gradient on q = 0 */
    double slope;         /* e . direction */
    double curvature;     /* - direction . A direction */
    double feasible;      /* longest step that keeps q >= 0 */
} sums;

static void sum_block(const sb_sim *sim, size_t block, double *partial)
{
    double free = 0, chopped = 0, slope = 0, curvature = 0, feasible = (double)INFINITY;
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        if (sim->diagonal[i] == 0) continue;
        double e = (double)sim->residual[i], d = (double)sim->direction[i];
        double q = (double)sim->unknown[i];
        if (q > 0)
            free += e * e / (double)sim->diagonal[i];
        else if (e > 0)
            chopped += e * e / (double)sim->diagonal[i];
        slope += e * d;
        curvature -= d * (double)sim->product[i];
        if (d < 0 && q < -feasible * d) feasible = -q / d;
    }
    const double values[5] = {free, chopped, slope, curvature, feasible};
    for (int v = 0; v < 5; v++) partial[v] = values[v];
}

static sums sum_all(sb_sim *sim)
{
    const size_t blocks = sb_blocks(sim);
    sums s = {.feasible = (double)INFINITY};
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) sum_block(sim, b, sim->partial + 5 * b);
    for (size_t b = 0; b < blocks; b++) {
        const double *p = sim->partial + 5 * b;
        s.free += p[0];
        s.chopped += p[1];
        s.slope += p[2];
        s.curvature += p[3];
        s.feasible = fmin(s.feasible, p[4]);
    }
    return s;
}

/* direction = D^-1 (gradient on the free set, or on the chopped set) + gamma direction. */
static void aim(sb_sim *sim, bool chopped, float gamma)
{
    const size_t n = sim->n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        float e = sim->residual[i];
        bool active = chopped ? sim->unknown[i] == 0 && e > 0 : sim->unknown[i] > 0;
        float d = active && sim->diagonal[i] > 0 ? e / sim->diagonal[i] : 0;
        sim->direction[i] = gamma != 0 ? d + gamma * sim->direction[i] : d;
    }
}

/* q += length direction, e += length A direction. */
static void advance(sb_sim *sim, float length)
{
    const size_t n = sim->n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        float q = sim->unknown[i] + length * sim->direction[i];
        sim->unknown[i] = q > 0 ? q : 0;
        sim->residual[i] += length * sim->product[i];
    }
}

/* A clamped step along the free gradient: the active set may change much at once. */
static void project(sb_sim *sim)
{
    const size_t n = sim->n;
    const float length = projection(sim);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        if (sim->unknown[i] == 0 || sim->diagonal[i] == 0) continue;
        float q = sim->unknown[i] + length * sim->residual[i] / sim->diagonal[i];
        sim->unknown[i] = q > 0 ? q : 0;
    }
}

/* Coefficient that makes the next direction conjugate to the last: (D^-1 phi) . A d / (d . A d). */
static double conjugation(sb_sim *sim, double curvature)
{
    const size_t blocks = sb_blocks(sim);
    double sum = 0;
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        double part = 0;
        for (size_t i = b * SB_BLOCK; i < sb_block_end(sim, b); i++)
            if (sim->unknown[i] > 0 && sim->diagonal[i] > 0)
                part += (double)sim->residual[i] / (double)sim->diagonal[i] * (double)sim->product[i];
        sim->partial[b] = part;
    }
    for (size_t b = 0; b < blocks; b++) sum += sim->partial[b];
    return sum / curvature;
}

static sb_status solve(sb_sim *sim, sb_error *error)
{
    (void)error;
    sb_pressure_residual(sim);
    sb_pressure_error judged = sb_pressure_judge(sim);
    aim(sim, false, 0);
    while (!sb_pressure_done(sim, &judged)) {
        sums s = sum_all(sim);
        bool chopped = s.chopped > s.free;
        if (chopped) aim(sim, true, 0);
        sb_pressure_load(sim, sim->direction);
        sb_pressure_product(sim, sim->product);
        s = sum_all(sim);
        if (!(s.curvature > 0)) { /* no further descent */
            sim->report.capped = !(judged.mean <= sim->report.tolerance);
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
            sim->report.iterations++;
            aim(sim, false, 0);
        }
        judged = sb_pressure_judge(sim);
    }
    sb_pressure_load(sim, sim->unknown);
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
