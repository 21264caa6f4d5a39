#include "sim/state/gather.h"

#include "base/memory.h"

#include <string.h>

void sb_gather_shares(const sb_sim *sim, sb_shares *shares)
{
    const uint64_t own = sim->state.n;
    sb_ranks_gather(sim->ranks, &own, sizeof own, shares->count);
    shares->all = 0;
    for (int r = 0; r < sb_ranks_count(sim->ranks); r++) shares->all += shares->count[r];
}

void sb_gather_begin(const sb_sim *sim, sb_shares *shares, sb_archive_out *out)
{
    sb_gather_shares(sim, shares);
    sb_archive_ranks_begin(&shares->lists, sim->ranks, out);
}

void sb_gather_list(sb_shares *shares, sb_archive_out *out, void *field, size_t size)
{
    static const uint64_t none[SB_RANKS_MAX];
    sb_archive_ranks_list(&shares->lists, out, field ? shares->count : none, field, size);
}

void sb_gather_end(sb_shares *shares, sb_archive_out *out)
{
    sb_archive_ranks_end(&shares->lists, out);
}

void sb_gather_first(const sb_sim *sim, const sb_shares *shares, void *own, size_t size, void *all)
{
    size_t sizes[SB_RANKS_MAX];
    for (int r = 0; r < sb_ranks_count(sim->ranks); r++) sizes[r] = shares->count[r] * size;
    sb_ranks_collect(sim->ranks, 0, own, sim->state.n * size, all, sizes);
}

/* Merges the domains' samples by their cells, each of which is in one domain. */
static void merge(const sb_ranks *ranks, const uint64_t *counts, const sb_placed_sample *all, size_t total,
                  sb_fluid_sample *samples, size_t capacity)
{
    size_t at[SB_RANKS_MAX], end[SB_RANKS_MAX], begin = 0;
    for (int r = 0; r < ranks->count; r++) {
        at[r] = begin;
        begin = end[r] = begin + counts[r];
    }
    for (size_t k = 0; k < total && k < capacity;) {
        int next = -1;
        for (int r = 0; r < ranks->count; r++)
            if (at[r] < end[r] && (next < 0 || all[at[r]].cell < all[at[next]].cell)) next = r;
        const uint64_t cell = all[at[next]].cell;
        while (at[next] < end[next] && all[at[next]].cell == cell && k < capacity)
            samples[k++] = all[at[next]++].sample;
    }
}

size_t sb_gather_samples(const sb_sim *sim, sb_placed_sample *own, size_t count, sb_fluid_sample *samples,
                         size_t capacity)
{
    sb_ranks *ranks = sim->ranks;
    uint64_t found = own || count == 0 ? count : UINT64_MAX, counts[SB_RANKS_MAX], total = 0;
    size_t sizes[SB_RANKS_MAX];
    sb_ranks_gather(ranks, &found, sizeof found, counts);
    for (int r = 0; r < ranks->count; r++) {
        if (counts[r] == UINT64_MAX) return SIZE_MAX;
        total += counts[r];
        sizes[r] = (size_t)counts[r] * sizeof *own;
    }
    if (total == 0 || total > capacity) return (size_t)total;
    sb_placed_sample *all = sb_alloc_untouched(total, sizeof *all);
    if (sb_ranks_any(ranks, !all)) {
        sb_free(all);
        return SIZE_MAX;
    }
    sb_ranks_spread(ranks, own, all, sizes);
    merge(ranks, counts, all, (size_t)total, samples, capacity);
    sb_free(all);
    return (size_t)total;
}

sb_part sb_gather_part(const sb_sim *sim, size_t all)
{
    const size_t ranks = (size_t)sb_ranks_count(sim->ranks), own = (size_t)sb_ranks_own(sim->ranks);
    const size_t from = all * own / ranks;
    return (sb_part){from, all * (own + 1) / ranks - from};
}

const void *sb_take_part(const sb_sim *sim, sb_archive_in *in, void *entries, size_t size)
{
    const size_t all = entries ? sim->work.everywhere : 0;
    const sb_part part = sb_gather_part(sim, all);
    const char *list = sb_take_list_place(in, all, size);
    if (list && part.count > 0) memcpy(entries, list + part.from * size, part.count * size);
    return list;
}
