#include "sim/search/sort.h"

#include "base/memory.h"

#include <omp.h>
#include <string.h>

enum { BUCKETS = 1 << SB_SORT_DIGIT };

static void range_of(size_t count, int thread, int threads, size_t *begin, size_t *end)
{
    *begin = count * (size_t)thread / (size_t)threads;
    *end = count * (size_t)(thread + 1) / (size_t)threads;
}

/* First place of each (bucket, thread): buckets in order, and threads in order within a bucket. */
static void scan(size_t (*histogram)[BUCKETS], int threads)
{
    size_t place = 0;
    for (int bucket = 0; bucket < BUCKETS; bucket++)
        for (int thread = 0; thread < threads; thread++) {
            size_t here = histogram[thread][bucket];
            histogram[thread][bucket] = place;
            place += here;
        }
}

uint64_t *sb_sort(uint64_t *words, uint64_t *other, size_t count, int low, int high)
{
    int threads = count < 65536 ? 1 : omp_get_max_threads();
    size_t(*counts)[BUCKETS] = sb_alloc((size_t)threads, sizeof *counts);
    if (!counts) return NULL;
    for (int shift = low; shift < high; shift += SB_SORT_DIGIT) {
        uint64_t mask = high - shift < SB_SORT_DIGIT ? ((uint64_t)1 << (high - shift)) - 1 : BUCKETS - 1;
#pragma omp parallel num_threads(threads)
        {
            int team = omp_get_num_threads();
            size_t begin, end;
            size_t *mine = counts[omp_get_thread_num()];
            range_of(count, omp_get_thread_num(), team, &begin, &end);
            memset(mine, 0, sizeof counts[0]);
            for (size_t i = begin; i < end; i++) mine[words[i] >> shift & mask]++;
#pragma omp barrier
#pragma omp single
            scan(counts, team);
            for (size_t i = begin; i < end; i++) other[mine[words[i] >> shift & mask]++] = words[i];
        }
        uint64_t *swap = words;
        words = other;
        other = swap;
    }
    sb_free(counts);
    return words;
}
