/* Which cells a rank sends. The neighbour search of a group reads the cells of its block and those beside the block. A
   rank sends a cell to each rank that has such a block near it, or near one of its images beyond periodic sides;
   whether the block holds particles is not asked, which saves a message. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/search/sort.h"

#include <string.h>

/* Blocks along each axis, ends included. */
typedef struct span {
    int64_t from[3], to[3];
} span;

/* Blocks along an axis whose groups read one of the cells [first, last] there: for block b the cells 2 b - 1 to 2 b + 2
   are read, and in 2D only its own along y. */
static void blocks_near(const sb_sim *sim, span *s, int axis, int64_t first, int64_t last)
{
    const int beside = sim->constant.dimension == 2 && axis == 1 ? 0 : 1;
    s->from[axis] = (first - beside) >> 1;
    s->to[axis] = (last + beside) >> 1;
}

/* The same for the images of a cell, `sides` periods away along an axis. Returns false if it has none there. */
static bool blocks_near_image(const sb_sim *sim, span *s, int axis, int64_t cell, int sides)
{
    const sb_space *space = &sim->space;
    const int64_t size = (int64_t)1 << space->shift, low = sb_space_low(space), period = space->period[axis];
    const int64_t begin = cell * size, end = begin + size - 1;
    if (sides > 0 && !(begin - low < size)) return false;
    if (sides < 0 && !(low + period - end < size)) return false;
    blocks_near(sim, s, axis, (begin + sides * period) >> space->shift, (end + sides * period) >> space->shift);
    return true;
}

/* The ranks near one cell; `done`: those found already, which are few. */
typedef struct ranks_near {
    size_t count;
    int rank[SB_RANKS_MAX];
} ranks_near;

static void note(ranks_near *near, int rank)
{
    for (size_t k = 0; k < near->count; k++)
        if (near->rank[k] == rank) return;
    near->rank[near->count++] = rank;
}

/* Notes the ranks that own blocks of a span; itself: this one as well. */
static void note_owners(const sb_sim *sim, const span *s, bool itself, ranks_near *near)
{
    const int shift = sim->space.shift;
    for (int64_t z = s->from[2]; z <= s->to[2]; z++)
        for (int64_t y = s->from[1]; y <= s->to[1]; y++)
            for (int64_t x = s->from[0]; x <= s->to[0]; x++) {
                if (x < 0 || y < 0 || z < 0) continue;
                const sb_record corner = {(uint32_t)(2 * x) << shift, (uint32_t)(2 * y) << shift,
                                          (uint32_t)(2 * z) << shift, 0};
                const uint64_t key = sb_space_key(&sim->space, corner);
                if (itself || !sb_domains_owns(sim->domains, key)) note(near, sb_domains_owner(sim->domains, key));
            }
}

/* Finds the ranks that read a cell: that of `at`. */
static void find_ranks(const sb_sim *sim, sb_record at, ranks_near *near)
{
    const sb_space *space = &sim->space;
    near->count = 0;
    for (int turn = 0; turn < 27; turn++) {
        const int sides[3] = {(turn + 1) % 3 - 1, (turn / 3 + 1) % 3 - 1, (turn / 9 + 1) % 3 - 1};
        span s;
        bool there = true;
        for (int axis = 0; axis < 3 && there; axis++) {
            const int64_t cell = at[axis] >> space->shift;
            if (sides[axis] == 0)
                blocks_near(sim, &s, axis, cell, cell);
            else
                there = space->period[axis] > 0 && blocks_near_image(sim, &s, axis, cell, sides[axis]);
        }
        if (there) note_owners(sim, &s, false, near);
        if (!space->repeats) return;
    }
}

size_t sb_domains_readers(const sb_sim *sim, sb_record at, int rank[SB_RANKS_MAX])
{
    span s;
    ranks_near near;
    near.count = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int64_t cell = at[axis] >> sim->space.shift;
        blocks_near(sim, &s, axis, cell, cell);
    }
    note_owners(sim, &s, true, &near);
    memcpy(rank, near.rank, near.count * sizeof *rank);
    return near.count;
}

/* Whether all blocks around that of a group are this rank's, and none has images. */
static bool is_inner(const sb_sim *sim, const sb_group *group)
{
    const sb_record at = sim->state.position[group->first];
    const int shift = sim->space.shift;
    span s;
    for (int axis = 0; axis < 3; axis++) {
        const int64_t block = at[axis] >> shift >> 1;
        blocks_near(sim, &s, axis, 2 * block, 2 * block + 1);
        const int64_t begin = (2 * block) << shift, end = begin + ((int64_t)2 << shift),
                      low = sb_space_low(&sim->space);
        const int64_t period = sim->space.period[axis], cell = (int64_t)1 << shift;
        if (period > 0 && (begin < low + cell || end > low + period - cell)) return false;
    }
    ranks_near near;
    near.count = 0;
    note_owners(sim, &s, false, &near);
    return near.count == 0;
}

