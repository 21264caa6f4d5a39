/* The halo: the particles of other domains around the own groups. The neighbour search of a group reads the cells of
   its block and those beside the block. A rank sends a cell to each rank that has such a block near it, or near one of
   its images beyond periodic sides; whether the block holds particles is not asked, which saves a message. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/exchange/images.h"
#include "sim/search/sort.h"

#include <stdlib.h>
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

/* Notes the other ranks that own blocks of a span. */
static void note_owners(const sb_sim *sim, const span *s, ranks_near *near)
{
    const int shift = sim->space.shift;
    for (int64_t z = s->from[2]; z <= s->to[2]; z++)
        for (int64_t y = s->from[1]; y <= s->to[1]; y++)
            for (int64_t x = s->from[0]; x <= s->to[0]; x++) {
                if (x < 0 || y < 0 || z < 0) continue;
                const sb_record corner = {(uint32_t)(2 * x) << shift, (uint32_t)(2 * y) << shift,
                                          (uint32_t)(2 * z) << shift, 0};
                const uint64_t key = sb_space_key(&sim->space, corner);
                if (!sb_domains_owns(sim->domains, key)) note(near, sb_domains_owner(sim->domains, key));
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
        if (there) note_owners(sim, &s, near);
        if (!space->repeats) return;
    }
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
    note_owners(sim, &s, &near);
    return near.count == 0;
}

enum { CELL_BITS = 40 }; /* of a pair of rank and cell */

/* Lists the pairs of rank and cell that are to be sent. Returns 0, or -1 without memory. */
static int list_cells(sb_sim *sim, size_t *count)
{
    sb_domains *d = sim->domains;
    const sb_cells *cells = &sim->cells;
    size_t cell = 0;
    *count = 0;
    for (size_t g = 0; g < sim->groups.count; g++) {
        const sb_group *group = &sim->groups.group[g];
        const bool inner = is_inner(sim, group);
        for (; cell < cells->count && cells->begin[cell] < group->end; cell++) {
            ranks_near near;
            if (inner) continue;
            find_ranks(sim, sim->state.position[cells->begin[cell]], &near);
            if (sb_grow((void **)&d->rank_of, &d->rank_of_capacity, *count + near.count, sizeof *d->rank_of) != 0)
                return -1;
            for (size_t k = 0; k < near.count; k++) d->rank_of[(*count)++] = (uint64_t)near.rank[k] << CELL_BITS | cell;
        }
    }
    return 0;
}

static int by_rank(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Makes the plan of what this rank sends. Returns 0, or -1 without memory. */
static int plan_sends(sb_sim *sim)
{
    sb_domains *d = sim->domains;
    sb_halo_plan *plan = &d->plan;
    size_t count;
    const size_t ranks = (size_t)d->ranks->count;
    plan->runs = plan->sent = 0;
    memset(plan->first, 0, (ranks + 1) * sizeof *plan->first);
    memset(plan->sends, 0, ranks * sizeof *plan->sends);
    if (list_cells(sim, &count) != 0) return -1;
    if (sb_grow((void **)&plan->run, &plan->run_capacity, count, sizeof *plan->run) != 0) return -1;
    if (count > 0) qsort(d->rank_of, count, sizeof *d->rank_of, by_rank);
    size_t next = 0; /* the rank whose first run is to be set */
    for (size_t k = 0; k < count; k++) {
        const size_t rank = (size_t)(d->rank_of[k] >> CELL_BITS),
                     cell = d->rank_of[k] & (((uint64_t)1 << CELL_BITS) - 1);
        const uint32_t begin = sim->cells.begin[cell], size = sim->cells.begin[cell + 1] - begin;
        const bool same = next > rank; /* as that of the run before */
        while (next <= rank) plan->first[next++] = plan->runs;
        sb_run *last = same ? &plan->run[plan->runs - 1] : NULL;
        if (last && last->begin + last->count == begin)
            last->count += size;
        else
            plan->run[plan->runs++] = (sb_run){begin, size};
        plan->sends[rank] += size;
        plan->sent += size;
    }
    while (next <= ranks) plan->first[next++] = plan->runs;
    return 0;
}

/* Reads from the matrix what this rank receives. Returns the size of the halo. */
static size_t plan_receives(sb_sim *sim)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count, own = (size_t)d->ranks->rank;
    size_t halo = 0;
    sim->ghosts.lower = 0;
    for (size_t r = 0; r < ranks; r++) {
        d->plan.receives[r] = d->matrix[r * ranks + own];
        halo += d->plan.receives[r];
        if (r < own) sim->ghosts.lower += d->plan.receives[r];
    }
    return halo;
}

