#include "base/ranks.h"

#include "base/clock.h"

#include <string.h>

enum { ROOM = 1 << 15 }; /* bytes on the stack for what another rank sends */

void sb_ranks_start(sb_ranks *ranks, const sb_parcel *send, size_t sends, const sb_parcel *receive, size_t receives)
{
    for (size_t k = 0; k < sends; k++) ranks->bytes_sent += send[k].size;
    ranks->messages += sends;
    ranks->transport->start(ranks, send, sends, receive, receives);
}

void sb_ranks_finish(sb_ranks *ranks)
{
    const double from = sb_clock();
    ranks->transport->finish(ranks);
    ranks->waited += sb_clock() - from;
}

void sb_ranks_progress(sb_ranks *ranks)
{
    if (ranks->transport->progress) ranks->transport->progress(ranks);
}

void sb_ranks_gather(sb_ranks *ranks, const void *own, size_t size, void *all)
{
    if (!sb_ranks_several(ranks)) {
        memcpy(all, own, size);
        return;
    }
    const double from = sb_clock();
    ranks->transport->gather(ranks, own, size, all);
    ranks->waited += sb_clock() - from;
    ranks->messages += (uint64_t)ranks->count - 1;
    ranks->bytes_sent += ((uint64_t)ranks->count - 1) * size;
}

/* Sends `size` bytes to a rank and receives as many from it; NULL: does not. */
static void swap(sb_ranks *ranks, int other, void *out, void *in, size_t size)
{
    const sb_parcel send = {other, out, size}, receive = {other, in, size};
    sb_ranks_start(ranks, &send, out != NULL, &receive, in != NULL);
    sb_ranks_finish(ranks);
}

/* Adds another rank's `count` values to the own ones. */
typedef void merger(void *values, const void *others, size_t count);

/* Merges the values of all ranks, `size` bytes in all, in place: pairs of ranks exchange what they have so far, so that
   after log2 N rounds each rank has that of all. Ranks beyond a power of two give theirs to another rank, and get the
   result from it. The result may not depend on the order: it is one of integers, or a maximum. */
static void merge_all(sb_ranks *ranks, void *values, size_t size, size_t count, merger *merge)
{
    char others[ROOM];
    const int own = ranks->rank;
    int paired = 1;
    while (2 * paired <= ranks->count) paired *= 2;
    const int beyond = ranks->count - paired;
    if (own >= paired) {
        swap(ranks, own - paired, values, NULL, size);
        swap(ranks, own - paired, NULL, values, size);
        return;
    }
    if (own < beyond) {
        swap(ranks, own + paired, NULL, others, size);
        merge(values, others, count);
    }
    for (int step = 1; step < paired; step *= 2) {
        swap(ranks, own ^ step, values, others, size);
        merge(values, others, count);
    }
    if (own < beyond) swap(ranks, own + paired, values, NULL, size);
}

/* The same of any number of values of `size` bytes each. */
static void merge_list(sb_ranks *ranks, void *values, size_t size, size_t count, merger *merge)
{
    if (!sb_ranks_several(ranks)) return;
    for (size_t done = 0, some; done < count; done += some) {
        some = count - done < ROOM / size ? count - done : ROOM / size;
        merge_all(ranks, (char *)values + done * size, some * size, some, merge);
    }
}

static void merge_sums(void *values, const void *others, size_t count)
{
    sb_exact *sums = values, other;
    for (size_t k = 0; k < count; k++) {
        memcpy(&other, (const char *)others + k * sizeof other, sizeof other);
        sb_exact_merge(&sums[k], &other);
    }
}

void sb_ranks_sum(sb_ranks *ranks, sb_exact *values, size_t count)
{
    merge_list(ranks, values, sizeof *values, count, merge_sums);
}

typedef struct sums_and_largest {
    double largest;
    sb_exact sum[SB_RANKS_SUMS];
} sums_and_largest;

static void merge_sums_and_largest(void *values, const void *others, size_t count)
{
    sums_and_largest *own = values;
    double largest;
    memcpy(&largest, others, sizeof largest);
    own->largest = largest > own->largest ? largest : own->largest;
    merge_sums(own->sum, (const char *)others + offsetof(sums_and_largest, sum), count);
}

double sb_ranks_sum_and_largest(sb_ranks *ranks, sb_exact *values, size_t count, double value)
{
    if (!sb_ranks_several(ranks)) return value;
    sums_and_largest own = {.largest = value};
    if (count > 0) memcpy(own.sum, values, count * sizeof *values);
    merge_all(ranks, &own, offsetof(sums_and_largest, sum) + count * sizeof *values, count, merge_sums_and_largest);
    if (count > 0) memcpy(values, own.sum, count * sizeof *values);
    return own.largest;
}

static void merge_counts(void *values, const void *others, size_t count)
{
    uint64_t *counts = values, other;
    for (size_t k = 0; k < count; k++) {
        memcpy(&other, (const char *)others + k * sizeof other, sizeof other);
        counts[k] += other;
    }
}

void sb_ranks_add(sb_ranks *ranks, uint64_t *values, size_t count)
{
    merge_list(ranks, values, sizeof *values, count, merge_counts);
}

