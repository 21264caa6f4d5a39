#include "sim/passes/cpu/pools.h"

#include "base/memory.h"

#include <string.h>

enum { ARRAYS = 2 }; /* of a pool; all but the pairs with walls have one */

typedef struct pool {
    const char *what;
    size_t *used, *capacity; /* entries */
    struct {
        void **entries;
        size_t size; /* of an entry; 0: there is no such array */
    } array[ARRAYS];
} pool;

/* The lists of one thread that are copied into a pool. */
typedef struct part {
    size_t *count;
    const void *array[ARRAYS];
} part;

typedef struct pools {
    pool of[SB_POOLS];
} pools;

#define ENTRIES(array) (void **)&(array), sizeof *(array)

static pools pools_of(sb_sim *sim)
{
    sb_lists *water = &sim->work.pairs;
    sb_pairs *walls = &sim->work.wall_pairs;
    sb_edge_pairs *edges = &sim->work.edge_pairs;
    sb_groups *g = &sim->groups;
    return (pools){{
        [SB_POOL_FOURS] =
            {"groups of four pairs of neighbours", &water->used, &water->capacity, {{ENTRIES(water->four)}}},
        [SB_POOL_WALLS] =
            {"pairs with walls", &walls->used, &walls->capacity, {{ENTRIES(walls->index)}, {ENTRIES(walls->slope)}}},
        [SB_POOL_EDGES] = {"pairs at edges", &edges->used, &edges->capacity, {{ENTRIES(edges->pair)}}},
        [SB_POOL_RUNS] = {"runs of records", &g->used, &g->room, {{ENTRIES(g->run)}}},
        [SB_POOL_IMAGES] = {"images of particles", &g->images_used, &g->images_room, {{ENTRIES(g->image)}}},
        [SB_POOL_PLANES] = {"planes near groups", &g->planes_used, &g->planes_room, {{ENTRIES(g->plane)}}},
    }};
}

void sb_pools_clear(sb_sim *sim)
{
    const pools all = pools_of(sim);
    for (int p = 0; p < SB_POOLS; p++) *all.of[p].used = 0;
}

/* Copies one kind of list, if there is room. Returns whether there is. */
static bool append(const pool *to, const part *from, size_t *at)
{
    const size_t count = *from->count;
    *at = __atomic_fetch_add(to->used, count, __ATOMIC_RELAXED);
    *from->count = 0;
    if (*at + count > *to->capacity) return false;
    for (int a = 0; a < ARRAYS && count > 0; a++) {
        const size_t size = to->array[a].size;
        if (size > 0) memcpy((char *)*to->array[a].entries + *at * size, from->array[a], count * size);
    }
    return true;
}

bool sb_pools_append(sb_sim *sim, sb_list_builder *lists, size_t at[SB_POOLS])
{
    const pools all = pools_of(sim);
    const part parts[SB_POOLS] = {
        [SB_POOL_FOURS] = {&lists->fours, {lists->four}},
        [SB_POOL_WALLS] = {&lists->walls, {lists->wall, lists->wall_slope}},
        [SB_POOL_EDGES] = {&lists->edges, {lists->edge}},
        [SB_POOL_RUNS] = {&lists->runs, {lists->run}},
        [SB_POOL_IMAGES] = {&lists->images, {lists->image}},
        [SB_POOL_PLANES] = {&lists->planes, {lists->plane}},
    };
    bool room = true;
    for (int p = 0; p < SB_POOLS; p++) room &= append(&all.of[p], &parts[p], &at[p]);
    return room;
}

/* New size of a pool that was too small. A larger reserve costs memory for the rest of the run, a smaller one another
   search now and then. */
static size_t with_reserve(size_t used)
{
    return used + used / 32 + 1024;
}

/* Returns 0, or -1 without memory. */
static int enlarge(const pool *of)
{
    const size_t capacity = with_reserve(*of->used);
    *of->capacity = 0;
    for (int a = 0; a < ARRAYS; a++) {
        if (of->array[a].size == 0) continue;
        sb_free(*of->array[a].entries);
        *of->array[a].entries = sb_alloc_untouched(capacity, of->array[a].size);
        if (!*of->array[a].entries) return -1;
    }
    *of->capacity = capacity;
    return 0;
}

sb_status sb_pools_enlarge(sb_sim *sim, sb_error *error)
{
    const pools all = pools_of(sim);
    for (int p = 0; p < SB_POOLS; p++) {
        const pool *of = &all.of[p];
        if (*of->used > UINT32_MAX / 2) /* indices have 32 bits */
            return sb_fail(error, SB_FAILED, "%zu %s: expected fewer than 2^31; more ranks, or a coarser resolution",
                           *of->used, of->what);
        if (*of->used > *of->capacity && enlarge(of) != 0) return sb_fail_memory(error, "neighbour lists");
    }
    return SB_OK;
}
