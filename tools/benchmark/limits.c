#include "limits.h"

#include "base/clock.h"
#include "base/memory.h"
#include "sim/simd.h"

#include <omp.h>
#include <string.h>

typedef float wide __attribute__((vector_size(64)));

enum {
    CHAINS = 8, /* independent sums: as many as it takes to hide an operation's latency */
    TURNS = 2000000,
    LANES = sizeof(wide) / sizeof(float),
};

/* Products and sums that nothing waits for but their own chain. */
SB_MULTIVERSION
static float multiply_and_add(size_t turns, float factor)
{
    wide sum[CHAINS], by = {0};
    for (size_t l = 0; l < LANES; l++) by[l] = factor;
    for (int c = 0; c < CHAINS; c++) sum[c] = by * (float)c;
    for (size_t t = 0; t < turns; t++)
        for (int c = 0; c < CHAINS; c++) sum[c] = sum[c] * by + by;
    float all = 0;
    for (int c = 0; c < CHAINS; c++)
        for (size_t l = 0; l < LANES; l++) all += sum[c][l];
    return all;
}

static double arithmetic_once(float *kept)
{
    const double start = sb_clock();
#pragma omp parallel
    {
        const float result = multiply_and_add(TURNS, 0.5f);
#pragma omp critical
        *kept += result;
    }
    return 2.0 * LANES * CHAINS * TURNS * omp_get_max_threads() / (sb_clock() - start);
}

/* Each thread on its own part, with the library's copy. */
static double copy_once(float *to, const float *from, size_t count)
{
    const double start = sb_clock();
#pragma omp parallel
    {
        const size_t threads = (size_t)omp_get_num_threads(), self = (size_t)omp_get_thread_num();
        const size_t begin = count * self / threads, end = count * (self + 1) / threads;
        memcpy(to + begin, from + begin, (end - begin) * sizeof *to);
    }
    return 2.0 * sizeof *to * (double)count / (sb_clock() - start);
}

static double triad_once(float *to, const float *a, const float *b, size_t count)
{
    const double start = sb_clock();
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < count; i++) to[i] = a[i] + 3.0f * b[i];
    return 3.0 * sizeof *to * (double)count / (sb_clock() - start);
}

static sb_status add(sb_bench_rows *rows, const char *quantity, const char *unit, const sb_bench_samples *samples,
                     double *median, sb_error *error)
{
    sb_status status = sb_bench_add(rows, "machine", 0, omp_get_max_threads(), quantity, unit, samples, 1e-9, error);
    *median = sb_bench_median(samples);
    return status;
}

sb_status sb_bench_limits_measure(size_t megabytes, int repeats, sb_bench_limits *limits, sb_bench_rows *rows,
                                  sb_error *error)
{
    const size_t count = megabytes * 1000000 / sizeof(float);
    float *arrays[3] = {NULL}, kept = 0;
    sb_bench_samples copy = {.count = 0}, triad = copy, arithmetic = copy;
    sb_status status = SB_OK;
    for (int a = 0; a < 3; a++) {
        arrays[a] = sb_alloc(count, sizeof(float));
        if (!arrays[a]) status = sb_fail_memory(error, "the measure of bandwidth");
    }
    for (int r = 0; status == SB_OK && r <= repeats; r++) {
        const double copied = copy_once(arrays[0], arrays[1], count);
        const double added = triad_once(arrays[2], arrays[0], arrays[1], count);
        const double computed = arithmetic_once(&kept);
        if (r == 0) continue; /* the first touches pages and wakes threads */
        sb_bench_sample(&copy, copied);
        sb_bench_sample(&triad, added);
        sb_bench_sample(&arithmetic, computed);
    }
    if (status == SB_OK && !(kept > 0))
        status = sb_fail(error, SB_FAILED, "sums of positive numbers came out as %g", (double)kept);
    if (status == SB_OK) status = add(rows, "copy bandwidth", "GB/s", &copy, &limits->copy, error);
    if (status == SB_OK) status = add(rows, "triad bandwidth", "GB/s", &triad, &limits->triad, error);
    if (status == SB_OK) status = add(rows, "arithmetic", "GFLOP/s", &arithmetic, &limits->arithmetic, error);
    for (int a = 0; a < 3; a++) sb_free(arrays[a]);
    return status;
}
