/* Measures the plant at 1 m: set-up, steps and memory on a small machine. */
#include "base/clock.h"
#include "base/memory.h"
#include "child.h"
#include "subject.h"

#include <omp.h>

enum { STEPS = 20 };

static void add_all(const sb_bench_subject *subject, bool quick, double seconds, sb_bench_rows *rows)
{
    const char *name = quick ? "plant but coarser" : "plant at 1 m";
    const size_t n = subject->sim->state.n;
    const int threads = omp_get_max_threads();
    const sb_bench_value values[] = {
        {"set-up", "s", subject->setup},
        {"steps", "1", STEPS},
        {SB_BENCH_STEP, "ns", 1e9 * seconds / ((double)n * STEPS)},
        {"boundary particles", "1", (double)subject->model.wall_count},
        {"memory of the simulation", "B/particle", (double)sb_sim_bytes(subject->sim) / (double)n},
        {"peak memory", "B/particle", (double)sb_memory_peak() / (double)n},
        {"total peak memory", "MB", 1e-6 * (double)sb_memory_peak()},
    };
    sb_bench_add_values(rows, name, n, threads, values, sizeof values / sizeof *values);
}

static sb_status plant(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    const sb_override overrides[] = {{"numerics.settle_steps", "0"}, {"resolution", request->quick ? "24" : "1"}};
    sb_bench_subject subject = {.sim = NULL};
    sb_status status = sb_bench_subject_build(request->assets, "scenes/plant.yaml", overrides, 2, &subject, error);
    if (status != SB_OK) return status;
    const double first = sb_clock();
    for (int s = 0; s < STEPS && status == SB_OK; s++) status = sb_sim_step(subject.sim, error);
    if (status == SB_OK) add_all(&subject, request->quick, sb_clock() - first, rows);
    sb_bench_subject_free(&subject);
    return status;
}

sb_status sb_bench_large(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    return sb_bench_in_child(plant, request, rows, error);
}
