/* The stage sort: particles that left the domain return through periodic sides or are removed; the others are sorted
   along the Z-curve of their cells. */
#include "sim/exchange/exchange.h"
#include "sim/search/around.h"
#include "sim/search/departures.h"
#include "sim/search/sort.h"
#include "sim/simulation.h"
#include "sim/step/ledger.h"
#include "sim/step/stages.h"

#include <omp.h>

/* Bounds of the domain in quanta. Beyond a wall side a particle counts as lost only from one support radius on. No
   particle is beyond a periodic side. */
typedef struct bounds {
    int64_t min[3], max[3];
} bounds;

/* Whether a particle that passes a side of this kind has left at once. */
static bool lets_out(sb_side_kind kind)
{
    return kind == SB_SIDE_OPEN || kind == SB_SIDE_SEA;
}

static bounds domain_bounds(const sb_sim *sim)
{
    bounds b;
    const sb_domain *domain = &sim->scene->domain;
    sb_record low = sb_space_record(&sim->space, domain->min);
    sb_record high = sb_space_record(&sim->space, domain->max);
    int64_t cell = (int64_t)1 << sim->space.shift;
    for (int axis = 0; axis < 3; axis++) {
        b.min[axis] = (int64_t)low[axis] - (lets_out(domain->side[2 * axis]) ? 0 : cell);
        b.max[axis] = (int64_t)high[axis] + (lets_out(domain->side[2 * axis + 1]) ? 0 : cell);
    }
    return b;
}

/* Finds the side that a particle is beyond: one that lets water out if there is one, else a wall side. */
static sb_exit outside(const sb_sim *sim, const bounds *b, sb_record record)
{
    sb_exit result = {-1, false};
    for (int axis = 0; axis < 3 - (sim->constant.dimension == 2); axis++) {
        int a = sim->constant.dimension == 2 && axis == 1 ? 2 : axis;
        int64_t x = record[a];
        if (x >= b->min[a] && x <= b->max[a]) continue;
        const int side = 2 * a + (x > b->max[a]);
        if (lets_out(sim->scene->domain.side[side])) return (sb_exit){side, false};
        result = (sb_exit){side, true};
    }
    return result;
}

sb_exit sb_exit_of(const sb_sim *sim, sb_record at)
{
    const bounds b = domain_bounds(sim);
    return outside(sim, &b, at);
}

/* Makes the sort words. Returns the number of particles that stay. */
static size_t make_words(sb_sim *sim, const bounds *b)
{
    const uint64_t gone = ((uint64_t)1 << sim->space.key_bits) - 1;
    const bool repeats = sim->space.repeats;
    uint64_t left = 0, lost = 0, crossed = 0;
#pragma omp parallel for schedule(static) reduction(+ : left, lost, crossed)
    for (size_t i = 0; i < sim->state.n; i++) {
        if (repeats) sim->state.position[i] = sb_space_wrap(&sim->space, sim->state.position[i]);
        const sb_exit way = outside(sim, b, sim->state.position[i]);
        left += way.side >= 0 && !way.lost;
        lost += way.side >= 0 && way.lost;
        crossed += way.side >= 0 && sim->scene->domain.side[way.side] == SB_SIDE_SEA;
        uint64_t key = way.side >= 0 ? gone : sb_space_key(&sim->space, sim->state.position[i]);
        sim->work.sort_words[i] = sb_sort_word(key, i);
    }
    uint64_t counts[] = {left, lost, crossed};
    sim->exchange->count(sim, counts, 3);
    sim->state.left_domain += counts[0] - counts[2];
    sim->state.lost += counts[1];
    sim->state.crossing.out += counts[2];
    return sim->state.n - left - lost;
}

/* Orders the words of one cell, [begin, end), by the ids of their particles. Those that were in one cell before are in
   order already. */
static void order_by_id(uint64_t *words, size_t begin, size_t end, const uint32_t *id)
{
    for (size_t i = begin + 1; i < end; i++) {
        const uint64_t word = words[i];
        const uint32_t own = id[sb_word_index(word)];
        size_t k = i;
        for (; k > begin && id[sb_word_index(words[k - 1])] > own; k--) words[k] = words[k - 1];
        words[k] = word;
    }
}

