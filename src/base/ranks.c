#include "base/ranks.h"

#include "base/clock.h"

#include <string.h>

enum { ROOM = SB_RANKS_MAX * 128 }; /* bytes on the stack for one gather */

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

/* How many of `left` values of `size` bytes one gather takes. */
static size_t at_a_time(const sb_ranks *ranks, size_t size, size_t left)
{
    const size_t most = ROOM / (size * (size_t)ranks->count);
    return most < left ? most : left;
}

void sb_ranks_sum(sb_ranks *ranks, sb_exact *values, size_t count)
{
    _Static_assert(SB_RANKS_MAX * sizeof *values <= ROOM, "a gather takes at least one value");
    if (!sb_ranks_several(ranks)) return;
    sb_exact all[ROOM / sizeof *values];
    for (size_t done = 0, some; done < count; done += some) {
        some = at_a_time(ranks, sizeof *values, count - done);
        sb_ranks_gather(ranks, values + done, some * sizeof *values, all);
        for (size_t k = 0; k < some; k++) values[done + k] = all[k];
        for (size_t r = 1; r < (size_t)ranks->count; r++)
            for (size_t k = 0; k < some; k++) sb_exact_merge(&values[done + k], &all[r * some + k]);
    }
}

double sb_ranks_sum_and_largest(sb_ranks *ranks, sb_exact *values, size_t count, double value)
{
    typedef struct both {
        double largest;
        sb_exact sum[SB_RANKS_SUMS];
    } both;
    if (!sb_ranks_several(ranks)) return value;
    both own = {.largest = value}, all[SB_RANKS_MAX];
    const size_t size = offsetof(both, sum) + count * sizeof *values;
    if (count > 0) memcpy(own.sum, values, count * sizeof *values);
    sb_ranks_gather(ranks, &own, size, all);
    for (size_t k = 0; k < count; k++) values[k] = (sb_exact){0};
    for (size_t r = 0; r < (size_t)ranks->count; r++) {
        both one; /* packed in the gather */
        memcpy(&one, (const char *)all + r * size, size);
        value = one.largest > value ? one.largest : value;
        for (size_t k = 0; k < count; k++) sb_exact_merge(&values[k], &one.sum[k]);
    }
    return value;
}

void sb_ranks_add(sb_ranks *ranks, uint64_t *values, size_t count)
{
    if (!sb_ranks_several(ranks)) return;
    uint64_t all[ROOM / sizeof *values];
    for (size_t done = 0, some; done < count; done += some) {
        some = at_a_time(ranks, sizeof *values, count - done);
        sb_ranks_gather(ranks, values + done, some * sizeof *values, all);
        memset(values + done, 0, some * sizeof *values);
        for (size_t r = 0; r < (size_t)ranks->count; r++)
            for (size_t k = 0; k < some; k++) values[done + k] += all[r * some + k];
    }
}

double sb_ranks_largest(sb_ranks *ranks, double value)
{
    if (!sb_ranks_several(ranks)) return value;
    double all[SB_RANKS_MAX];
    sb_ranks_gather(ranks, &value, sizeof value, all);
    for (int r = 0; r < ranks->count; r++) value = all[r] > value ? all[r] : value;
    return value;
}

bool sb_ranks_any(sb_ranks *ranks, bool flag)
{
    if (!sb_ranks_several(ranks)) return flag;
    bool all[SB_RANKS_MAX];
    sb_ranks_gather(ranks, &flag, sizeof flag, all);
    for (int r = 0; r < ranks->count; r++) flag |= all[r];
    return flag;
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
