/* The symplectic update [S16, eqs. 17, 18]. */
#include "sim/ledger.h"
#include "sim/stages.h"

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

/* Moves the particles of a block. Returns their largest squared speed, after contact resolution. book: whether to enter
   the block's work in the ledger. */
SB_INLINE float move_block(sb_sim *sim, size_t block, bool book)
{
    const sb_f4 *start = sim->scratch;
    sb_ledger_tally tally = {0};
    const float step = sim->settling == SB_START_TRIAL ? 0 : (float)(sim->report.time_step / sim->space.quantum);
    const sb_f4 keep = sim->settling == SB_CREEPING ? (sb_f4){0, 0, 0, 1} : sb_splat(1);
    float top = 0;
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
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
    if (book) sb_ledger_store(&tally, &sim->block_ledger[block]);
    return top;
}

SB_MULTIVERSION
static float move(sb_sim *sim, size_t block)
{
    return sim->settling ? move_block(sim, block, false) : move_block(sim, block, true);
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

sb_status sb_stage_accelerate(sb_sim *sim, sb_error *error)
{
    const size_t blocks = sb_blocks(sim);
    fastest top = {0, 0};
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        fastest found = accelerate(sim, b);
        sim->partial[2 * b] = (double)found.square;
        sim->partial[2 * b + 1] = (double)found.particle;
    }
    for (size_t b = 0; b < blocks && !isnan(top.square); b++)
        if (!(sim->partial[2 * b] <= (double)top.square))
            top = (fastest){(float)sim->partial[2 * b], (size_t)sim->partial[2 * b + 1]};
    if (!(top.square <= sim->constant.speed_limit * sim->constant.speed_limit)) return diverged(sim, top, error);
    return SB_OK;
}

sb_status sb_stage_move(sb_sim *sim, sb_error *error)
{
    (void)error;
    const size_t blocks = sb_blocks(sim);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) sim->partial[b] = (double)move(sim, b);
    if (!sim->settling) sb_ledger_close(sim);
    double top = 0;
    for (size_t b = 0; b < blocks; b++) top = sim->partial[b] > top ? sim->partial[b] : top;
    sim->report.max_speed = sqrt(top);
    sim->report.time += sim->settling ? 0 : sim->report.time_step;
    sim->report.step += !sim->settling;
    return SB_OK;
}
