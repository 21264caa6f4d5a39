/* The two halves of an explicit step, symplectic as in SPHysics: positions, velocities and densities in the middle of
   the step from those at its start; then, with the forces there, those at its end. */
#include "physics/kernels/tait.h"
#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/step/motion.h"
#include "sim/walls/walls.h"
#include "sim/wcsph/boundary.h"
#include "sim/wcsph/wcsph.h"

const sb_pressure_solver sb_solver_wcsph = {
    .name = "wcsph",
    .summary = "no solve: explicit steps of weakly compressible water",
    .reference = "Wen, Ren, Dong, Wang; Monaghan 1994",
};

double sb_wcsph_longest_step(const sb_numerics *numerics, const sb_constants *constants, double speed)
{
    return numerics->cfl * 0.5 * (double)constants->support / ((double)constants->sound_speed + speed);
}

static float pressure_of(const sb_sim *sim, float excess)
{
    return sb_tait_pressure(sim->constant.stiffness, excess / sim->constant.rest_density);
}

void sb_wcsph_begin(sb_sim *sim)
{
    const double rest = (double)sim->constant.rest_density, stiffness = (double)sim->constant.stiffness;
    for (size_t i = 0; sim->state.excess && i < sim->state.n; i++)
        sim->state.excess[i] = (float)(rest * sb_tait_excess(stiffness, (double)sim->state.velocity[i][3]));
}

/* Sets the densities of a group. Sums the density above the rest density, and returns the largest. */
static double take_densities(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    double sum = 0, worst = 0;
    for (size_t i = group->first; i < group->end; i++) {
        const float excess = sim->state.excess[i];
        sim->work.density[i] = sim->constant.rest_density + excess;
        sum += excess > 0 ? (double)excess : 0;
        worst = (double)excess > worst ? (double)excess : worst;
    }
    terms[0] = sum;
    return worst;
}

sb_status sb_stage_wcsph_densities(sb_sim *sim, sb_error *error)
{
    (void)error;
    const double rest = (double)sim->constant.rest_density;
    double excess;
    const double worst = sb_sum_groups(sim, 1, take_densities, &excess);
    sim->report.compression = sim->work.everywhere ? excess / ((double)sim->work.everywhere * rest) : 0;
    sim->report.compression_max = fmax(worst, 0) / rest;
    return SB_OK;
}

sb_status sb_stage_wcsph_rates(sb_sim *sim, sb_error *error)
{
    (void)error;
    const size_t n = sim->state.n;
    const sb_numerics *numerics = &sim->scene->numerics;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        const float density = sim->work.density[i];
        sim->work.unknown[i] = pressure_of(sim, sim->state.excess[i]) / (density * density);
    }
    sb_refresh_owners_values(sim, sim->work.unknown);
    sb_pressure_load_begin(sim, sim->work.unknown);
    sim->passes->accelerate(sim);
    if (sim->needs.dynamic_walls) sb_boundary_accelerate(sim);
    if (numerics->kernel_correction == SB_CORRECTION_CSPM) {
        sb_wcsph_correct_gradients(sim);
    } else {
        sim->passes->diverge(sim, sim->state.velocity, 1, sim->work.rate);
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < n; i++) sim->work.rate[i] -= sb_wall_flux(sim, i);
    }
    if (!(numerics->density_diffusion > 0)) return SB_OK;
    sb_pressure_load_begin(sim, sim->state.excess);
    sb_wcsph_diffuse(sim);
    return SB_OK;
}

/* Moves a particle of the first half. Returns the change of its z, quanta. */
static int64_t predict_one(sb_sim *sim, size_t i, float dt, float to_quanta)
{
    const sb_f4 v = sim->state.velocity[i], half = sb_splat(0.5f), way = v * sb_splat(to_quanta);
    const sb_record at = sim->state.position[i];
    sb_f4 change = (sim->work.predicted[i] - v + sim->work.acceleration[i] * sb_splat(dt)) * half;
    if (sim->constant.dimension == 2) change[1] = 0;
    change[3] = 0;
    sim->state.step_begin[i] = (sb_f4){v[0], v[1], v[2], sim->state.excess[i]};
    sim->state.velocity[i] = v + change;
    sim->state.excess[i] += 0.5f * dt * sim->work.rate[i];
    sim->state.position[i] =
        (sb_record){sb_moved(at[0], way[0]), sb_moved(at[1], way[1]), sb_moved(at[2], way[2]), at[3]};
    return (int64_t)sim->state.position[i][2] - at[2];
}

/* Puts the moving bodies to the middle between their places at t and t + dt. */
static sb_status put_walls(sb_sim *sim, sb_error *error)
{
    bool moved = false;
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_moving_body *moving = &sim->walls.moving[m];
        const double middle = 0.5 * (moving->displacement + moving->next_displacement);
        moved |= middle != moving->displacement;
        moving->displacement = middle;
    }
    return moved ? sb_walls_restore(sim, error) : SB_OK;
}

sb_status sb_stage_wcsph_predict(sb_sim *sim, sb_error *error)
{
    const size_t n = sim->state.n;
    const float dt = (float)sim->state.time_step, to_quanta = 0.5f * (float)(sim->state.time_step / sim->space.quantum);
    int64_t rise = 0; /* whole numbers: their sum does not depend on the order */
#pragma omp parallel for schedule(static) reduction(+ : rise)
    for (size_t i = 0; i < n; i++) rise += predict_one(sim, i, dt, to_quanta);
    uint64_t all = (uint64_t)rise;
    sim->exchange->count(sim, &all, 1);
    sim->work.first_rise = (double)(int64_t)all;
    sb_boundary_predict(sim, dt);
    return put_walls(sim, error);
}

sb_status sb_stage_wcsph_correct(sb_sim *sim, sb_error *error)
{
    (void)error;
    const size_t n = sim->state.n;
    const float dt = (float)sim->state.time_step, rest = sim->constant.rest_density;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        const sb_f4 begin = sim->state.step_begin[i];
        sim->work.predicted[i] += begin - sim->state.velocity[i];
        sim->state.excess[i] = sb_wcsph_density_after(rest, begin[3], sim->state.excess[i], dt * sim->work.rate[i]);
    }
    sb_boundary_correct(sim, dt);
    return SB_OK;
}

sb_status sb_stage_wcsph_finish(sb_sim *sim, sb_error *error)
{
    (void)error;
    const size_t n = sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        sim->state.velocity[i] = sim->state.step_begin[i];
        sim->work.end_velocity[i][3] = pressure_of(sim, sim->state.excess[i]);
        sim->work.density[i] = sim->constant.rest_density + sim->state.excess[i];
    }
    return SB_OK;
}
