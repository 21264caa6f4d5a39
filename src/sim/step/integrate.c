/* The symplectic update [S16, eqs. 17, 18]. */
#include "sim/exchange/sums.h"
#include "sim/step/ledger.h"
#include "sim/step/stages.h"

#include <math.h>

/* Fraction of the velocity that a settling step keeps (docs/decisions/0018). */
static const float SETTLE_DAMPING = 0.9f;

/* Rounds to quanta. A clamped position is outside of the domain, and the sort drops the particle. */
SB_INLINE uint32_t moved(uint32_t from, float step)
{
    float bound = 1.0e9f;
    step = step < -bound ? -bound : step > bound ? bound : step;
    int64_t to = (int64_t)from + (int64_t)rintf(step);
    return to < 0 ? 0 : to >= SB_POSITION_END ? SB_POSITION_END - 1 : (uint32_t)to;
}

/* Largest squared speed of the block (NaN if any speed is NaN), and its particle. */
typedef struct fastest {
    float square;
    size_t particle;
} fastest;

/* Writes the new velocities into the acceleration field, so that the old ones still exist if the run has diverged. */
SB_MULTIVERSION
static fastest accelerate(sb_sim *sim, size_t block)
{
    const sb_f4 dt = sb_splat((float)sim->report.time_step);
    const sb_f4 damping = sb_splat(sim->settling == SB_DAMPING || sim->settling == SB_CALMING ? SETTLE_DAMPING : 1.0f);
    const bool flat = sim->constant.dimension == 2;
    fastest top = {0, block * SB_BLOCK};
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        sb_f4 v = (sim->velocity[i] + sim->acceleration[i] * dt) * damping;
        v[3] = sim->unknown[i] * sim->density[i] * sim->density[i];
        if (flat) v[1] = 0;
        float square = sb_sum3(v * v);
        if (!(square <= top.square)) top = (fastest){square, i};
        if (isnan(square)) return top;
        sim->acceleration[i] = v;
    }
    return top;
}

/* The velocity with which a particle moves. A particle under pressure moves with the velocity at the step's end, which
   the solve has made divergence-free. A particle without neighbours moves with the mean of the velocities before and
   after the step, and so follows its ballistic parabola. */
SB_INLINE sb_f4 moving_velocity(const sb_sim *sim, size_t i, sb_f4 start, sb_f4 end)
{
    return sim->diagonal[i] > 0 ? end : (start + end) * sb_splat(0.5f);
}

/* Moves the particles of a group. Returns their largest squared speed, after contact resolution. book: whether to
   compute the group's terms of the ledger. */
SB_INLINE float move_group(sb_sim *sim, const sb_group *group, bool book, double terms[SB_TALLY_TERMS])
{
    const sb_f4 *start = sim->scratch;
    sb_ledger_tally tally = {0};
    const float step = sim->settling == SB_START_TRIAL ? 0 : (float)(sim->report.time_step / sim->space.quantum);
    const sb_f4 keep = sim->settling == SB_CREEPING ? (sb_f4){0, 0, 0, 1} : sb_splat(1);
    float top = 0;
    for (size_t i = group->first; i < group->end; i++) {
        sb_f4 v = sim->acceleration[i];
        const sb_f4 way = book ? moving_velocity(sim, i, start[i], v) : v;
        const uint32_t height = sim->position[i][2];
        sim->position[i] =
            (sb_record){moved(sim->position[i][0], way[0] * step), moved(sim->position[i][1], way[1] * step),
                        moved(sim->position[i][2], way[2] * step), 0};
        if (book) sb_ledger_add(&tally, start[i], sim->velocity[i], v, (int64_t)sim->position[i][2] - height);
        sim->velocity[i] = book ? v : v * keep;
        float square = sb_sum3(v * v);
        top = square > top ? square : top;
    }
    if (book) sb_ledger_terms(&tally, terms);
    return top;
}

SB_MULTIVERSION
static double move(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    return (double)(sim->settling ? move_group(sim, group, false, terms) : move_group(sim, group, true, terms));
}

sb_status sb_sim_diverged(const sb_sim *sim, size_t particle, sb_f4 velocity, sb_error *error)
{
    const sb_vec3 at = sb_space_position(&sim->space, sim->position[particle]);
    return sb_fail(error, SB_FAILED,
                   "step %llu, t = %g s: diverged: particle %u at (%.4g, %.4g, %.4g) m would move at %g m/s, "
                   "expected below %g (density error %.3g after %d iterations)",
                   (unsigned long long)sim->report.step + 1, sim->report.time, sim->id[particle], at.x, at.y, at.z,
                   (double)sqrtf(sb_sum3(velocity * velocity)), (double)sim->constant.speed_limit,
                   sim->report.error_mean, sim->report.iterations);
}

/* Restores the velocities of the step's start: v* is not a state and may hold any values. */
static sb_status diverged(sb_sim *sim, fastest top, sb_error *error)
{
    sb_f4 *start = sim->scratch;
    sim->scratch = sim->velocity;
    sim->velocity = start;
    return sb_sim_diverged(sim, top.particle, (sb_f4){sqrtf(top.square)}, error);
}

/* The faster of two. NaN counts as the fastest, and of equal speeds the first particle's, so that the result does not
   depend on the threads. */
static fastest faster(fastest a, fastest b)
{
    if (isnan(a.square) || isnan(b.square))
        return isnan(a.square) && (!isnan(b.square) || a.particle < b.particle) ? a : b;
    if (a.square == b.square) return a.particle < b.particle ? a : b;
    return a.square > b.square ? a : b;
}

sb_status sb_stage_accelerate(sb_sim *sim, sb_error *error)
{
    const size_t blocks = sb_blocks(sim);
    fastest top = {0, SIZE_MAX};
#pragma omp parallel
    {
        fastest own = {0, SIZE_MAX};
#pragma omp for schedule(static) nowait
        for (size_t b = 0; b < blocks; b++) own = faster(own, accelerate(sim, b));
#pragma omp critical(sb_fastest)
        top = faster(top, own);
    }
    if (!(top.square <= sim->constant.speed_limit * sim->constant.speed_limit)) return diverged(sim, top, error);
    return SB_OK;
}

sb_status sb_stage_move(sb_sim *sim, sb_error *error)
{
    (void)error;
    double sum[SB_TALLY_TERMS];
    const double top = sb_sum_groups(sim, SB_TALLY_TERMS, move, sum);
    sb_ledger_sums *s = &sim->step_sums;
    double *const sums[SB_TALLY_TERMS] = {&s->forces,  &s->solve,   &s->fall,    &s->rise,
                                          &s->gain[0], &s->gain[1], &s->gain[2], &s->size};
    for (size_t k = 0; k < SB_TALLY_TERMS; k++) *sums[k] = sum[k];
    if (!sim->settling) sb_ledger_close(sim);
    sim->report.max_speed = sqrt(fmax(top, 0));
    sim->report.time += sim->settling ? 0 : sim->report.time_step;
    sim->report.step += !sim->settling;
    return SB_OK;
}
