#include "sim/passes/cpu/lists.h"

#include "base/memory.h"

#include <string.h>

/* Packs hits into groups of four, eight hits at a time. */
SB_MULTIVERSION
static void write_fours(sb_four_pairs *four, const sb_hits *h)
{
    typedef uint32_t eight __attribute__((vector_size(32), aligned(4)));
    typedef uint16_t eight_u16 __attribute__((vector_size(16)));
    for (size_t k = 0; k < h->padded; k += SB_HIT_LANES, four += 2) {
        const eight candidate = *(const eight *)(h->candidate + k);
        const sb_f8 root = *(const sb_f8 *)(h->root + k);
        const eight_u16 place = __builtin_convertvector(candidate * SB_PLACE_STEP, eight_u16);
        const eight_u16 slope = __builtin_convertvector(__builtin_convertvector(root, eight), eight_u16);
        memcpy(four[0].place, &place, sizeof four->place);
        memcpy(four[1].place, (const char *)&place + sizeof four->place, sizeof four->place);
        memcpy(four[0].slope, &slope, sizeof four->slope);
        memcpy(four[1].slope, (const char *)&slope + sizeof four->slope, sizeof four->slope);
    }
}

/* Returns the number of groups of four, 0 without memory. */
static size_t append(sb_list_builder *lists, const sb_hits *hits)
{
    const size_t fours = (hits->count + 3) / 4, written = hits->padded / 4;
    if (sb_grow((void **)&lists->four, &lists->capacity_four, lists->fours + written, sizeof *lists->four) != 0) {
        lists->out_of_memory = true;
        return 0;
    }
    write_fours(lists->four + lists->fours, hits);
    lists->fours += fours;
    return fours;
}

void sb_list_water(sb_list_builder *lists, const sb_hits *hits, sb_sim *sim, size_t i)
{
    sim->work.pairs.first[i] = (uint32_t)lists->fours;
    sim->work.pairs.count[i] = (uint16_t)append(lists, hits);
    if (sim->work.pairs.direct) sim->work.pairs.direct[i] = sim->work.pairs.count[i];
}

void sb_list_reflected(sb_list_builder *lists, const sb_hits *hits, sb_sim *sim, size_t i)
{
    sim->work.pairs.count[i] = (uint16_t)(sim->work.pairs.count[i] + append(lists, hits));
}

void sb_list_walls(sb_list_builder *lists, const sb_hits *hits, sb_sim *sim, size_t i)
{
    const size_t padded = (hits->count + 3) / 4 * 4, needed = lists->walls + padded;
    sim->work.wall_pairs.first[i] = (uint32_t)lists->walls;
    if (sb_grow((void **)&lists->wall, &lists->capacity_wall, needed, sizeof *lists->wall) != 0 ||
        sb_grow((void **)&lists->wall_slope, &lists->capacity_slope, needed, sizeof *lists->wall_slope) != 0) {
        lists->out_of_memory = true;
        return;
    }
    memcpy(lists->wall + lists->walls, hits->candidate, hits->count * sizeof *lists->wall);
    memcpy(lists->wall_slope + lists->walls, hits->slope, hits->count * sizeof *lists->wall_slope);
    for (size_t k = hits->count; k < padded; k++) {
        lists->wall[lists->walls + k] = hits->candidate[0];
        lists->wall_slope[lists->walls + k] = 0;
    }
    lists->walls = needed;
    sim->work.wall_pairs.count[i] = (uint16_t)padded;
}

void sb_list_runs(sb_list_builder *lists, const sb_vicinity *v, sb_group *group)
{
    if (sb_grow((void **)&lists->run, &lists->capacity_run, lists->runs + v->runs, sizeof *lists->run) != 0) {
        lists->out_of_memory = true;
        return;
    }
    memcpy(lists->run + lists->runs, v->run, v->runs * sizeof *v->run);
    group->run = (uint32_t)lists->runs;
    group->runs = (uint32_t)v->runs;
    lists->runs += v->runs;
}

void sb_list_builder_free(sb_list_builder *lists)
{
    sb_free(lists->four);
    sb_free(lists->wall);
    sb_free(lists->wall_slope);
    sb_free(lists->run);
    sb_free(lists->image);
    sb_free(lists->plane);
    sb_free(lists->edge);
}
