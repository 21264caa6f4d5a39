/* Measures whole steps of ten iterations in basins of several sizes, with one thread and more. */
#include "child.h"
#include "subject.h"

#include <omp.h>

enum { STEPS = 1 };

static sb_status with_threads(sb_bench_subject *subject, int threads, int repeats, sb_bench_rows *rows, sb_error *error)
{
    sb_bench_samples samples = {.count = 0};
    sb_status status = SB_OK;
    omp_set_num_threads(threads);
    for (int r = 0; r < repeats && status == SB_OK; r++) {
        double seconds;
        status = sb_bench_repeat(subject, STEPS, &seconds, NULL, error);
        sb_bench_sample(&samples, seconds);
    }
    if (status != SB_OK) return status;
    const size_t n = subject->sim->state.n;
    sb_bench_add(rows, SB_BENCH_STEP, n, threads, SB_BENCH_PER_PARTICLE, "ns", &samples, 1e9 / ((double)n * STEPS));
    return SB_OK;
}

/* The state is made once; all repeats, with any number of threads, must give the same bits. */
static sb_status one_size(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    sb_bench_subject subject;
    sb_status status = sb_bench_basin_make(request, "5", &subject, error);
    if (status != SB_OK) return status;
    for (int threads = 1; threads <= request->threads && status == SB_OK; threads *= 2)
        status = with_threads(&subject, threads, request->repeats, rows, error);
    sb_bench_subject_free(&subject);
    return status;
}

sb_status sb_bench_scaling(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    static const size_t full[] = {50000, 200000, 1000000, 4000000, 0}, quick[] = {4000, 16000, 0};
    return sb_bench_sizes(one_size, request, request->quick ? quick : full, rows, error);
}