/* The first word from `at` on that begins a cell, or n. */
static size_t cell_from(const uint64_t *words, size_t at, size_t n)
{
    while (at > 0 && at < n && sb_word_key(words[at]) == sb_word_key(words[at - 1])) at++;
    return at < n ? at : n;
}

/* Orders the particles of each cell by id, so that their order, and that of neighbours, does not depend on history.
   Particles outside of the domain have one key, the largest. */
static void order_cells(const sb_sim *sim, uint64_t *words)
{
    const size_t n = sim->state.n;
#pragma omp parallel
    {
        const size_t thread = (size_t)omp_get_thread_num(), threads = (size_t)omp_get_num_threads();
        size_t at = cell_from(words, n * thread / threads, n);
        const size_t end = cell_from(words, n * (thread + 1) / threads, n);
#pragma omp barrier /* no thread reads another one's words from here on */
        while (at < end) {
            size_t next = at + 1;
            while (next < end && sb_word_key(words[next]) == sb_word_key(words[at])) next++;
            order_by_id(words, at, next, sim->state.id);
            at = next;
        }
    }
}

static void permute_4(uint32_t *field, uint32_t *sorted, const uint64_t *words, size_t n)
{
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) sorted[i] = field[sb_word_index(words[i])];
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) field[i] = sorted[i];
}

static void permute_16(sb_record *field, sb_record *sorted, const uint64_t *words, size_t n)
{
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) sorted[i] = field[sb_word_index(words[i])];
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) field[i] = sorted[i];
}

static void permute(sb_sim *sim, const uint64_t *words)
{
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        void *entries = sb_state_entries(&sim->state, f);
        if (!entries) continue;
        if (f->size == 4)
            permute_4(entries, (uint32_t *)sim->work.sorted, words, sim->state.n);
        else
            permute_16(entries, sim->work.sorted, words, sim->state.n);
    }
}

/* Exchanges what the bookings of two particles read. */
static void swap(sb_sim *sim, size_t a, size_t b)
{
    const sb_record position = sim->state.position[a];
    const sb_f4 velocity = sim->state.velocity[a];
    const uint32_t id = sim->state.id[a];
    sim->state.position[a] = sim->state.position[b], sim->state.position[b] = position;
    sim->state.velocity[a] = sim->state.velocity[b], sim->state.velocity[b] = velocity;
    sim->state.id[a] = sim->state.id[b], sim->state.id[b] = id;
}

/* Books the particles from `first` on, which leave. */
static void note_departures(sb_sim *sim, const bounds *b, size_t first)
{
    size_t seawards = first; /* particles that leave to a given sea come first */
    sb_departures here = {.count = 0};
    for (size_t i = first; i < sim->state.n; i++) {
        const sb_exit way = outside(sim, b, sim->state.position[i]);
        if (sim->scene->domain.side[way.side] == SB_SIDE_SEA)
            swap(sim, i, seawards++);
        else
            sb_departures_note(sim, way, i, &here);
    }
    sb_departures_add(sim, &here);
    if (!sim->policy->runs) return;
    if (sim->needs.sea) sb_ledger_cross(sim, first, seawards);
    sb_ledger_leave(sim, seawards, sim->state.n);
}

sb_status sb_stage_sort(sb_sim *sim, sb_error *error)
{
    const bounds b = domain_bounds(sim);
    if (sim->exchange->migrate) {
        const sb_status status = sim->exchange->migrate(sim, error);
        if (status != SB_OK) return status;
    }
    const size_t stay = make_words(sim, &b);
    uint64_t *sorted = sb_sort(sim->work.sort_words, sim->work.sort_other, sim->state.n, SB_INDEX_BITS,
                               SB_INDEX_BITS + sim->space.key_bits);
    const sb_status status = sim->exchange->agree(sim, sorted ? SB_OK : sb_fail_memory(error, "sorting"), error);
    if (status != SB_OK) return status;
    order_cells(sim, sorted);
    permute(sim, sorted);
    note_departures(sim, &b, stay);
    sim->state.n = sim->work.everywhere = stay;
    sim->exchange->count(sim, &sim->work.everywhere, 1);
    if (sb_cells_build(&sim->cells, sim->state.position, sim->state.n, sim->space.shift) != 0)
        return sb_fail_memory(error, "cells");
    return sb_groups_build(sim) == 0 ? SB_OK : sb_fail_memory(error, "groups of particles");
}
