/* Chebyshev semi-iteration on the Jacobi-scaled operator, with the clamp q >= 0. It has no inner products, and so one
   pass over memory less than conjugate gradients, and it converges in spite of the clamp. */
#include "sim/pressure/pressure.h"
#include "sim/simulation.h"

#include <math.h>

/* Lower end of the interval of eigenvalues of D^-1 A for which the polynomial is made. It determines the error modes
   that the sweeps of one solve damp well. A polynomial of degree n damps modes down to about 1/n^2 of the upper end, so
   that the value is SHARE/n^2 with n the number of sweeps of the step before (docs/decisions/0017). START: used while n
   is not known. */
static const double START = 0.1, SHARE = 8, SMALLEST_MIN = 0.02, SMALLEST_MAX = 0.2;

/* Coefficients of the recurrence [Golub and Varga 1961]. */
typedef struct polynomial {
    double largest, smallest, theta, delta, rho;
    bool first;
} polynomial;

static double lower_end(const sb_sim *sim)
{
    const double n = sim->work.solve.last;
    return n > 0 ? fmin(fmax(SHARE / (n * n), SMALLEST_MIN), SMALLEST_MAX) : START;
}

static polynomial begin(double largest, double smallest)
{
    const double theta = 0.5 * (largest + smallest), delta = 0.5 * (largest - smallest);
    return (polynomial){largest, smallest, theta, delta, .rho = delta / theta, .first = true};
}

/* out = q + move, move = keep times the last move + step times the scaled residual. */
static void sweep(sb_sim *sim, polynomial *p, float *out)
{
    const size_t n = sim->state.n;
    const float *restrict residual = sim->work.residual, *restrict diagonal = sim->work.diagonal;
    const float *unknown = sim->work.unknown;
    float *restrict direction = sim->work.direction;
    const double next = 1 / (2 * p->theta / p->delta - p->rho);
    const bool first = p->first;
    const float keep = first ? 0 : (float)(next * p->rho);
    const float step = first ? (float)(1 / p->theta) : (float)(2 * next / p->delta);
    p->rho = first ? p->rho : next;
    p->first = false;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        const float old = unknown[i], move = first ? 0 : keep * direction[i];
        float q = old + move + step * residual[i] / diagonal[i];
        q = q > 0 ? q : 0;
        q = diagonal[i] != 0 ? q : old; /* a particle without pressure keeps q = 0 */
        direction[i] = q - old;
        out[i] = q;
    }
}

/* Computes the errors. On several domains their sums take time, in which the next sweep begins: *next is
   the polynomial after it. It is kept or dropped then. */
static sb_pressure_error judge_and_go_ahead(sb_sim *sim, polynomial *next)
{
    sb_pressure_judge_begin(sim);
    sweep(sim, next, sim->work.unknown_ahead);
    sb_pressure_ahead(sim);
    return sb_pressure_judge_end(sim);
}

static sb_status solve(sb_sim *sim, sb_error *error)
{
    (void)error;
    const bool ahead = sim->needs.ahead;
    polynomial p = begin(sb_pressure_spectrum(sim), lower_end(sim));
    double least = (double)INFINITY;
    for (;;) {
        polynomial next = p;
        sb_pressure_residual(sim);
        const sb_pressure_error judged = ahead ? judge_and_go_ahead(sim, &next) : sb_pressure_judge(sim);
        const bool done = sb_pressure_done(sim, &judged), grown = !done && sb_pressure_grown(&judged, &least);
        if (ahead && (done || grown)) sb_pressure_drop_ahead(sim);
        if (done) return SB_OK;
        if (grown) p = begin(SB_PRESSURE_WIDER * p.largest, p.smallest);
        if (ahead && !grown) {
            sb_pressure_keep_ahead(sim);
            p = next;
        } else {
            sweep(sim, &p, sim->work.unknown);
        }
    }
}

const sb_pressure_solver sb_solver_chebyshev = {
    .name = "chebyshev",
    .summary = "Chebyshev semi-iteration with clamp, Jacobi-scaled",
    .reference = "Golub and Varga 1961",
    .needs_direction = true,
    .goes_ahead = true,
    .solve = solve,
};
