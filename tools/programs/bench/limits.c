#include "limits.h"

#include "base/clock.h"
#include "base/memory.h"
#include "child.h"
#include "report.h"
#include "sim/state/simd.h"

#include <omp.h>
#include <string.h>

typedef float wide __attribute__((vector_size(64)));

enum {
    CHAINS = 8, /* independent sums, enough to hide the latency of an operation */
    TURNS = 2000000,
    LANES = sizeof(wide) / sizeof(float),
    MEGABYTES = 256, /* of each array: many times the last-level cache */
    MEGABYTES_QUICK = 16,
};

/* Products and sums in independent chains. */
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

/* Each thread copies its own part with memcpy. */
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

static void add(sb_bench_rows *rows, const char *quantity, const char *unit, const sb_bench_samples *samples)
{
    sb_bench_add(rows, SB_BENCH_MACHINE, 0, omp_get_max_threads(), quantity, unit, samples, 1e-9);
}

static sb_status measure(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    const size_t count = (request->quick ? MEGABYTES_QUICK : MEGABYTES) * (size_t)1000000 / sizeof(float);
    float *arrays[3] = {NULL}, kept = 0;
    sb_bench_samples copy = {.count = 0}, triad = copy, arithmetic = copy;
    sb_status status = SB_OK;
    for (int a = 0; a < 3; a++) {
        arrays[a] = sb_alloc(count, sizeof(float));
        if (!arrays[a]) status = sb_fail_memory(error, "the measure of bandwidth");
    }
    for (int r = 0; status == SB_OK && r <= request->repeats; r++) {
        const double copied = copy_once(arrays[0], arrays[1], count);
        const double added = triad_once(arrays[2], arrays[0], arrays[1], count);
        const double computed = arithmetic_once(&kept);
        if (r == 0) continue; /* the first repeat touches pages and starts threads */
        sb_bench_sample(&copy, copied);
        sb_bench_sample(&triad, added);
        sb_bench_sample(&arithmetic, computed);
    }
    if (status == SB_OK && !(kept > 0))
        status = sb_fail(error, SB_FAILED, "sums of positive numbers came out as %g", (double)kept);
    add(rows, SB_BENCH_COPY, "GB/s", &copy);
    add(rows, "triad bandwidth", "GB/s", &triad);
    add(rows, SB_BENCH_ARITHMETIC, "GFLOP/s", &arithmetic);
    for (int a = 0; a < 3; a++) sb_free(arrays[a]);
    return status;
}

sb_status sb_bench_limits(sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    sb_status status = sb_bench_in_child(measure, request, rows, error);
    if (status != SB_OK) return status;
    request->copy = 1e9 * sb_bench_find(rows, SB_BENCH_MACHINE, 0, 0, SB_BENCH_COPY)->median;
    request->arithmetic = 1e9 * sb_bench_find(rows, SB_BENCH_MACHINE, 0, 0, SB_BENCH_ARITHMETIC)->median;
    return SB_OK;
}

sb_status sb_bench_same_machine(const char *folder, const sb_bench_request *request, sb_error *error)
{
    static sb_bench_tables tables;
    const double now = 1e-9 * request->copy, most = 1.3;
    sb_status status = sb_bench_tables_read(&tables, folder, error);
    const sb_bench_row *kept = sb_bench_copy(&tables, NULL);
    if (status == SB_OK && kept && kept->threads == request->threads &&
        (now > most * kept->median || kept->median > most * now))
        status = sb_fail(error, SB_BAD_INPUT,
                         "%.400s: its tables are of a machine that copies %.3g GB/s, this machine copies %.3g GB/s: "
                         "stop other programs, or use another folder for this machine with --machine NAME",
                         folder, kept->median, now);
    sb_bench_tables_free(&tables);
    return status;
}
