/* The source of the pressure problem, its first guess, when to stop, and the acceleration that results. */
#include "sim/pressure.h"

#include "sim/stages.h"

#include <math.h>

const sb_pressure_solver *const sb_pressure_solvers[] = {
    [SB_SOLVER_JACOBI] = &sb_solver_jacobi,
    [SB_SOLVER_CHEBYSHEV] = &sb_solver_chebyshev,
    [SB_SOLVER_CG] = &sb_solver_cg,
    NULL,
};

/* Settled water with walls was measured to reach 1.19 times a lattice's largest eigenvalue at most. */
static const double DISORDER = 1.3;

double sb_pressure_spectrum(const sb_sim *sim)
{
    return DISORDER * sim->constant.spectrum;
}

/* One block's b_i = beta (rho_0 - rho_i) - dt div_i, with the velocities v* and the walls' own; div_i is there. Partial
   sums of what is above the rest density: all of it, and the worst. */
static void source_block(const sb_sim *sim, size_t block, double *partial)
{
    const float dt = (float)sim->report.time_step, rest = sim->constant.rest_density;
    const float beta = (float)sim->scene->numerics.source_relaxation;
    double excess = 0;
    float worst = 0;
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        const float lack = rest - sim->density[i];
        sim->source[i] = beta * lack - dt * (sim->source[i] - sim->wall[i][3]);
        excess += lack < 0 ? (double)-lack : 0;
        worst = -lack > worst ? -lack : worst;
    }
    partial[0] = excess;
    partial[1] = (double)worst;
}

sb_status sb_stage_source(sb_sim *sim, sb_error *error)
{
    (void)error;
    const size_t blocks = sb_blocks(sim);
    const double rest = (double)sim->constant.rest_density;
    double excess = 0, worst = 0;
    sb_divergence(sim, sim->velocity, 1, sim->source);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) source_block(sim, b, sim->partial + 2 * b);
    for (size_t b = 0; b < blocks; b++) {
        excess += sim->partial[2 * b];
        worst = fmax(worst, sim->partial[2 * b + 1]);
    }
    sim->report.compression = sim->n ? excess / ((double)sim->n * rest) : 0;
    sim->report.compression_max = worst / rest;
    return SB_OK;
}

/* q from the last step's pressure in Pa, whatever dt was then (all of it while a sea settles: its pressures are to
   stay); and -a_ii by this step's dt. A drop on its own beside a wall starts from its answer: it moves far against the
   wall in a step, and an old pressure, which the mean error of all the water does not show, would throw it back faster
   than it came. */
static void first_guess(sb_sim *sim)
{
    const size_t n = sim->n;
    const float share = sim->settling == SB_DAMPING ? 1 : (float)sim->scene->numerics.warm_start;
    const float dt2 = (float)(sim->report.time_step * sim->report.time_step);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        float p = sim->velocity[i][3], rho = sim->density[i];
        float q = share * p / (rho * rho);
        sim->diagonal[i] *= dt2;
        if (sim->pairs.count[i] == 0) q = -sim->source[i] / sim->diagonal[i];
        sim->unknown[i] = sim->diagonal[i] > 0 && q > 0 ? q : 0;
    }
}

static double tolerance(const sb_sim *sim)
{
    const sb_numerics *n = &sim->scene->numerics;
    if (n->tolerance_rule == SB_TOLERANCE_DENSITY) return n->tolerance;
    double courant = sim->report.time_step * (double)sim->constant.wave_speed / (double)sim->constant.spacing;
    return n->tolerance * courant * courant;
}

sb_status sb_stage_pressure(sb_sim *sim, sb_error *error)
{
    first_guess(sim);
    sim->last_sweeps = sim->report.iterations;
    sim->report.iterations = 0;
    sim->report.capped = false;
    sim->report.tolerance = tolerance(sim);
    return sb_pressure_solvers[sim->scene->numerics.solver]->solve(sim, error);
}

/* What is summed over a block: positive excess and |e| of active particles, one particle after the other; and by lanes
   how many are active, and the worst. */
typedef struct judgement {
    double sums __attribute__((vector_size(16)));
    sb_i4 active;
    sb_f4 worst;
} judgement;

/* Four particles, by masks: a branch on the sign of an error is a guess. What has no pressure, diagonal 0, is without
   error. */
