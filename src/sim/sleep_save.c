/* Sleepers on their way into an archive and back. The fringe is that of the last look at the water, so it is kept. */
#include "base/archive.h"
#include "base/memory.h"
#include "sim/sleep.h"
#include "sim/wall_entry.h"

#include <math.h>

void sb_sleep_save(const sb_sim *sim, sb_archive_out *out)
{
    const sb_sleep *sleep = sim->sleep;
    sb_put_flag(out, sleep != NULL);
    if (!sleep) return;
    const sb_tiles *tiles = &sleep->tiles;
    sb_put_count(out, tiles->full);
    sb_put_count(out, tiles->ticks);
    sb_put_list(out, tiles->awake, tiles->count, 1);
    sb_put_list(out, tiles->reached, tiles->count, 1);
    sb_put_list(out, tiles->fringe, tiles->count, 1);
    sb_put_list(out, sleep->position, sleep->count, sizeof *sleep->position);
    sb_put_list(out, sleep->pressure, sleep->count, sizeof *sleep->pressure);
    sb_put_list(out, sleep->density, sleep->count, sizeof *sleep->density);
    sb_put_list(out, sleep->id, sleep->count, sizeof *sleep->id);
    sb_put_list(out, sleep->held, sleep->held_count, sizeof *sleep->held);
    sb_put_count(out, sleep->particle_steps);
    sb_put_count(out, sleep->asleep_steps);
    sb_put_real(out, sleep->woken);
    const size_t heard = sleep->settled_q ? sim->model->fluid_count : 0; /* while it settles */
    sb_put_list(out, sleep->settled_q, heard, sizeof *sleep->settled_q);
    sb_put_list(out, sleep->settled_push, heard, sizeof *sleep->settled_push);
    sb_put_real(out, (double)sleep->share);
}

static void take_tiles(sb_tiles *tiles, sb_archive_in *in)
{
    tiles->full = (uint32_t)sb_take_count(in, UINT32_MAX);
    tiles->ticks = sb_take_count(in, UINT64_MAX);
    unsigned char *flags[] = {tiles->awake, tiles->reached, tiles->fringe};
    for (size_t f = 0; f < sizeof flags / sizeof *flags; f++) {
        sb_take_list(in, flags[f], tiles->count, 1);
        for (size_t t = 0; t < tiles->count; t++)
            if (flags[f][t] > 1) sb_archive_refuse(in, "tile %zu is marked by %u, expected 0 or 1", t, flags[f][t]);
    }
    for (size_t t = 0; t < tiles->count; t++)
        if (tiles->fringe[t] && tiles->awake[t])
            sb_archive_refuse(in, "tile %zu is awake and at the fringe of sleep", t);
}

/* Whether sleeper s is one: of this model, over a tile asleep, none before `tile`. */
static bool sound(const sb_sim *sim, size_t s, size_t tile, size_t *own)
{
    const sb_sleep *sleep = sim->sleep;
    const sb_record at = sleep->position[s];
    if (at[0] >= SB_POSITION_END || at[1] >= SB_POSITION_END || at[2] >= SB_POSITION_END) return false;
    *own = sb_tile_of(sim, &sleep->tiles, at);
    return *own >= tile && !sleep->tiles.awake[*own] && sleep->id[s] < sim->model->fluid_count &&
           isfinite(sleep->pressure[s]) && isfinite(sleep->density[s]) && sleep->density[s] > 0;
}

static int take_sleepers(sb_sim *sim, sb_archive_in *in)
{
    sb_sleep *sleep = sim->sleep;
    sleep->count = sb_take_length(in, sizeof *sleep->position, sim->model->fluid_count - sim->n);
    if (sb_sleepers_reserve(sleep) != 0) return -1;
    sb_take_list(in, sleep->position, sleep->count, sizeof *sleep->position);
    sb_take_list(in, sleep->pressure, sleep->count, sizeof *sleep->pressure);
    sb_take_list(in, sleep->density, sleep->count, sizeof *sleep->density);
    sb_take_list(in, sleep->id, sleep->count, sizeof *sleep->id);
    size_t tile = 0;
    for (size_t s = 0; s < sleep->count && in->error.status == SB_OK; s++) {
        size_t own = 0;
        if (!sound(sim, s, tile, &own))
            sb_archive_refuse(in, "sleeper %zu: expected one of this model, in the order of tiles asleep", s);
        for (; tile < own; tile++) sleep->first[tile + 1] = s;
    }
    for (; tile < sleep->tiles.count; tile++) sleep->first[tile + 1] = sleep->count;
    return 0;
}

