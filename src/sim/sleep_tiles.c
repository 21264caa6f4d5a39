/* Which tiles are disturbed, and how far around them the water wakes. Sums are of integers: the same for any number
   of threads. */
#include "base/memory.h"
#include "sim/sleep.h"

#include <math.h>
#include <string.h>

enum { TILES_MAX = 1 << 20, UNIT = 1 << 20 };

/* In still depths D. A disturbance of water without a surface slope of its own dies off ahead as exp(-pi x / 2D) at
   least, so four depths leave 0.2 % of it; tiles are as wide as a half to one of them. */
static const double REACH = 4, WIDTH = 0.5;

/* In sqrt(g D), which no wave of small height outruns: the front's speed, which one of height D/5 has, and the mean
   horizontal velocity, over a tile of full depth, above which higher ones wake what lies ahead of them. Water awake
   and at rest was measured to stay below 0.008. */
static const double FRONT = 1.1, STIRRED = 0.02;

/* In sqrt(g D): a particle that fast stirs by itself whatever the mean says, for spray slower than the front stays
   behind it; and what counts as motion in the scene's start. */
static const float FAST = 1, AT_ALL = 1e-4f;

int sb_tiles_create(const sb_sim *sim, sb_tiles *tiles)
{
    const sb_space *space = &sim->space;
    const bool flat = sim->constant.dimension == 2;
    const sb_record high = sb_space_record(space, sim->model->max);
    const double depth = fmax(sim->model->still_depth, sim->scene->resolution);
    int shift = space->shift;
    do { /* two cells at least: what crosses more than one between two looks is fast, and wakes `reach` around it */
        shift++;
        for (int axis = 0; axis < 2; axis++)
            tiles->size[axis] = axis == 1 && flat ? 1 : ((high[axis] - sb_space_low(space) - 1) >> shift) + 1;
        tiles->count = (size_t)tiles->size[0] * tiles->size[1];
    } while (tiles->count > TILES_MAX || ldexp(space->quantum, shift) < WIDTH * depth);
    tiles->shift = shift;
    /* One more, for sources join between two ticks. */
    tiles->reach = (uint32_t)fmax(REACH, ceil(REACH * depth / ldexp(space->quantum, shift))) + 1;
    for (int axis = 0; axis < 2; axis++) tiles->wraps[axis] = space->period[axis] > 0;
    unsigned char **flags[] = {&tiles->awake,  &tiles->reached, &tiles->occupied, &tiles->stirred,
                               &tiles->fringe, &tiles->beside,  &tiles->spare};
    for (size_t f = 0; f < sizeof flags / sizeof *flags; f++)
        if (!(*flags[f] = sb_alloc(tiles->count, 1))) return -1;
    tiles->momentum = sb_alloc(tiles->count, sizeof *tiles->momentum);
    tiles->water = sb_alloc(tiles->count, sizeof *tiles->water);
    return tiles->momentum && tiles->water ? 0 : -1;
}

void sb_tiles_free(sb_tiles *tiles)
{
    sb_free(tiles->awake);
    sb_free(tiles->reached);
    sb_free(tiles->occupied);
    sb_free(tiles->stirred);
    sb_free(tiles->fringe);
    sb_free(tiles->beside);
    sb_free(tiles->spare);
    sb_free(tiles->momentum);
    sb_free(tiles->water);
}

size_t sb_tiles_bytes(const sb_tiles *tiles)
{
    return tiles->count * (7 + sizeof *tiles->momentum + sizeof *tiles->water);
}

/* Sums over particles one after another in the same tile. */
typedef struct run {
    int64_t x, y;
    uint32_t water;
    bool fast;
} run;

static void give(sb_tiles *tiles, size_t tile, const run *r)
{
    if (r->water == 0) return;
    __atomic_fetch_add(&tiles->momentum[tile][0], r->x, __ATOMIC_RELAXED);
    __atomic_fetch_add(&tiles->momentum[tile][1], r->y, __ATOMIC_RELAXED);
    __atomic_fetch_add(&tiles->water[tile], r->water, __ATOMIC_RELAXED);
    if (r->fast) __atomic_store_n(&tiles->stirred[tile], 1, __ATOMIC_RELAXED);
}

static void look_at_block(const sb_sim *sim, sb_tiles *tiles, size_t block)
{
    const float unit = (float)UNIT / sim->constant.wave_speed;
    const float fast = (sim->report.step == 0 ? AT_ALL : FAST) * sim->constant.wave_speed;
    size_t tile = 0;
    run r = {0};
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        const size_t here = sb_tile_of(sim, tiles, sim->position[i]);
        if (here != tile) {
            give(tiles, tile, &r);
            r = (run){0};
            tile = here;
        }
        const sb_f4 v = sim->velocity[i];
        r.x += llrintf(v[0] * unit);
        r.y += llrintf(v[1] * unit);
        r.water++;
        r.fast |= sb_sum3(v * v) > fast * fast;
    }
    give(tiles, tile, &r);
}

/* Bodies that a wave maker moves: waves start from those that have moved; near the others no stillness is trusted. */
static void mark_bodies(const sb_sim *sim, sb_tiles *tiles)
{
    const sb_wall_set *set = &sim->walls[SB_MOVING];
    for (size_t b = 0; b < set->count; b++) {
        const sb_moving_body *moving = &sim->moving[sim->moving_of_body[set->body[b]]];
        const size_t tile = sb_tile_of(sim, tiles, set->record[b]);
        tiles->stirred[tile] = 1;
        tiles->reached[tile] |= moving->displacement != 0 || moving->next_displacement != 0;
    }
}

