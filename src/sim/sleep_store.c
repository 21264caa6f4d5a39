/* The sleepers' own arrays: from the simulation's to them, back, and to the fringe. */
#include "base/memory.h"
#include "sim/sleep.h"
#include "sim/sort.h"

#include <string.h>

/* How many particles sleep over each tile, summed up: first. Of those that the sort has left: a look at the water
   before it has seen more. */
static void count_sleepers(sb_sim *sim)
{
    sb_sleep *sleep = sim->sleep;
    const sb_tiles *tiles = &sleep->tiles;
    memset(sleep->first, 0, (tiles->count + 1) * sizeof *sleep->first);
    for (size_t i = 0; i < sim->n; i++) {
        const size_t tile = sb_tile_of(sim, tiles, sim->position[i]);
        sleep->first[tile + 1] += !tiles->awake[tile];
    }
    for (size_t t = 0; t < tiles->count; t++) sleep->first[t + 1] += sleep->first[t];
    sleep->count = sleep->first[tiles->count];
}

int sb_sleepers_reserve(sb_sleep *sleep)
{
    void *before[] = {sleep->position, sleep->pressure, sleep->density, sleep->id};
    for (size_t f = 0; f < sizeof before / sizeof before[0]; f++) sb_free(before[f]);
    sleep->position = sb_alloc_untouched(sleep->count, sizeof *sleep->position);
    sleep->pressure = sb_alloc_untouched(sleep->count, sizeof *sleep->pressure);
    sleep->density = sb_alloc_untouched(sleep->count, sizeof *sleep->density);
    sleep->capacity = sleep->count;
    sleep->id = sb_alloc_untouched(sleep->count, sizeof *sleep->id);
    return sleep->position && sleep->pressure && sleep->density && sleep->id ? 0 : -1;
}

int sb_sleepers_take(sb_sim *sim, const float *density)
{
    sb_sleep *sleep = sim->sleep;
    const sb_tiles *tiles = &sleep->tiles;
    count_sleepers(sim);
    size_t *next = sb_alloc(tiles->count, sizeof *next), kept = 0;
    if (!next || sb_sleepers_reserve(sleep) != 0) {
        sb_free(next);
        return -1;
    }
    memcpy(next, sleep->first, tiles->count * sizeof *next);
    for (size_t i = 0; i < sim->n; i++) {
        const sb_record at = sim->position[i];
        const size_t tile = sb_tile_of(sim, tiles, at);
        if (tiles->awake[tile]) {
            sim->position[kept] = at;
            sim->velocity[kept] = sim->velocity[i];
            sim->density[kept] = density[sim->id[i]];
            sim->id[kept++] = sim->id[i];
            continue;
        }
        const size_t to = next[tile]++;
        sleep->position[to] = (sb_record){at[0], at[1], at[2], 0};
        sleep->density[to] = density[sim->id[i]];
        sleep->pressure[to] = sleep->settled_q[sim->id[i]] * sleep->density[to] * sleep->density[to];
        sleep->id[to] = sim->id[i];
    }
    sb_free(next);
    sim->n = kept;
    if (sb_cells_build(&sim->cells, sim->position, sim->n, sim->space.shift) != 0) return -1;
    return sb_cells_build(&sleep->cells, sleep->position, sleep->count, sim->space.shift);
}

static void give_back(sb_sim *sim, size_t from, size_t end)
{
    const sb_sleep *sleep = sim->sleep;
    for (size_t s = from; s < end; s++, sim->n++) {
        sim->position[sim->n] = sleep->position[s];
        sim->velocity[sim->n] = (sb_f4){0, 0, 0, sleep->pressure[s]};
        sim->id[sim->n] = sleep->id[s];
    }
}

