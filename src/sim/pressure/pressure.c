/* The pressure problem of one step: source, initial guess, error of the solve and stopping criterion. */
#include "sim/pressure/pressure.h"
#include "sim/simulation.h"

#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/passes/passes.h"
#include "sim/sea/strip.h"
#include "sim/step/stages.h"

#include <math.h>

const sb_pressure_solver *const sb_pressure_solvers[] = {
    [SB_SOLVER_JACOBI] = &sb_solver_jacobi,
    [SB_SOLVER_CHEBYSHEV] = &sb_solver_chebyshev,
    [SB_SOLVER_CG] = &sb_solver_cg,
    [SB_SOLVER_WCSPH] = &sb_solver_wcsph,
    NULL,
};

/* Measured in settled water with walls: at most 1.19 times the largest eigenvalue of a lattice. */
static const double DISORDER = 1.3;

double sb_pressure_spectrum(const sb_sim *sim)
{
    return DISORDER * sim->constant.spectrum;
}

bool sb_pressure_grown(const sb_pressure_error *error, double *least)
{
    static const double GROWN = 2;
    const bool grown = error->residual > GROWN * *least;
    if (grown || error->residual < *least) *least = error->residual;
    return grown;
}

/* Computes b_i = beta (rho_0 - rho_i) - dt div_i of one group, with v* and the walls' velocities. sim->work.source
   holds div_i on entry. Sums the density above the rest density, and returns the largest. */
static double source_group(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    const float dt = (float)sim->state.time_step, rest = sim->constant.rest_density;
    const float beta = (float)sim->scene->numerics.source_relaxation;
    double excess = 0;
    float worst = 0;
    for (size_t i = group->first; i < group->end; i++) {
        const float deficit = rest - sim->work.density[i];
        sim->work.source[i] = beta * deficit - dt * (sim->work.source[i] - sb_wall_flux(sim, i));
        excess += deficit < 0 ? (double)-deficit : 0;
        worst = -deficit > worst ? -deficit : worst;
    }
    terms[0] = excess;
    return (double)worst;
}

sb_status sb_stage_source(sb_sim *sim, sb_error *error)
{
    (void)error;
    const double rest = (double)sim->constant.rest_density;
    double excess;
    sb_refresh_begin(sim, sim->work.predicted);
    sim->passes->diverge(sim, sim->work.predicted, 1, sim->work.source);
    const double worst = sb_sum_groups(sim, 1, source_group, &excess);
    sim->report.compression = sim->work.everywhere ? excess / ((double)sim->work.everywhere * rest) : 0;
    sim->report.compression_max = fmax(worst, 0) / rest;
    return SB_OK;
}

/* Sets the initial guess of q from the last step's pressure in Pa, whatever its dt was, and multiplies -a_ii by this
   step's dt^2. A single particle beside boundary particles starts from its solution: it moves far towards the wall in
   one step, and an old pressure would throw it back faster than it came. The mean error of all the water does not show
   such an error. With images it has pairs with its own images, and starts like the others: docs/decisions/0105. */
static void set_initial_guess(sb_sim *sim)
{
    const size_t n = sim->state.n;
    const float share = (float)sim->scene->numerics.warm_start;
    const float dt2 = (float)(sim->state.time_step * sim->state.time_step);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        float p = sim->state.velocity[i][3], rho = sim->work.density[i];
        float q = share * p / (rho * rho);
        sim->work.diagonal[i] *= dt2;
        if (sim->work.pairs.count[i] == 0) q = -sim->work.source[i] / sim->work.diagonal[i];
        sim->work.unknown[i] = sim->work.diagonal[i] > 0 && q > 0 ? q : 0;
    }
    if (sim->strip) sb_strip_set_unknown(sim);
}

static double tolerance(const sb_sim *sim)
{
    const sb_numerics *n = &sim->scene->numerics;
    if (n->tolerance_rule == SB_TOLERANCE_DENSITY) return n->tolerance;
    double courant = sim->state.time_step * (double)sim->constant.wave_speed / (double)sim->constant.spacing;
    return n->tolerance * courant * courant;
}

sb_status sb_stage_pressure(sb_sim *sim, sb_error *error)
{
    set_initial_guess(sim);
    sim->work.solve = (sb_solve){.last = sim->state.sweeps, .tolerance = tolerance(sim)};
    const sb_status status = sb_pressure_solvers[sim->scene->numerics.solver]->solve(sim, error);
    sb_refresh_owners_values(sim, sim->work.unknown);
    sim->state.sweeps = sim->work.solve.iterations;
    sim->report.tolerance = sim->work.solve.tolerance;
    sim->report.capped = sim->work.solve.capped;
    return status;
}

/* Sums over a group. sums: max(0, e), and |min(D q, -e)|, one particle after the other. worst: by lanes, largest e. */
typedef struct judgement {
    double sums __attribute__((vector_size(16)));
    sb_f4 worst;
} judgement;

/* Adds four particles, by masks: a processor cannot predict a branch on the sign of an error. A particle with diagonal
   0 has no pressure and no error. */