SB_INLINE void judge_four(judgement *j, sb_f4 error, sb_f4 diagonal, sb_f4 unknown)
{
    typedef float two_floats __attribute__((vector_size(8)));
    const sb_f4 zero = {0};
    const sb_i4 solved = diagonal != zero, active = solved & (unknown > zero);
    const sb_f4 excess = (sb_f4)((sb_i4)error & solved & (error > zero));
    const sb_f4 off = (sb_f4)((sb_i4)error & active & 0x7fffffff);
    const sb_f4 both[2] = {__builtin_shufflevector(excess, off, 0, 4, 1, 5),
                           __builtin_shufflevector(excess, off, 2, 6, 3, 7)};
    for (int k = 0; k < 2; k++) {
        j->sums += __builtin_convertvector((two_floats){both[k][0], both[k][1]}, __typeof__(j->sums));
        j->sums += __builtin_convertvector((two_floats){both[k][2], both[k][3]}, __typeof__(j->sums));
    }
    j->active -= active;
    j->worst = sb_select(excess > j->worst, excess, j->worst);
}

SB_INLINE sb_f4 four_of(const float *field)
{
    return *(const sb_f4 *)field;
}

static void judge_block(const sb_sim *sim, size_t block, double *partial)
{
    const float *residual = sim->residual, *diagonal = sim->diagonal, *unknown = sim->unknown;
    judgement j = {0};
    const size_t end = sb_block_end(sim, block);
    size_t i = block * SB_BLOCK;
    for (; i + 4 <= end; i += 4) judge_four(&j, four_of(residual + i), four_of(diagonal + i), four_of(unknown + i));
    if (i < end) {
        sb_f4 last[3] = {0};
        memcpy(&last[0], residual + i, (end - i) * sizeof(float));
        memcpy(&last[1], diagonal + i, (end - i) * sizeof(float));
        memcpy(&last[2], unknown + i, (end - i) * sizeof(float));
        judge_four(&j, last[0], last[1], last[2]);
    }
    const sb_f4 worst = j.worst;
    partial[0] = j.sums[0];
    partial[1] = j.sums[1];
    partial[2] = (double)(j.active[0] + j.active[1] + j.active[2] + j.active[3]);
    partial[3] = (double)fmaxf(fmaxf(worst[0], worst[1]), fmaxf(worst[2], worst[3]));
}

sb_pressure_error sb_pressure_judge(sb_sim *sim)
{
    const size_t blocks = sb_blocks(sim);
    const double rest = (double)sim->constant.rest_density;
    double excess = 0, active = 0, count = 0, worst = 0;
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) judge_block(sim, b, sim->partial + 4 * b);
    for (size_t b = 0; b < blocks; b++) {
        const double *p = sim->partial + 4 * b;
        excess += p[0];
        active += p[1];
        count += p[2];
        worst = p[3] > worst ? p[3] : worst;
    }
    sb_pressure_error error = {
        .mean = sim->n ? excess / ((double)sim->n * rest) : 0,
        .active = count > 0 ? active / (count * rest) : 0,
        .max = worst / rest,
    };
    sim->report.iterations++;
    sim->report.error_mean = error.mean;
    sim->report.error_active = error.active;
    sim->report.error_max = error.max;
    return error;
}

/* A step that stops a sweep sooner than the one before leaves more than that did, the next one makes up for it, and the
   load on a floor at rest swings by a per cent from step to step. So to stop sooner the error has to be by this much
   smaller. In 2D the load swings less, and water comes to rest less well by it (docs/decisions/0020). */
static const double SOONER = 0.7;

/* The error judged is what is too dense. Chebyshev's passes also leave water that is pressed too much; where that is
   this many times as much, shallow water hops from step to step. In 3D, where it is spray that is so, it costs half as
   many sweeps again and gives nothing (docs/decisions/0022). */
static const double PRESSED = 4;

bool sb_pressure_done(sb_sim *sim, const sb_pressure_error *error)
{
    const sb_numerics *n = &sim->scene->numerics;
    const double tolerance = sim->report.tolerance;
    bool enough = error->mean <= tolerance;
    if (n->tolerance_rule == SB_TOLERANCE_PRESSURE && sim->constant.dimension == 2)
        enough &= error->active <= PRESSED * tolerance;
    else if (n->tolerance_rule == SB_TOLERANCE_PRESSURE && sim->report.iterations < sim->last_sweeps)
        enough = error->mean <= SOONER * tolerance;
    if (enough && sim->report.iterations >= n->min_iterations) return true;
    sim->report.capped = sim->report.iterations >= n->max_iterations;
    return sim->report.capped;
}