/* Room for the halo, its cells' particles and the bytes that are sent. Returns 0, or -1 without memory. */
static int reserve(sb_sim *sim, size_t halo)
{
    sb_domains *d = sim->domains;
    const size_t most = sizeof(sb_f4);
    if (sb_grow((void **)&d->out, &d->out_capacity, d->plan.sent * most, 1) != 0 ||
        sb_grow((void **)&d->in, &d->in_capacity, halo * sizeof(float), 1) != 0)
        return -1;
    return sb_ghosts_reserve(sim, halo, 0);
}

/* Makes the halo's positions and cells. */
static sb_status make_halo(sb_sim *sim, sb_error *error)
{
    sb_domains *d = sim->domains;
    sb_ghosts *g = &sim->ghosts;
    g->halo = g->lower = g->count = 0;
    int failed = plan_sends(sim);
    for (int r = 0; r < d->ranks->count; r++) d->row[r] = d->plan.sends[r];
    sb_domains_gather_row(d);
    const size_t halo = plan_receives(sim);
    if (failed == 0) failed = reserve(sim, halo);
    sb_status status =
        sb_domains_agree(sim, failed ? sb_fail_memory(error, "particles of other domains") : SB_OK, error);
    if (status != SB_OK) return status;
    g->halo = halo;
    sb_refresh_owners(sim, (sb_f4 *)sim->state.position);
    if (sb_cells_build(&g->halo_cells, sim->state.position + sim->state.n, halo, sim->space.shift) != 0)
        status = sb_fail_memory(error, "cells");
    return status;
}

sb_status sb_domains_make_ghosts(sb_sim *sim, sb_error *error)
{
    sb_status status = make_halo(sim, error);
    if (status == SB_OK) status = sb_images_make(sim, error);
    if (sim->space.repeats) sim->ghosts.any = sb_ranks_any(sim->ranks, sim->ghosts.count > 0);
    return sb_domains_agree(sim, status, error);
}

static void pack_4(const sb_run *run, size_t runs, const sb_halo *halo, char *out)
{
    for (size_t r = 0; r < runs; r++)
        for (size_t k = 0; k < run[r].count; k++, out += 4)
            memcpy(out, (const char *)halo->owned + (run[r].begin + k) * halo->owned_stride, 4);
}

static void pack_16(const sb_run *run, size_t runs, const sb_halo *halo, char *out)
{
    for (size_t r = 0; r < runs; r++) {
        memcpy(out, (const char *)halo->owned + run[r].begin * sizeof(sb_f4), run[r].count * sizeof(sb_f4));
        out += run[r].count * sizeof(sb_f4);
    }
}

/* Packs the values for all ranks. Returns the number of parcels. */
static size_t make_parcels(const sb_domains *d, const sb_halo *halo)
{
    const sb_halo_plan *plan = &d->plan;
    size_t parcels = 0;
    char *out = d->out;
    for (int r = 0; r < d->ranks->count; r++) {
        const size_t size = plan->sends[r] * halo->size;
        if (size == 0) continue;
        const sb_run *run = plan->run + plan->first[r];
        (halo->size == 4 ? pack_4 : pack_16)(run, plan->first[r + 1] - plan->first[r], halo, out);
        d->send[parcels++] = (sb_parcel){r, out, size};
        out += size;
    }
    return parcels;
}

void sb_domains_refresh(const sb_sim *sim, const sb_halo *halo)
{
    const sb_domains *d = sim->domains;
    const bool in_place = halo->ghost_stride == halo->size;
    char *in = in_place ? halo->ghosts : d->in;
    const size_t sends = make_parcels(d, halo);
    size_t receives = 0, at = 0;
    for (int r = 0; r < d->ranks->count; r++) {
        const size_t size = d->plan.receives[r] * halo->size;
        if (size > 0) d->receive[receives++] = (sb_parcel){r, in + at, size};
        at += size;
    }
    sb_ranks_start(d->ranks, d->send, sends, d->receive, receives);
    sb_ranks_finish(d->ranks);
    for (size_t k = 0; k < sim->ghosts.halo && !in_place; k++)
        memcpy((char *)halo->ghosts + k * halo->ghost_stride, in + k * halo->size, halo->size);
    sb_images_refresh(sim, halo);
}