static int take_held(sb_sim *sim, sb_archive_in *in)
{
    sb_sleep *sleep = sim->sleep;
    const size_t bodies = sim->model->body_count;
    size_t capacity = 0;
    sleep->held_count = sb_take_length(in, sizeof *sleep->held, sleep->tiles.count * bodies);
    if (sb_grow((void **)&sleep->held, &capacity, sleep->held_count, sizeof *sleep->held) != 0) return -1;
    sb_take_list(in, sleep->held, sleep->held_count, sizeof *sleep->held);
    for (size_t h = 0; h < sleep->held_count; h++)
        if (sleep->held[h].tile >= sleep->tiles.count || sleep->held[h].body >= bodies) {
            sb_archive_refuse(in, "a force held on body %u, expected fewer than %zu", sleep->held[h].body, bodies);
            sleep->held_count = 0;
        }
    sb_held_wake(sim);
    return 0;
}

/* A particle that no wall has pushed names none. */
static bool heard_well(const sb_sim *sim, size_t i)
{
    const sb_settled_push *heard = &sim->sleep->settled_push[i];
    const float *push = heard->push;
    const bool pushed = push[0] != 0 || push[1] != 0 || push[2] != 0;
    if (!isfinite(push[0] + push[1] + push[2] + sim->sleep->settled_q[i])) return false;
    return !pushed || sb_wall_particle(heard->wall) < sb_wall_set_of(sim, heard->wall)->count;
}

/* What settling has heard so far. 0, or -1 without memory. */
static int take_heard(sb_sim *sim, sb_archive_in *in)
{
    sb_sleep *sleep = sim->sleep;
    const size_t count = sim->settle.under_way ? sim->model->fluid_count : 0;
    if (count > 0) {
        sleep->settled_q = sb_alloc(count, sizeof *sleep->settled_q);
        sleep->settled_push = sb_alloc(count, sizeof *sleep->settled_push);
        if (!sleep->settled_q || !sleep->settled_push) return -1;
    }
    sb_take_list(in, sleep->settled_q, count, sizeof *sleep->settled_q);
    sb_take_list(in, sleep->settled_push, count, sizeof *sleep->settled_push);
    for (size_t i = 0; i < count && in->error.status == SB_OK; i++)
        if (!heard_well(sim, i))
            sb_archive_refuse(in, "what settling heard of particle %zu: expected finite numbers, and a wall's", i);
    sleep->share = (float)sb_take_real(in);
    if (!(sleep->share >= 0 && sleep->share <= 1))
        sb_archive_refuse(in, "a share of %g of what settling hears, expected 0 to 1", (double)sleep->share);
    return 0;
}

/* 0, or -1 without memory. */
static int take(sb_sim *sim, sb_archive_in *in)
{
    sb_sleep *sleep = sim->sleep;
    take_tiles(&sleep->tiles, in);
    if (take_sleepers(sim, in) != 0 || take_held(sim, in) != 0) return -1;
    sleep->particle_steps = sb_take_count(in, UINT64_MAX);
    sleep->asleep_steps = sb_take_count(in, UINT64_MAX);
    sleep->woken = sb_take_real(in);
    if (take_heard(sim, in) != 0) return -1;
    if (in->error.status != SB_OK) return 0;
    sb_tiles_beside(&sleep->tiles);
    sim->report.fluid_count += sleep->count;
    if (sb_cells_build(&sleep->cells, sleep->position, sleep->count, sim->space.shift) != 0) return -1;
    return sb_sleepers_fringe(sim);
}

sb_status sb_sleep_load(sb_sim *sim, sb_archive_in *in, sb_error *error)
{
    sb_sleep_destroy(sim);
    if (!sb_take_flag(in)) return SB_OK;
    if (!sb_sleep_wanted(sim->scene)) {
        sb_archive_refuse(in, "water asleep, expected none in this scene");
        return SB_OK;
    }
    if (sb_sleep_make(sim) == 0 && take(sim, in) == 0) {
        if (in->error.status != SB_OK) sb_sleep_destroy(sim);
        return SB_OK;
    }
    sb_sleep_destroy(sim);
    return sb_fail_memory(error, "still water");
}
