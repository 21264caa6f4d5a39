/* The two passes of a pressure iteration: where a run spends its time. Per neighbour one 16-byte record,
   one index and one stored W'/r; walls are one vector per particle and cost nothing per neighbour. */
#include "sim/pressure.h"
#include "sim/simd_wide.h"
#include "sim/sleep.h"

/* Sleepers keep their pressure and density, and are never searched along. */
static void load_fringe(sb_sim *sim, const float *argument)
{
    const sb_sleep *sleep = sim->sleep;
    const float *held = argument == sim->unknown   ? sleep->fringe_q
                        : argument == sim->density ? sleep->fringe_density
                                                   : NULL;
    sb_record *position = sim->position + sb_fringe_first(sim);
    for (size_t f = 0; f < sleep->fringe; f++)
        sb_carry(&position[f], held ? held[f] : 0);
}

void sb_pressure_load(sb_sim *sim, const float *argument)
{
    const size_t n = sim->n;
    sb_record *position = sim->position;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++)
        sb_carry(&position[i], argument[i]);
    if (sb_fringe_count(sim) > 0)
        load_fringe(sim, argument);
    const size_t ghosts = sim->ghosts.count;
    const uint32_t *of = sim->ghosts.of;
    if (ghosts == 0)
        return;
#pragma omp parallel for schedule(static)
    for (size_t g = 0; g < ghosts; g++)
        sb_carry(&position[n + g], argument[of[g]]);
}

/* The records of two neighbours. */
SB_INLINE sb_f8 two(const sb_f4 *of, const uint32_t *index)
{
    return sb_beside(of[index[0]], of[index[1]]);
}

SB_MULTIVERSION
static void accelerate_block(sb_sim *sim, size_t block)
{
    const sb_f4 *position = (const sb_f4 *)sim->position;
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        const uint32_t *index = sim->pairs.index + sim->pairs.first[i];
        const float *slope = sim->pairs.slope + sim->pairs.first[i];
        const sb_f8 self = sb_beside(position[i], position[i]), q = sb_carried8(self);
        sb_f8 even = {0}, odd = {0};
        for (size_t k = 0; k < sim->pairs.count[i]; k += 4) {
            const sb_f8 a = two(position, index + k), b = two(position, index + k + 2);
            even += sb_offset8(self, a) * ((q + sb_carried8(a)) * sb_spread(slope[k], slope[k + 1]));
            odd += sb_offset8(self, b) * ((q + sb_carried8(b)) * sb_spread(slope[k + 2], slope[k + 3]));
        }
        const sb_f4 sum = sb_halves(even + odd) + sb_carried((sb_record)position[i]) * sim->wall[i];
        sim->acceleration[i] = (sb_f4){-sum[0], -sum[1], -sum[2], 0};
    }
}

SB_MULTIVERSION
static void diverge_block(sb_sim *sim, size_t block, float dt2, float *out)
{
    const sb_f4 *position = (const sb_f4 *)sim->position;
    const sb_f4 *acceleration = sim->acceleration;
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        const uint32_t *index = sim->pairs.index + sim->pairs.first[i];
        const float *slope = sim->pairs.slope + sim->pairs.first[i];
        const sb_f8 self = sb_beside(position[i], position[i]), own = sb_beside(acceleration[i], acceleration[i]);
        sb_f8 even = {0}, odd = {0};
        for (size_t k = 0; k < sim->pairs.count[i]; k += 4) {
            const uint32_t *a = index + k, *b = index + k + 2;
            even += sb_offset8(self, two(position, a)) *
                    ((own - two(acceleration, a)) * sb_spread(slope[k], slope[k + 1]));
            odd += sb_offset8(self, two(position, b)) *
                   ((own - two(acceleration, b)) * sb_spread(slope[k + 2], slope[k + 3]));
        }
        out[i] = dt2 * sb_sum3(sb_halves(even + odd) + acceleration[i] * sim->wall[i]);
    }
}

void sb_pressure_accelerate(sb_sim *sim)
{
    const size_t blocks = sb_blocks(sim);
#pragma omp parallel for schedule(dynamic, 1)
    for (size_t b = 0; b < blocks; b++)
        accelerate_block(sim, b);
}

void sb_pressure_diverge(sb_sim *sim, float *out)
{
    const size_t blocks = sb_blocks(sim);
    const float dt = (float)sim->report.time_step;
#pragma omp parallel for schedule(dynamic, 1)
    for (size_t b = 0; b < blocks; b++)
        diverge_block(sim, b, dt * dt, out);
}

void sb_pressure_product(sb_sim *sim, float *out)
{
    sb_pressure_accelerate(sim);
    sb_ghosts_refresh(sim, sim->acceleration);
    sb_pressure_diverge(sim, out);
}

void sb_pressure_residual(sb_sim *sim)
{
    const size_t n = sim->n;
    sb_pressure_load(sim, sim->unknown);
    sb_pressure_product(sim, sim->residual);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++)
        sim->residual[i] -= sim->source[i];
}