double sb_ranks_largest(sb_ranks *ranks, double value)
{
    return sb_ranks_sum_and_largest(ranks, NULL, 0, value);
}

bool sb_ranks_any(sb_ranks *ranks, bool flag)
{
    return sb_ranks_sum_and_largest(ranks, NULL, 0, flag ? 1 : 0) > 0;
}

/* The numbers that are still on their way by 2^k ranks, for each bit k of their distance, go this far now: number i is
   for the rank that is i after this one in a ring. */
static void pass_on(sb_ranks *ranks, uint64_t *number, size_t step)
{
    const size_t count = (size_t)ranks->count, own = (size_t)ranks->rank;
    uint64_t out[SB_RANKS_MAX], in[SB_RANKS_MAX];
    size_t some = 0;
    for (size_t i = step; i < count; i++)
        if (i & step) out[some++] = number[i];
    const sb_parcel send = {(int)((own + step) % count), out, some * sizeof *out};
    const sb_parcel receive = {(int)((own + count - step) % count), in, some * sizeof *in};
    sb_ranks_start(ranks, &send, 1, &receive, 1);
    sb_ranks_finish(ranks);
    some = 0;
    for (size_t i = step; i < count; i++)
        if (i & step) number[i] = in[some++];
}

void sb_ranks_swap_numbers(sb_ranks *ranks, const uint64_t *to, uint64_t *from)
{
    const size_t count = (size_t)sb_ranks_count(ranks), own = (size_t)sb_ranks_own(ranks);
    uint64_t number[SB_RANKS_MAX];
    for (size_t i = 0; i < count; i++) number[i] = to[(own + i) % count];
    for (size_t step = 1; step < count; step *= 2) pass_on(ranks, number, step);
    for (size_t i = 0; i < count; i++) from[(own + count - i) % count] = number[i];
}

void sb_ranks_share(sb_ranks *ranks, int from, void *bytes, size_t size)
{
    if (!sb_ranks_several(ranks) || size == 0) return;
    sb_parcel send[SB_RANKS_MAX];
    const sb_parcel receive = {from, bytes, size};
    size_t sends = 0;
    for (int r = 0; r < ranks->count && ranks->rank == from; r++)
        if (r != from) send[sends++] = (sb_parcel){r, bytes, size};
    sb_ranks_start(ranks, send, sends, &receive, ranks->rank != from);
    sb_ranks_finish(ranks);
}

void sb_ranks_collect(sb_ranks *ranks, int to, void *own, size_t size, void *all, const size_t *sizes)
{
    if (!sb_ranks_several(ranks)) {
        if (size > 0) memcpy(all, own, size);
        return;
    }
    if (ranks->rank != to) {
        const sb_parcel send = {to, own, size};
        sb_ranks_start(ranks, &send, size > 0, NULL, 0);
        sb_ranks_finish(ranks);
        return;
    }
    sb_parcel receive[SB_RANKS_MAX];
    size_t receives = 0, at = 0;
    for (int r = 0; r < ranks->count; r++) {
        char *place = (char *)all + at;
        if (r == to && size > 0) memcpy(place, own, size);
        if (r != to && sizes[r] > 0) receive[receives++] = (sb_parcel){r, place, sizes[r]};
        at += r == to ? size : sizes[r];
    }
    sb_ranks_start(ranks, NULL, 0, receive, receives);
    sb_ranks_finish(ranks);
}

void sb_ranks_take_turn(sb_ranks *ranks, void *bytes, size_t size)
{
    if (!sb_ranks_several(ranks) || ranks->rank == 0 || size == 0) return;
    const sb_parcel before = {ranks->rank - 1, bytes, size};
    sb_ranks_start(ranks, NULL, 0, &before, 1);
    sb_ranks_finish(ranks);
}

void sb_ranks_end_turn(sb_ranks *ranks, void *bytes, size_t size)
{
    if (!sb_ranks_several(ranks) || size == 0) return;
    if (ranks->rank + 1 < ranks->count) {
        const sb_parcel next = {ranks->rank + 1, bytes, size};
        sb_ranks_start(ranks, &next, 1, NULL, 0);
        sb_ranks_finish(ranks);
    }
    sb_ranks_share(ranks, ranks->count - 1, bytes, size);
}

void sb_ranks_spread(sb_ranks *ranks, void *own, void *all, const size_t *sizes)
{
    sb_parcel send[SB_RANKS_MAX], receive[SB_RANKS_MAX];
    size_t sends = 0, receives = 0;
    char *place = all;
    const size_t size = sizes[sb_ranks_own(ranks)];
    for (int r = 0; r < sb_ranks_count(ranks); place += sizes[r++]) {
        if (r == sb_ranks_own(ranks)) {
            if (size > 0) memcpy(place, own, size);
            continue;
        }
        if (size > 0) send[sends++] = (sb_parcel){r, own, size};
        if (sizes[r] > 0) receive[receives++] = (sb_parcel){r, place, sizes[r]};
    }
    if (!sb_ranks_several(ranks)) return;
    sb_ranks_start(ranks, send, sends, receive, receives);
    sb_ranks_finish(ranks);
}