int sb_sleepers_wake(sb_sim *sim)
{
    sb_sleep *sleep = sim->sleep;
    size_t kept = 0, end = 0;
    for (size_t t = 0; t < sleep->tiles.count; t++) {
        const size_t from = end, count = sleep->first[t + 1] - from;
        end = sleep->first[t + 1];
        if (sleep->tiles.awake[t]) {
            give_back(sim, from, end);
        } else {
            memmove(sleep->position + kept, sleep->position + from, count * sizeof *sleep->position);
            memmove(sleep->pressure + kept, sleep->pressure + from, count * sizeof *sleep->pressure);
            memmove(sleep->density + kept, sleep->density + from, count * sizeof *sleep->density);
            memmove(sleep->id + kept, sleep->id + from, count * sizeof *sleep->id);
            kept += count;
        }
        sleep->first[t + 1] = kept;
    }
    sleep->count = kept;
    return sb_cells_build(&sleep->cells, sleep->position, sleep->count, sim->space.shift);
}

/* Those of the fringe with their images: how many, and where `made` is given, what they are, each with its sleeper in
   the last lane. */
static size_t list_fringe(const sb_sim *sim, sb_record *made)
{
    const sb_sleep *sleep = sim->sleep;
    size_t found = 0;
    for (size_t t = 0; t < sleep->tiles.count; t++) {
        if (!sleep->tiles.fringe[t]) continue;
        for (size_t s = sleep->first[t]; s < sleep->first[t + 1]; s++) {
            sb_record image[SB_IMAGES_MAX];
            const int images = sim->space.repeats ? sb_space_images(&sim->space, sleep->position[s], image) : 0;
            for (int k = -1; k < images; k++, found++) {
                if (!made) continue;
                made[found] = k < 0 ? sleep->position[s] : image[k];
                made[found][3] = (uint32_t)s;
            }
        }
    }
    return found;
}

/* In the order of `sorted`. */
static void copy_fringe(sb_sim *sim, const sb_record *made, const uint64_t *sorted)
{
    sb_sleep *sleep = sim->sleep;
    for (size_t f = 0; f < sleep->fringe; f++) {
        const sb_record at = made[sb_word_index(sorted[f])];
        const float density = sleep->density[at[3]];
        sleep->fringe_q[f] = sleep->pressure[at[3]] / (density * density);
        sleep->fringe_density[f] = density;
        sleep->fringe_position[f] = (sb_record){at[0], at[1], at[2], 0};
    }
}

static void drop_fringe(sb_sleep *sleep)
{
    sb_free(sleep->fringe_position);
    sb_free(sleep->fringe_q);
    sb_free(sleep->fringe_density);
    sleep->fringe_position = NULL;
    sleep->fringe_q = sleep->fringe_density = NULL;
}

int sb_sleepers_fringe(sb_sim *sim)
{
    sb_sleep *sleep = sim->sleep;
    const size_t count = list_fringe(sim, NULL);
    drop_fringe(sleep);
    sleep->fringe = count;
    sleep->fringe_position = sb_alloc_untouched(count, sizeof *sleep->fringe_position);
    sleep->fringe_q = sb_alloc_untouched(count, sizeof *sleep->fringe_q);
    sleep->fringe_density = sb_alloc_untouched(count, sizeof *sleep->fringe_density);
    sb_record *made = sb_alloc_untouched(count, sizeof *made);
    uint64_t *words = sb_alloc_untouched(count, sizeof *words), *other = sb_alloc_untouched(count, sizeof *other);
    int status = -1;
    if (!sleep->fringe_position || !sleep->fringe_q || !sleep->fringe_density || !made || !words || !other) goto done;
    list_fringe(sim, made);
    for (size_t f = 0; f < count; f++) words[f] = sb_sort_word(sb_space_key(&sim->space, made[f]), f);
    const uint64_t *sorted = sb_sort(words, other, count, SB_INDEX_BITS, SB_INDEX_BITS + sim->space.key_bits);
    if (!sorted) goto done;
    copy_fringe(sim, made, sorted);
    status = sb_cells_build(&sleep->fringe_cells, sleep->fringe_position, count, sim->space.shift);
done:
    sb_free(made);
    sb_free(words);
    sb_free(other);
    return status;
}