SB_INLINE void judge_four(judgement *j, sb_f4 error, sb_f4 diagonal, sb_f4 unknown)
{
    typedef float two_floats __attribute__((vector_size(8)));
    const sb_f4 zero = {0}, press = diagonal * unknown, below = -error;
    const sb_i4 solved = diagonal != zero, above = error > zero;
    const sb_f4 excess = (sb_f4)((sb_i4)error & solved & above);
    const sb_f4 residual = (sb_f4)((sb_i4)sb_select(above, error, sb_select(press < below, press, below)) & solved);
    const sb_f4 both[2] = {__builtin_shufflevector(excess, residual, 0, 4, 1, 5),
                           __builtin_shufflevector(excess, residual, 2, 6, 3, 7)};
    for (int k = 0; k < 2; k++) {
        j->sums += __builtin_convertvector((two_floats){both[k][0], both[k][1]}, __typeof__(j->sums));
        j->sums += __builtin_convertvector((two_floats){both[k][2], both[k][3]}, __typeof__(j->sums));
    }
    j->worst = sb_select(excess > j->worst, excess, j->worst);
}

SB_INLINE sb_f4 four_of(const float *field)
{
    sb_f4 four; /* groups begin anywhere */
    memcpy(&four, field, sizeof four);
    return four;
}

/* Sums max(0, e) and |min(D q, -e)|. Returns the largest e. */
static double judge_group(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    const float *residual = sim->work.residual, *diagonal = sim->work.diagonal, *unknown = sim->work.unknown;
    judgement j = {0};
    const size_t end = group->end;
    size_t i = group->first;
    for (; i + 4 <= end; i += 4) judge_four(&j, four_of(residual + i), four_of(diagonal + i), four_of(unknown + i));
    if (i < end) {
        sb_f4 last[3] = {0};
        memcpy(&last[0], residual + i, (end - i) * sizeof(float));
        memcpy(&last[1], diagonal + i, (end - i) * sizeof(float));
        memcpy(&last[2], unknown + i, (end - i) * sizeof(float));
        judge_four(&j, last[0], last[1], last[2]);
    }
    const sb_f4 worst = j.worst;
    terms[0] = j.sums[0];
    terms[1] = j.sums[1];
    return (double)fmaxf(fmaxf(worst[0], worst[1]), fmaxf(worst[2], worst[3]));
}

/* sum: excess, residual. worst: the largest excess. */
static sb_pressure_error judge(sb_sim *sim, const double sum[2], double worst)
{
    const double rest = (double)sim->constant.rest_density, all = (double)sim->work.everywhere * rest;
    sb_pressure_error error = {
        .mean = all > 0 ? sum[0] / all : 0,
        .residual = all > 0 ? sum[1] / all : 0,
        .max = fmax(worst, 0) / rest,
    };
    if (sim->work.solve.iterations++ == 0) sim->work.solve.first = error.residual;
    sim->report.error_mean = error.mean;
    sim->report.error_residual = error.residual;
    sim->report.error_max = error.max;
    return error;
}

sb_pressure_error sb_pressure_judge(sb_sim *sim)
{
    double sum[2];
    const double worst = sb_sum_groups(sim, 2, judge_group, sum);
    return judge(sim, sum, worst);
}

void sb_pressure_judge_begin(sb_sim *sim)
{
    sb_sum_groups_begin(sim, 2, judge_group);
}

sb_pressure_error sb_pressure_judge_end(sb_sim *sim)
{
    double sum[2];
    const double worst = sb_sum_groups_end(sim, 2, sum);
    return judge(sim, sum, worst);
}

/* A solve ends when the residual is below the tolerance and, unless it is below FINE tolerances, has fallen to SHARE of
   that of the initial guess. Where water is at rest the initial guess is nearly right, and FINE decides; it costs
   little there. Where water moves violently SHARE decides. With one limit for both, either water at rest swings while a
   wave is elsewhere, or the wave takes twice as many sweeps (docs/decisions/0032). */
static const double FINE = 0.0125, SHARE = 0.3;

bool sb_pressure_met(const sb_sim *sim, const sb_pressure_error *error)
{
    const sb_solve *solve = &sim->work.solve;
    if (sim->scene->numerics.tolerance_rule == SB_TOLERANCE_DENSITY) return error->mean <= solve->tolerance;
    const double least = fmax(FINE * solve->tolerance, SHARE * solve->first);
    return error->residual <= fmin(solve->tolerance, least);
}

bool sb_pressure_done(sb_sim *sim, const sb_pressure_error *error)
{
    const sb_numerics *n = &sim->scene->numerics;
    sb_solve *solve = &sim->work.solve;
    if (sb_pressure_met(sim, error) && solve->iterations >= n->min_iterations) return true;
    /* An error that is no number ends the solve; the new velocities will show that the run has diverged. */
    solve->capped = solve->iterations >= n->max_iterations || isnan(error->mean);
    return solve->capped;
}
