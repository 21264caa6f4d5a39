/* The pass that finds the neighbours of all particles. Each thread searches a few groups at a time and copies their
   lists into shared pools. */
#include "base/memory.h"
#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/lists.h"
#include "sim/passes/cpu/searcher.h"
#include "sim/passes/groups.h"
#include "sim/walls/mirrors.h"

#include <stdlib.h>
#include <string.h>

/* Reserves `count` entries of a pool, from *at on. Returns false if the pool is too small; `used` is then the size
   needed. The place in the pool depends on timing; the contents do not. */
static bool take(size_t *used, size_t capacity, size_t count, size_t *at)
{
    *at = __atomic_fetch_add(used, count, __ATOMIC_RELAXED);
    return *at + count <= capacity;
}

/* A group with more facets or images around it than the search can hold, which is to be divided. */
static bool is_crowded(const sb_group *group)
{
    return group->runs == UINT32_MAX;
}

/* Copies the lists of groups [begin, end) into the pools. Groups that are to be divided have none. */
static bool publish(sb_sim *sim, sb_list_builder *lists, size_t begin, size_t end)
{
    sb_groups *groups = &sim->groups;
    size_t four, wall, run, image, plane, edge;
    bool room = take(&sim->work.pairs.used, sim->work.pairs.capacity, lists->fours, &four);
    room &= take(&sim->work.wall_pairs.used, sim->work.wall_pairs.capacity, lists->walls, &wall);
    room &= take(&groups->used, groups->room, lists->runs, &run);
    room &= take(&groups->images_used, groups->images_room, lists->images, &image);
    room &= take(&sim->work.edge_pairs.used, sim->work.edge_pairs.capacity, lists->edges, &edge);
    room &= take(&groups->planes_used, groups->planes_room, lists->planes, &plane);
    if (room && lists->fours > 0) memcpy(sim->work.pairs.four + four, lists->four, lists->fours * sizeof *lists->four);
    if (room && lists->walls > 0) {
        memcpy(sim->work.wall_pairs.index + wall, lists->wall, lists->walls * sizeof *lists->wall);
        memcpy(sim->work.wall_pairs.slope + wall, lists->wall_slope, lists->walls * sizeof *lists->wall_slope);
    }
    if (room && lists->runs > 0) memcpy(groups->run + run, lists->run, lists->runs * sizeof *lists->run);
    if (room && lists->images > 0) memcpy(groups->image + image, lists->image, lists->images * sizeof *lists->image);
    if (room && lists->planes > 0) memcpy(groups->plane + plane, lists->plane, lists->planes * sizeof *lists->plane);
    if (room && lists->edges > 0)
        memcpy(sim->work.edge_pairs.pair + edge, lists->edge, lists->edges * sizeof *lists->edge);
    for (size_t g = begin; g < end; g++) {
        if (is_crowded(&groups->group[g])) continue;
        groups->group[g].run += (uint32_t)run;
        groups->group[g].image += (uint32_t)image;
        groups->group[g].plane += (uint32_t)plane;
        for (size_t i = groups->group[g].first; i < groups->group[g].end; i++) {
            sim->work.pairs.first[i] += (uint32_t)four;
            if (sim->needs.wall_lists) sim->work.wall_pairs.first[i] += (uint32_t)wall;
            if (sim->needs.images) sim->work.edge_pairs.first[i] += (uint32_t)edge;
        }
    }
    lists->fours = lists->walls = lists->runs = lists->images = lists->planes = lists->edges = 0;
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
    sim->work.pairs.used = sim->work.wall_pairs.used = sim->groups.used = 0;
    sim->groups.images_used = sim->groups.planes_used = sim->work.edge_pairs.used = 0;
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

/* New size of a pool that was too small. A larger reserve costs memory for the rest of the run, a smaller one another
   search now and then. */
static size_t with_reserve(size_t used)
{
    return used + used / 32 + 1024;
}

/* A larger array in place of one that was too small; NULL without memory. */
static void *renewed(void *array, size_t used, size_t size)
{
    sb_free(array);
    return sb_alloc_untouched(with_reserve(used), size);
}

static size_t capacity_of(const void *array, size_t used)
{
    return array ? with_reserve(used) : 0;
}

/* Enlarges the pools that were too small. Returns 0, or -1 without memory. */
static int enlarge(sb_sim *sim)
{
    sb_lists *water = &sim->work.pairs;
    sb_pairs *wall = &sim->work.wall_pairs;
    sb_edge_pairs *edges = &sim->work.edge_pairs;
    sb_groups *groups = &sim->groups;
    if (water->used > water->capacity) {
        water->four = renewed(water->four, water->used, sizeof *water->four);
        water->capacity = capacity_of(water->four, water->used);
    }
    if (wall->used > wall->capacity) {
        wall->index = renewed(wall->index, wall->used, sizeof *wall->index);
        wall->slope = renewed(wall->slope, wall->used, sizeof *wall->slope);
        wall->capacity = wall->slope ? capacity_of(wall->index, wall->used) : 0;
    }
    if (edges->used > edges->capacity) {
        edges->pair = renewed(edges->pair, edges->used, sizeof *edges->pair);
        edges->capacity = capacity_of(edges->pair, edges->used);
    }
    if (groups->used > groups->room) {
        groups->run = renewed(groups->run, groups->used, sizeof *groups->run);
        groups->room = capacity_of(groups->run, groups->used);
    }
    if (groups->images_used > groups->images_room) {
        groups->image = renewed(groups->image, groups->images_used, sizeof *groups->image);
        groups->images_room = capacity_of(groups->image, groups->images_used);
    }
    if (groups->planes_used > groups->planes_room) {
        groups->plane = renewed(groups->plane, groups->planes_used, sizeof *groups->plane);
        groups->planes_room = capacity_of(groups->plane, groups->planes_used);
    }
    return water->used <= water->capacity && wall->used <= wall->capacity && edges->used <= edges->capacity &&
                   groups->used <= groups->room && groups->images_used <= groups->images_room &&
                   groups->planes_used <= groups->planes_room
               ? 0
               : -1;
}

/* The pools are indexed by 32 bits. */
static sb_status check_sizes(const sb_sim *sim, sb_error *error)
{
    const struct {
        size_t used;
        const char *what;
    } pools[] = {
        {sim->work.pairs.used, "groups of four pairs of neighbours"},
        {sim->work.wall_pairs.used, "pairs with walls"},
        {sim->work.edge_pairs.used, "pairs at edges"},
        {sim->groups.used, "runs of records"},
        {sim->groups.images_used, "images of particles"},
        {sim->groups.planes_used, "planes near groups"},
    };
    for (size_t p = 0; p < sizeof pools / sizeof *pools; p++)
        if (pools[p].used > UINT32_MAX / 2)
            return sb_fail(error, SB_FAILED, "%zu %s: expected fewer than 2^31; more ranks, or a coarser resolution",
                           pools[p].used, pools[p].what);
    return SB_OK;
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
        const sb_status status = check_sizes(sim, error);
        if (status != SB_OK) return status;
        if (enlarge(sim) != 0) return sb_fail_memory(error, "neighbour lists");
    }
}

sb_status sb_cpu_neighbours(sb_sim *sim, sb_error *error)
{
    static const sb_search_form form = {sb_searcher_create, sb_search_group};
    return sb_search_all(sim, &form, error);
}
