/* The pass that finds the neighbours of all particles. Each thread searches a few groups at a time and copies their
   lists into shared pools. */
#include "base/memory.h"
#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/pools.h"
#include "sim/passes/cpu/searcher.h"
#include "sim/passes/groups.h"
#include "sim/walls/mirrors.h"

#include <stdlib.h>
#include <string.h>

/* A group with more facets or images around it than the search can hold, which is to be divided. */
static bool is_crowded(const sb_group *group)
{
    return group->runs == UINT32_MAX;
}

/* Copies the lists of groups [begin, end) into the pools. Groups that are to be divided have none. */
static bool publish(sb_sim *sim, sb_list_builder *lists, size_t begin, size_t end)
{
    sb_groups *groups = &sim->groups;
    size_t at[SB_POOLS];
    const bool room = sb_pools_append(sim, lists, at);
    for (size_t g = begin; g < end; g++) {
        if (is_crowded(&groups->group[g])) continue;
        groups->group[g].run += (uint32_t)at[SB_POOL_RUNS];
        groups->group[g].image += (uint32_t)at[SB_POOL_IMAGES];
        groups->group[g].plane += (uint32_t)at[SB_POOL_PLANES];
        for (size_t i = groups->group[g].first; i < groups->group[g].end; i++) {
            sim->work.pairs.first[i] += (uint32_t)at[SB_POOL_FOURS];
            if (sim->needs.wall_lists) sim->work.wall_pairs.first[i] += (uint32_t)at[SB_POOL_WALLS];
            if (sim->needs.images) sim->work.edge_pairs.first[i] += (uint32_t)at[SB_POOL_EDGES];
        }
    }
    return room;
}

/* Searches a group. One that is too crowded and can be divided is marked. */
static unsigned search_one(sb_sim *sim, const sb_search_form *form, void *searcher, sb_list_builder *lists,
                           sb_group *group)
{
    unsigned full = form->search(sim, searcher, lists, group);
    if (!(full & SB_CROWDED) || group->end - group->first == 1) return full;
    group->runs = UINT32_MAX;
    return full & ~(unsigned)(SB_FULL_FACETS | SB_CROWDED);
}

/* Searches the groups from `from` on. *too_small: a pool was too small; *full: the limits that were exceeded. Returns
   0, or -1 without memory. */
static int search_groups(sb_sim *sim, const sb_search_form *form, size_t from, bool *too_small, unsigned *full)
{
    unsigned over = 0;
    bool small = false, memory = false;
    const size_t groups = sim->groups.count;
    const size_t units = (groups - from + SB_GROUPS_AT_A_TIME - 1) / SB_GROUPS_AT_A_TIME;
#pragma omp parallel reduction(| : small, over, memory)
    {
        void *searcher = form->create(sim);
        sb_list_builder lists = {.out_of_memory = !searcher};
#pragma omp for schedule(dynamic, 1)
        for (size_t u = 0; u < units; u++) {
            const size_t begin = from + u * SB_GROUPS_AT_A_TIME;
            const size_t end = begin + SB_GROUPS_AT_A_TIME < groups ? begin + SB_GROUPS_AT_A_TIME : groups;
            for (size_t g = begin; g < end && !lists.out_of_memory; g++)
                over |= search_one(sim, form, searcher, &lists, &sim->groups.group[g]);
            if (!lists.out_of_memory) small |= !publish(sim, &lists, begin, end);
        }
        memory |= lists.out_of_memory;
        sb_list_builder_free(&lists);
        sb_free(searcher);
    }
    *too_small = small;
    *full = over;
    return memory ? -1 : 0;
}

static int by_place(const void *a, const void *b)
{
    const sb_group *x = a, *y = b;
    return (x->first > y->first) - (x->first < y->first);
}

/* Divides the crowded groups in half, at the end of the others. *from: the first of the halves. Returns 0, or -1
   without memory. */
static int divide(sb_groups *groups, size_t *from)
{
    size_t kept = 0, crowded = 0;
    for (size_t g = 0; g < groups->count; g++) crowded += is_crowded(&groups->group[g]);
    sb_group *half = sb_alloc(2 * crowded + 1, sizeof *half);
    const size_t all = groups->count + crowded;
    if (!half || sb_grow((void **)&groups->group, &groups->capacity, all, sizeof *half) != 0) {
        sb_free(half);
        return -1;
    }
    crowded = 0;
    for (size_t g = 0; g < groups->count; g++) {
        const sb_group whole = groups->group[g];
        if (!is_crowded(&whole)) {
            groups->group[kept++] = whole;
            continue;
        }
        const uint32_t middle = whole.first + (whole.end - whole.first) / 2;
        half[crowded++] = (sb_group){.first = whole.first, .end = middle};
        half[crowded++] = (sb_group){.first = middle, .end = whole.end};
    }
    if (crowded > 0) memcpy(groups->group + kept, half, crowded * sizeof *half);
    sb_free(half);
    groups->count = all;
    *from = kept;
    return 0;
}

/* One search of all groups. Groups with too many facets or images around them are divided until they have few enough.
   Arguments as those of search_groups. */
static int attempt(sb_sim *sim, const sb_search_form *form, bool *too_small, unsigned *full)
{
    size_t from = 0;
    bool divided = false;
    *too_small = false;
    *full = 0;
    sb_pools_clear(sim);
    for (;;) {
        bool small;
        unsigned over;
        if (search_groups(sim, form, from, &small, &over) != 0 || divide(&sim->groups, &from) != 0) return -1;
        *too_small |= small;
        *full |= over;
        if (from == sim->groups.count) break;
        divided = true;
    }
    /* In the order of their particles again. */
    if (divided) qsort(sim->groups.group, sim->groups.count, sizeof *sim->groups.group, by_place);
    return 0;
}

static sb_status refuse(const sb_sim *sim, unsigned full, sb_error *error)
{
    static const char *const dense = "the water has collapsed, or the boundary particles are too dense";
    const unsigned long long step = (unsigned long long)sim->state.step;
    if (full & SB_FULL_WALLS) return sb_wall_finder_refuse(sim, full, error);
    if (full & SB_FULL_FACETS)
        return sb_fail(error, SB_FAILED,
                       "step %llu: too many facets of walls within %g m of one particle: expected fewer than %d facets "
                       "and %d images of particles; smoother meshes, wider gaps between bodies, or "
                       "numerics.preset: paper",
                       step, (double)sim->constant.support, SB_NEAR_MAX, SB_AROUND_MAX);
    return sb_fail(error, SB_FAILED, "step %llu: more than %d particles around %s: %s", step,
                   full & SB_FULL_LIST ? SB_LIST_MAX : SB_AROUND_MAX,
                   full & SB_FULL_LIST ? "one particle" : "a block of eight cells", dense);
}

sb_status sb_search_all(sb_sim *sim, const sb_search_form *form, sb_error *error)
{
    for (;;) {
        bool too_small;
        unsigned full;
        if (attempt(sim, form, &too_small, &full) != 0) return sb_fail_memory(error, "neighbour lists");
        if (full) return refuse(sim, full, error);
        if (!too_small) return SB_OK;
        const sb_status status = sb_pools_enlarge(sim, error);
        if (status != SB_OK) return status;
    }
}

sb_status sb_cpu_neighbours(sb_sim *sim, sb_error *error)
{
    static const sb_search_form form = {sb_searcher_create, sb_search_group};
    return sb_search_all(sim, &form, error);
}