enum { CELL_BITS = 32, RANK_BITS = 10 }; /* of a pair of rank and cell */
_Static_assert(SB_RANKS_MAX <= 1 << RANK_BITS, "a rank in a pair");

/* Pairs of rank and cell. */
typedef struct pairs {
    uint64_t *pair;
    size_t count, capacity;
} pairs;

static int append(pairs *to, const uint64_t *pair, size_t count)
{
    if (count == 0) return 0;
    if (sb_grow((void **)&to->pair, &to->capacity, to->count + count, sizeof *pair) != 0) return -1;
    memcpy(to->pair + to->count, pair, count * sizeof *pair);
    to->count += count;
    return 0;
}

/* Lists the ranks to which the cells of a group are to be sent. */
static int list_group(const sb_sim *sim, const sb_group *group, pairs *to)
{
    const sb_cells *cells = &sim->cells;
    if (is_inner(sim, group)) return 0;
    size_t cell = (size_t)sb_cells_find(cells, sb_cell_code(sim->state.position[group->first], sim->space.shift));
    for (; cell < cells->count && cells->begin[cell] < group->end; cell++) {
        ranks_near near;
        uint64_t pair[SB_RANKS_MAX];
        find_ranks(sim, sim->state.position[cells->begin[cell]], &near);
        for (size_t k = 0; k < near.count; k++) pair[k] = (uint64_t)near.rank[k] << CELL_BITS | cell;
        if (append(to, pair, near.count) != 0) return -1;
    }
    return 0;
}

/* Lists the pairs of rank and cell that are to be sent, in order. Returns where they are; NULL without memory. */
static const uint64_t *list_cells(sb_sim *sim, pairs *all)
{
    sb_domains *d = sim->domains;
    const size_t groups = sim->groups.count;
    bool failed = false;
#pragma omp parallel reduction(|| : failed)
    {
        pairs own = {.count = 0};
#pragma omp for schedule(dynamic, 32) nowait
        for (size_t g = 0; g < groups; g++)
            if (!failed) failed = list_group(sim, &sim->groups.group[g], &own) != 0;
#pragma omp critical(sb_halo)
        failed = append(all, own.pair, own.count) != 0 || failed;
        sb_free(own.pair);
    }
    if (failed || sb_grow((void **)&d->pairs, &d->pairs_capacity, all->count + 1, sizeof *d->pairs) != 0) return NULL;
    if (all->count == 0) return d->pairs;
    return sb_sort(all->pair, d->pairs, all->count, 0, CELL_BITS + RANK_BITS);
}

/* Appends a cell to the plan. same: it goes to the rank of the run before. */
static void plan_cell(sb_halo_plan *plan, uint32_t begin, uint32_t size, bool same)
{
    sb_run *last = same ? &plan->run[plan->runs - 1] : NULL;
    if (last && last->begin + last->count == begin)
        last->count += size;
    else {
        plan->place[plan->runs] = plan->sent;
        plan->run[plan->runs++] = (sb_run){begin, size};
    }
    plan->sent += size;
}

static void clear_plan(sb_halo_plan *plan, size_t ranks)
{
    plan->runs = plan->sent = 0;
    memset(plan->sends, 0, ranks * sizeof *plan->sends);
}

int sb_domains_plan_sends(sb_sim *sim)
{
    sb_domains *d = sim->domains;
    sb_halo_plan *plan = &d->plan;
    pairs all = {.count = 0};
    clear_plan(plan, (size_t)d->ranks->count);
    const uint64_t *pair = list_cells(sim, &all);
    const int status =
        pair && sb_grow((void **)&plan->run, &plan->run_capacity, all.count, sizeof *plan->run) == 0 &&
                sb_grow((void **)&plan->place, &plan->place_capacity, all.count, sizeof *plan->place) == 0
            ? 0
            : -1;
    for (size_t k = 0; k < all.count && status == 0; k++) {
        const size_t rank = (size_t)(pair[k] >> CELL_BITS), cell = pair[k] & UINT32_MAX;
        const uint32_t begin = sim->cells.begin[cell], size = sim->cells.begin[cell + 1] - begin;
        plan_cell(plan, begin, size, k > 0 && pair[k - 1] >> CELL_BITS == rank);
        plan->sends[rank] += size;
    }
    sb_free(all.pair);
    return status;
}
