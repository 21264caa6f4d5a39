/* What sleepers do to bodies, which goes on as it was in the mean of settling's last steps, and to the water awake. */
#include "base/memory.h"
#include "sim/around.h"
#include "sim/impulse.h"
#include "sim/sleep.h"

#include <string.h>

/* Particles in the order of their tiles, storage order within one; first: tiles + 1. NULL without memory. */
static uint32_t *by_tile(const sb_sim *sim, const sb_tiles *tiles, size_t *first)
{
    uint32_t *order = sb_alloc_untouched(sim->n, sizeof *order);
    if (!order) return NULL;
    memset(first, 0, (tiles->count + 1) * sizeof *first);
    for (size_t t = 0; t + 1 < tiles->count; t++) first[t + 2] = first[t + 1] + tiles->water[t];
    for (size_t i = 0; i < sim->n; i++) order[first[sb_tile_of(sim, tiles, sim->position[i]) + 1]++] = (uint32_t)i;
    return order;
}

/* What particle i did to bodies in the last steps of settling, by pressure and by contact. */
static void add_particle(const sb_sim *sim, size_t i, double *sum)
{
    const sb_settled_push *mean = &sim->sleep->settled_push[sim->id[i]];
    const double whole = 1 / (1 - (double)sim->sleep->share); /* room was made for a step that did not come */
    sb_impulse_of_pressure(sim, i, sum);
    if (mean->push[0] != 0 || mean->push[1] != 0 || mean->push[2] != 0)
        sb_impulse_of_push(
            sim, i, mean->wall,
            sb_vec(whole * (double)mean->push[0], whole * (double)mean->push[1], whole * (double)mean->push[2]), sum);
}

static bool is_nothing(const double value[SB_IMPULSE_VALUES])
{
    for (size_t k = 0; k < SB_IMPULSE_VALUES; k++)
        if (value[k] != 0) return false;
    return true;
}

/* Adds the bodies that one tile's sum is not zero for to the list. */
static int append(sb_sleep *sleep, size_t *capacity, size_t tile, const double *sum, size_t bodies)
{
    for (size_t body = 0; body < bodies; body++) {
        const double *value = sum + body * SB_IMPULSE_VALUES;
        if (is_nothing(value)) continue;
        if (sb_grow((void **)&sleep->held, capacity, sleep->held_count + 1, sizeof *sleep->held) != 0) return -1;
        sb_held_force *held = &sleep->held[sleep->held_count++];
        *held = (sb_held_force){.tile = (uint32_t)tile, .body = (uint32_t)body};
        memcpy(held->value, value, sizeof held->value);
    }
    return 0;
}

static void sum_held(sb_sim *sim)
{
    sb_sleep *sleep = sim->sleep;
    memset(sleep->held_sum, 0, sim->model->body_count * SB_IMPULSE_VALUES * sizeof *sleep->held_sum);
    for (size_t h = 0; h < sleep->held_count; h++)
        for (size_t v = 0; v < SB_IMPULSE_VALUES; v++)
            sleep->held_sum[sleep->held[h].body * SB_IMPULSE_VALUES + v] += sleep->held[h].value[v];
}

int sb_held_take(sb_sim *sim)
{
    sb_sleep *sleep = sim->sleep;
    const sb_tiles *tiles = &sleep->tiles;
    const size_t bodies = sim->model->body_count;
    size_t *first = sb_alloc(tiles->count + 1, sizeof *first), capacity = 0;
    double *sum = sb_alloc(bodies * SB_IMPULSE_VALUES, sizeof *sum);
    uint32_t *order = first ? by_tile(sim, tiles, first) : NULL;
    int status = order && sum ? 0 : -1;
    for (size_t t = 0; t < tiles->count && status == 0; t++) {
        if (tiles->awake[t]) continue;
        memset(sum, 0, bodies * SB_IMPULSE_VALUES * sizeof *sum);
        for (size_t k = first[t]; k < first[t + 1]; k++) add_particle(sim, order[k], sum);
        status = append(sleep, &capacity, t, sum, bodies);
    }
    if (status == 0) sum_held(sim);
    sb_free(first);
    sb_free(sum);
    sb_free(order);
    return status;
}

void sb_held_wake(sb_sim *sim)
{
    sb_sleep *sleep = sim->sleep;
    size_t kept = 0;
    for (size_t h = 0; h < sleep->held_count; h++)
        if (!sleep->tiles.awake[sleep->held[h].tile]) sleep->held[kept++] = sleep->held[h];
    sleep->held_count = kept;
    sum_held(sim);
}

void sb_held_press(sb_sim *sim, double dt)
{
    const sb_sleep *sleep = sim->sleep;
    for (size_t body = 0; sleep && sleep->held_count > 0 && body < sim->model->body_count; body++)
        sb_impulse_add(&sim->impulse[body], dt, sleep->held_sum + body * SB_IMPULSE_VALUES);
}

/* One block's sum, into three values. */
static void sum_block(const sb_sim *sim, size_t block, sb_sleep_share *of, const void *with, double *sum)
{
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const size_t end = sb_block_end(sim, block);
    for (size_t i = block * SB_BLOCK; i < end;) {
        const sb_group *group = sb_group_of(sim, i);
        const size_t stop = group->end < end ? group->end : end;
        if (group->sleepers == sb_around_count(sim, group)) {
            i = stop;
            continue;
        }
        sb_around_with(sim, group, sim->velocity, around);
        if (sim->eddy) sb_around_last(sim, group, sim->eddy, around);
        for (; i < stop; i++) {
            const sb_f4 share = of(sim, group, around, i, with);
            for (int axis = 0; axis < 3; axis++) sum[axis] += (double)share[axis];
        }
    }
}

sb_vec3 sb_sleep_sum(const sb_sim *sim, sb_sleep_share *of, const void *with)
{
    const size_t blocks = sb_blocks(sim);
    const unsigned char *beside = sim->sleep->block_beside;
    double *partial = sim->partial;
#pragma omp parallel for schedule(dynamic, 1)
    for (size_t b = 0; b < blocks; b++) {
        double sum[3] = {0};
        if (beside[b]) sum_block(sim, b, of, with, sum);
        memcpy(partial + 3 * b, sum, sizeof sum);
    }
    sb_vec3 total = {0};
    for (size_t b = 0; b < blocks; b++)
        total = sb_add(total, sb_vec(partial[3 * b], partial[3 * b + 1], partial[3 * b + 2]));
    return sb_scale(total, (double)sim->constant.mass);
}

/* -sum over sleepers j of m (q_i + q_j) grad W_ij. */
static sb_f4 pressure_share(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i, const void *with)
{
    (void)with;
    const sb_four_pairs *four = sim->pairs.four + sim->pairs.first[i], *end = four + sim->pairs.count[i];
    const sb_f4 self = sb_in_group(sim, group, i);
    sb_f4 sum = {0};
    for (; four < end; four++)
        for (int k = 0; k < 4; k++) {
            const sb_f4 other = *sb_at_with(around, four->place[k]);
            if (four->place[k] >= group->sleepers * SB_PLACE_STEP)
                sum -= (self - other) * sb_splat((self[3] + other[3]) * sb_slopes(four)[k]);
        }
    return sum * sb_splat(sim->pairs.unit);
}

void sb_sleep_support(sb_sim *sim)
{
    if (sb_fringe_count(sim) > 0) sim->sleep->support = sb_sleep_sum(sim, pressure_share, NULL);
}