/* Boxes of water fall from the start, and water flows out through open sides. */
static void mark_flows(const sb_sim *sim, sb_tiles *tiles)
{
    const sb_side_kind *side = sim->scene->domain.side;
    const uint32_t columns = tiles->size[0], rows = tiles->size[1];
    const bool flat = sim->constant.dimension == 2; /* without sides across y */
    for (size_t b = 0; b < sim->scene->box_count; b++) {
        const sb_fluid_box *box = &sim->scene->boxes[b];
        const size_t from = sb_tile_within(sim, tiles, sb_space_record(&sim->space, box->min));
        const size_t to = sb_tile_within(sim, tiles, sb_space_record(&sim->space, box->max));
        for (size_t y = from / columns; y <= to / columns; y++)
            for (size_t x = from % columns; x <= to % columns; x++) tiles->reached[y * columns + x] = 1;
    }
    for (size_t t = 0; t < tiles->count; t++) { /* the last tile may be narrow: the last two */
        const size_t x = t % columns, y = t / columns;
        const bool along_x =
            (x < 2 && side[SB_X_MIN] == SB_SIDE_OPEN) || (x + 2 >= columns && side[SB_X_MAX] == SB_SIDE_OPEN);
        const bool along_y =
            (y < 2 && side[SB_Y_MIN] == SB_SIDE_OPEN) || (y + 2 >= rows && side[SB_Y_MAX] == SB_SIDE_OPEN);
        tiles->reached[t] |= (along_x || (along_y && !flat)) && tiles->water[t] > 0;
    }
}

/* All water is awake still: how full tiles are, and what moves without a wave maker. */
static void start(const sb_sim *sim, sb_tiles *tiles)
{
    for (size_t t = 0; t < tiles->count; t++) {
        tiles->full = tiles->water[t] > tiles->full ? tiles->water[t] : tiles->full;
        tiles->reached[t] |= tiles->stirred[t];
    }
    mark_flows(sim, tiles);
}

void sb_tiles_look(const sb_sim *sim, sb_tiles *tiles)
{
    const size_t blocks = sb_blocks(sim);
    memset(tiles->momentum, 0, tiles->count * sizeof *tiles->momentum);
    memset(tiles->water, 0, tiles->count * sizeof *tiles->water);
    memset(tiles->stirred, 0, tiles->count);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) look_at_block(sim, tiles, b);
    if (sim->report.step == 0) start(sim, tiles);
    const double bound = STIRRED * (double)tiles->full * UNIT;
    for (size_t t = 0; t < tiles->count; t++) {
        tiles->occupied[t] = tiles->water[t] > 0;
        tiles->stirred[t] |= hypot((double)tiles->momentum[t][0], (double)tiles->momentum[t][1]) > bound;
    }
    mark_bodies(sim, tiles);
}

/* Marks the places within reach of marked ones along one line of tiles. Where the domain repeats the last tile may
   be narrower, so the reach is one more. */
static void spread_line(const unsigned char *from, unsigned char *to, int64_t length, size_t step, int64_t reach,
                        bool wraps)
{
    reach = reach + wraps < length ? reach + wraps : length;
    int64_t done = -length - 1;
    for (int64_t i = 0; i < length; i++) {
        if (!from[(size_t)i * step]) continue;
        for (int64_t k = done > i - reach ? done : i - reach; k <= i + reach; k++) {
            if (wraps)
                to[(size_t)((k + 2 * length) % length) * step] = 1;
            else if (k >= 0 && k < length)
                to[(size_t)k * step] = 1;
        }
        done = i + reach + 1;
    }
}

/* to: also the tiles within `reach` of those that are set in `from`, along both axes. */
static void spread(sb_tiles *tiles, const unsigned char *from, unsigned char *to, int64_t reach)
{
    const size_t columns = tiles->size[0], rows = tiles->size[1];
    memset(tiles->spare, 0, tiles->count);
    for (size_t y = 0; y < rows; y++)
        spread_line(from + y * columns, tiles->spare + y * columns, (int64_t)columns, 1, reach, tiles->wraps[0]);
    for (size_t x = 0; x < columns; x++)
        spread_line(tiles->spare + x, to + x, (int64_t)rows, columns, reach, tiles->wraps[1]);
}

bool sb_tiles_wake(const sb_sim *sim, sb_tiles *tiles)
{
    const double way = FRONT * (double)sim->constant.wave_speed * sim->report.time;
    const uint64_t ticks = (uint64_t)(way / ldexp(sim->space.quantum, tiles->shift));
    for (; tiles->ticks < ticks; tiles->ticks++) spread(tiles, tiles->reached, tiles->reached, 1);
    size_t before = 0, after = 0;
    for (size_t t = 0; t < tiles->count; t++) before += tiles->awake[t];
    spread(tiles, tiles->stirred, tiles->awake, tiles->reach);
    spread(tiles, tiles->reached, tiles->awake, tiles->reach);
    for (size_t t = 0; t < tiles->count; t++) after += tiles->awake[t];
    return after > before;
}

bool sb_tiles_fringe(sb_tiles *tiles)
{
    bool changed = false;
    for (size_t t = 0; t < tiles->count; t++) tiles->stirred[t] = tiles->awake[t] | tiles->occupied[t];
    memset(tiles->beside, 0, tiles->count);
    spread(tiles, tiles->stirred, tiles->beside, 1);
    for (size_t t = 0; t < tiles->count; t++) {
        const unsigned char fringe = tiles->beside[t] && !tiles->awake[t];
        changed |= fringe != tiles->fringe[t];
        tiles->fringe[t] = fringe;
    }
    sb_tiles_beside(tiles);
    return changed;
}

void sb_tiles_beside(sb_tiles *tiles)
{
    memset(tiles->beside, 0, tiles->count);
    spread(tiles, tiles->fringe, tiles->beside, 1);
}
