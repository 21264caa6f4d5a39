/* The first cut of the keys into domains, from particles of which each rank knows a part: no rank sorts those of all.
   The ranks search for the cuts together, a bit of the key at a time. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/search/sort.h"
#include "sim/state/gather.h"

#include <string.h>

/* The number of words with keys in blocks below `block`. */
static size_t count_below(const uint64_t *words, size_t count, uint64_t block)
{
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sb_word_key(words[middle]) >> SB_CELLS_BITS < block)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Adds up, for each cut, the particles of all ranks in blocks below block[r]. */
static void count_all(const sb_domains *d, const uint64_t *words, size_t count, const uint64_t *block, uint64_t *below)
{
    const size_t ranks = (size_t)d->ranks->count;
    for (size_t r = 1; r < ranks; r++) below[r] = count_below(words, count, block[r]);
    sb_ranks_add(d->ranks, below + 1, ranks - 1);
}

/* Sets block[r] to the block that holds the particle all * r / ranks in the order of keys: the last one with at most so
   many particles below it. */
static void find_blocks(const sb_sim *sim, const uint64_t *words, size_t count, uint64_t all, uint64_t *block)
{
    const size_t ranks = (size_t)sim->ranks->count;
    uint64_t trial[SB_RANKS_MAX], below[SB_RANKS_MAX];
    memset(block, 0, ranks * sizeof *block);
    for (int bit = sim->space.key_bits - SB_CELLS_BITS - 1; bit >= 0; bit--) {
        for (size_t r = 1; r < ranks; r++) trial[r] = block[r] | (uint64_t)1 << bit;
        count_all(sim->domains, words, count, trial, below);
        for (size_t r = 1; r < ranks; r++)
            if (below[r] <= all * r / ranks) block[r] = trial[r];
    }
}

/* Cuts at the nearer end of each block. */
static void cut_beside(const sb_sim *sim, const uint64_t *words, size_t count, uint64_t all, const uint64_t *block)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count;
    uint64_t next[SB_RANKS_MAX], begin[SB_RANKS_MAX], end[SB_RANKS_MAX];
    for (size_t r = 1; r < ranks; r++) next[r] = block[r] + 1;
    count_all(d, words, count, block, begin);
    count_all(d, words, count, next, end);
    for (size_t r = 1; r < ranks; r++) {
        const uint64_t at = all * r / ranks;
        d->cut[r] = (at - begin[r] <= end[r] - at ? block[r] : next[r]) << SB_CELLS_BITS;
    }
}

sb_status sb_domains_cut_parts(sb_sim *sim, sb_place_of *place, const void *set, size_t from, size_t count,
                               sb_error *error)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count;
    uint64_t *words = sb_alloc_untouched(count, sizeof *words), *other = sb_alloc_untouched(count, sizeof *other);
    const uint64_t *sorted = NULL;
    if (words && other) {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < count; i++) {
            const sb_record at = sb_space_wrap(&sim->space, place(sim, set, from + i));
            words[i] = sb_sort_word(sb_space_key(&sim->space, at), 0);
        }
        sorted = sb_sort(words, other, count, SB_INDEX_BITS, SB_INDEX_BITS + sim->space.key_bits);
    }
    const sb_status status = sb_domains_agree(sim, sorted ? SB_OK : sb_fail_memory(error, "domains"), error);
    for (size_t r = 1; r < ranks; r++) d->cut[r] = UINT64_MAX;
    d->cut[0] = 0;
    d->cut[ranks] = UINT64_MAX;
    d->recut = false;
    if (status == SB_OK) {
        uint64_t all = count, block[SB_RANKS_MAX];
        sb_ranks_add(d->ranks, &all, 1);
        find_blocks(sim, sorted, count, all, block);
        if (all > 0) cut_beside(sim, sorted, count, all, block);
    }
    sb_free(words);
    sb_free(other);
    return status;
}

sb_status sb_domains_cut(sb_sim *sim, sb_place_of *place, const void *set, size_t count, sb_error *error)
{
    const sb_part part = sb_gather_part(sim, count);
    return sb_domains_cut_parts(sim, place, set, part.from, part.count, error);
}
