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

/* Adds another rank's `count` values to the own ones. */
typedef void merger(void *values, const void *others, size_t count);

/* One exchange with another rank. */
typedef struct exchange {
    int other;
    bool sends, receives, result; /* result: what it receives is that of all */
} exchange;

/* Finds a rank's exchange of a round: pairs of ranks exchange what they have so far, so that after log2 N rounds each
   rank has that of all. Ranks beyond a power of two give theirs to another rank, and get the result from it. Returns
   false after the last one. */
static bool find_exchange(const sb_ranks *ranks, int round, exchange *found)
{
    const int own = ranks->rank;
    int paired = 1, rounds = 0;
    for (; 2 * paired <= ranks->count; paired *= 2) rounds++;
    const bool has_other = own < ranks->count - paired;
    if (own >= paired) {
        *found = (exchange){own - paired, .sends = round == 0, .receives = round == 1, .result = round == 1};
        return round < 2;
    }
    if (has_other && (round == 0 || round == rounds + 1)) {
        *found = (exchange){own + paired, .sends = round > 0, .receives = round == 0};
        return true;
    }
    const int step = round - (has_other ? 1 : 0);
    *found = (exchange){step < rounds ? own ^ 1 << step : own, .sends = true, .receives = true};
    return step < rounds;
}

static void start_exchange(sb_ranks *ranks, const exchange *with, void *out, void *in, size_t size)
{
    const sb_parcel send = {with->other, out, size}, receive = {with->other, in, size};
    sb_ranks_start(ranks, &send, with->sends, &receive, with->receives);
}

/* Merges the values of all ranks, `size` bytes in all, in place. The result may not depend on the order: it is one of
   integers, or a maximum. */
static void merge_all(sb_ranks *ranks, void *values, size_t size, size_t count, merger *merge)
{
    char others[ROOM];
    exchange with;
    for (int round = 0; find_exchange(ranks, round, &with); round++) {
        start_exchange(ranks, &with, values, with.result ? values : others, size);
        sb_ranks_finish(ranks);
        if (with.receives && !with.result) merge(values, others, count);
    }
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

/* ---- sums and a largest value ---- */

static size_t bytes_of(const sb_flying_sums *flying)
{
    return (size_t)((const char *)&flying->own.sum[flying->count] - (const char *)&flying->own);
}

/* Starts the exchange of the present round, if there is one. */
static void start_round(sb_ranks *ranks, sb_flying_sums *flying)
{
    exchange with;
    flying->under_way = find_exchange(ranks, flying->round, &with);
    if (flying->under_way) start_exchange(ranks, &with, &flying->own, &flying->others, bytes_of(flying));
}

/* Ends the exchange of the present round, and starts the next one. */
static void end_round(sb_ranks *ranks, sb_flying_sums *flying)
{
    exchange with;
    (void)find_exchange(ranks, flying->round++, &with);
    sb_ranks_finish(ranks);
    if (with.result) {
        memcpy(&flying->own, &flying->others, bytes_of(flying));
    } else if (with.receives) {
        if (flying->others.largest > flying->own.largest) flying->own.largest = flying->others.largest;
        merge_sums(flying->own.sum, flying->others.sum, flying->count);
    }
    start_round(ranks, flying);
}

void sb_ranks_sum_begin(sb_ranks *ranks, sb_flying_sums *flying, const sb_exact *values, size_t count, double value)
{
    flying->count = count;
    flying->round = 0;
    flying->own.largest = value;
    if (count > 0) memcpy(flying->own.sum, values, count * sizeof *values);
    start_round(ranks, flying);
}

bool sb_ranks_sum_arrived(sb_ranks *ranks, sb_flying_sums *flying)
{
    bool (*const arrived)(sb_ranks *) = ranks->transport->arrived;
    while (flying->under_way && arrived && arrived(ranks)) end_round(ranks, flying);
    return !flying->under_way || !arrived;
}

double sb_ranks_sum_end(sb_ranks *ranks, sb_flying_sums *flying, sb_exact *values)
{
    while (flying->under_way) end_round(ranks, flying);
    if (flying->count > 0) memcpy(values, flying->own.sum, flying->count * sizeof *values);
    return flying->own.largest;
}

double sb_ranks_sum_and_largest(sb_ranks *ranks, sb_exact *values, size_t count, double value)
{
    if (!sb_ranks_several(ranks)) return value;
    sb_flying_sums flying = {.under_way = false};
    sb_ranks_sum_begin(ranks, &flying, values, count, value);
    return sb_ranks_sum_end(ranks, &flying, values);
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
