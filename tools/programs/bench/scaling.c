/* Measures whole steps of ten iterations in basins of several sizes, with one thread and more. */
#include "base/file.h"
#include "child.h"
#include "sections.h"
#include "subject.h"

#include <omp.h>

enum { STEPS = 1 };

typedef struct context {
    const sb_bench_request *request;
    size_t particles;
} context;

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
static sb_status one_size(const void *context_, sb_bench_rows *rows, sb_error *error)
{
    const context *c = context_;
    char path[SB_PATH_MAX], resolution[32];
    sb_bench_subject subject;
    sb_bench_basin(c->particles, resolution);
    const sb_override overrides[] = {{"resolution", resolution},
                                     {"numerics.settle_steps", "5"},
                                     {"numerics.min_iterations", "10"},
                                     {"numerics.max_iterations", "10"}};
    omp_set_num_threads(c->request->threads);
    sb_status status = sb_path_join(path, c->request->assets, "benchmark/basin.yaml", error);
    if (status == SB_OK)
        status = sb_bench_subject_make(path, overrides, sizeof overrides / sizeof overrides[0], 1, &subject, error);
    if (status != SB_OK) return status;
    for (int threads = 1; threads <= c->request->threads && status == SB_OK; threads *= 2)
        status = with_threads(&subject, threads, c->request->repeats, rows, error);
    sb_bench_subject_free(&subject);
    return status;
}

sb_status sb_bench_scaling(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    static const size_t full[] = {50000, 200000, 1000000, 4000000, 0}, quick[] = {4000, 16000, 0};
    sb_status status = SB_OK;
    for (const size_t *n = request->quick ? quick : full; *n && status == SB_OK; n++) {
        const context c = {request, *n};
        status = sb_bench_in_child(one_size, &c, rows, error);
    }
    return status;
}
