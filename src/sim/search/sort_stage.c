/* The stage sort: particles that left the domain return through periodic sides or are removed; the others are sorted
   along the Z-curve of their cells. */
#include "base/memory.h"
#include "sim/search/around.h"
#include "sim/search/departures.h"
#include "sim/search/sort.h"
#include "sim/state/state.h"
#include "sim/step/ledger.h"
#include "sim/step/stages.h"

#include <math.h>
#include <string.h>

/* Bounds of the domain in quanta. Beyond a wall side a particle counts as lost only from one support radius on. No
   particle is beyond a periodic side. */
typedef struct bounds {
    int64_t min[3], max[3];
} bounds;

static bounds domain_bounds(const sb_sim *sim)
{
    bounds b;
    const sb_domain *domain = &sim->scene->domain;
    sb_record low = sb_space_record(&sim->space, domain->min);
    sb_record high = sb_space_record(&sim->space, domain->max);
    int64_t cell = (int64_t)1 << sim->space.shift;
    for (int axis = 0; axis < 3; axis++) {
        b.min[axis] = (int64_t)low[axis] - (domain->side[2 * axis] == SB_SIDE_OPEN ? 0 : cell);
        b.max[axis] = (int64_t)high[axis] + (domain->side[2 * axis + 1] == SB_SIDE_OPEN ? 0 : cell);
    }
    return b;
}

/* Finds the side that a particle is beyond: an open side if there is one, else a wall side. */
static sb_exit outside(const sb_sim *sim, const bounds *b, sb_record record)
{
    sb_exit result = {-1, false};
    for (int axis = 0; axis < 3 - (sim->constant.dimension == 2); axis++) {
        int a = sim->constant.dimension == 2 && axis == 1 ? 2 : axis;
        int64_t x = record[a];
        if (x >= b->min[a] && x <= b->max[a]) continue;
        const int side = 2 * a + (x > b->max[a]);
        if (sim->scene->domain.side[side] == SB_SIDE_OPEN) return (sb_exit){side, false};
        result = (sb_exit){side, true};
    }
    return result;
}

/* Makes the sort words. Returns the number of particles that stay. */
static size_t make_words(sb_sim *sim, const bounds *b)
{
    const uint64_t gone = ((uint64_t)1 << sim->space.key_bits) - 1;
    const bool repeats = sim->space.repeats;
    uint64_t left = 0, lost = 0;
#pragma omp parallel for schedule(static) reduction(+ : left, lost)
    for (size_t i = 0; i < sim->n; i++) {
        if (repeats) sim->position[i] = sb_space_wrap(&sim->space, sim->position[i]);
        const sb_exit way = outside(sim, b, sim->position[i]);
        left += way.side >= 0 && !way.lost;
        lost += way.side >= 0 && way.lost;
        uint64_t key = way.side >= 0 ? gone : sb_space_key(&sim->space, sim->position[i]);
        sim->sort_a[i] = sb_sort_word(key, i);
    }
    sim->left_domain += left;
    sim->lost += lost;
    sim->report.left_domain = sim->left_domain;
    sim->report.lost = sim->lost;
    sim->report.fluid_count = sim->n - left - lost;
    return sim->n - left - lost;
}

static void permute(sb_sim *sim, const uint64_t *words)
{
    sb_f4 *velocity = sim->scratch;
    sb_record *position = (sb_record *)sim->acceleration;
    /* Fields that are computed anew after the sort. */
    uint32_t *id = (uint32_t *)sim->residual;
    float *correction = sim->source;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < sim->n; i++) {
        size_t from = sb_word_index(words[i]);
        position[i] = sim->position[from];
        velocity[i] = sim->velocity[from];
        id[i] = sim->id[from];
        if (sim->density_correction) correction[i] = sim->density_correction[from];
    }
    sim->scratch = sim->velocity;
    sim->velocity = velocity;
    sim->acceleration = (sb_f4 *)sim->position;
    sim->position = position;
    memcpy(sim->id, id, sim->n * sizeof *id);
    if (sim->density_correction) memcpy(sim->density_correction, correction, sim->n * sizeof *correction);
    if (!sim->start_velocity) return;
    sb_f4 *start = sim->scratch;
    for (size_t i = 0; i < sim->n; i++) start[i] = sim->start_velocity[sb_word_index(words[i])];
    memcpy(sim->start_velocity, start, sim->n * sizeof *start);
}

static void swap_particles(sb_sim *sim, size_t a, size_t b)
{
#define SWAP(type, field)                                                                                              \
    do {                                                                                                               \
        const type other = (field)[a];                                                                                 \
        (field)[a] = (field)[b];                                                                                       \
        (field)[b] = other;                                                                                            \
    } while (0)
    SWAP(sb_record, sim->position);
    SWAP(sb_f4, sim->velocity);
    SWAP(uint32_t, sim->id);
    if (sim->density_correction) SWAP(float, sim->density_correction);
    if (sim->start_velocity) SWAP(sb_f4, sim->start_velocity);
#undef SWAP
}

/* Orders particles [begin, end) by id. Those that were in one cell before are in order already. */
static void order_by_id(sb_sim *sim, size_t begin, size_t end)
{
    for (size_t i = begin + 1; i < end; i++)
        for (size_t k = i; k > begin && sim->id[k - 1] > sim->id[k]; k--) swap_particles(sim, k - 1, k);
}

/* The order within a cell does not depend on history, and so neither does that of neighbours. */
static void order_cells(sb_sim *sim)
{
    const sb_cells *cells = &sim->cells;
#pragma omp parallel for schedule(static, 64)
    for (size_t c = 0; c < cells->count; c++) order_by_id(sim, cells->begin[c], cells->begin[c + 1]);
}

sb_status sb_stage_sort(sb_sim *sim, sb_error *error)
{
    const bounds b = domain_bounds(sim);
    const size_t stay = make_words(sim, &b);
    const uint64_t *sorted =
        sb_sort(sim->sort_a, sim->sort_b, sim->n, SB_INDEX_BITS, SB_INDEX_BITS + sim->space.key_bits);
    if (!sorted) return sb_fail_memory(error, "sorting");
    permute(sim, sorted);
    order_by_id(sim, stay, sim->n); /* their keys are the largest */
    for (size_t i = stay; i < sim->n; i++) sb_departures_note(sim, outside(sim, &b, sim->position[i]), i);
    if (!sim->settling) sb_ledger_leave(sim, stay, sim->n);
    sim->n = stay;
    if (sb_cells_build(&sim->cells, sim->position, sim->n, sim->space.shift) != 0)
        return sb_fail_memory(error, "cells");
    order_cells(sim);
    return sb_groups_build(sim) == 0 ? SB_OK : sb_fail_memory(error, "groups of particles");
}
