/* Measures the delivered scenes with a shorter settling: steps from a saved state, stage by stage. */
#include "base/memory.h"
#include "child.h"
#include "subject.h"

#include <omp.h>
#include <stdio.h>

/* A scene: steps before the state is saved, and steps of a repeat. */
typedef struct plan {
    const char *name, *file;
    const char *resolution, *quick_resolution; /* m; NULL: that of the scene */
    int before, steps;
} plan;

static const plan plans[] = {
    {"plant at 4 m", "scenes/plant.yaml", "4", "24", 40, 5},
    {"column at 1 cm", "scenes/dam-break-column.yaml", NULL, "0.03", 100, 10},
    {"still water at 4 cm", "scenes/still-water.yaml", NULL, "0.08", 100, 40},
    {"flume (2D) at 5 cm", "scenes/solitary-flume.yaml", NULL, "0.1", 100, 40},
};

typedef struct times {
    sb_bench_samples step, stage[SB_STAGES_MAX];
    double simulated; /* simulated s of the steps of one repeat */
    double iterations;
} times;

/* Counts iterations and simulated time of the timed steps. */
static sb_status count_work(sb_bench_subject *subject, int steps, times *t, sb_error *error)
{
    sb_status status = sb_bench_restore(subject, error);
    for (int s = 0; s < steps && status == SB_OK; s++) {
        status = sb_sim_step(subject->sim, error);
        t->simulated += sb_sim_report(subject->sim)->time_step;
        t->iterations += sb_sim_report(subject->sim)->iterations;
    }
    return status;
}

static sb_status measure(sb_bench_subject *subject, int steps, int repeats, times *t, sb_error *error)
{
    sb_status status = count_work(subject, steps, t, error);
    for (int r = 0; r < repeats && status == SB_OK; r++) {
        double seconds, stage[SB_STAGES_MAX] = {0};
        status = sb_bench_repeat(subject, steps, &seconds, stage, error);
        sb_bench_sample(&t->step, seconds);
        for (size_t s = 0; s < SB_STAGES_MAX; s++) sb_bench_sample(&t->stage[s], stage[s]);
    }
    return status;
}

static void add_all(const char *name, const sb_bench_subject *subject, int steps, const times *t, sb_bench_rows *rows)
{
    const sb_stage_time *stages;
    const size_t n = subject->sim->state.n, count = sb_sim_stages(subject->sim, &stages);
    const int threads = omp_get_max_threads();
    const double particle_steps = (double)n * steps;
    char quantity[SB_BENCH_NAME];
    for (size_t s = 0; s < count; s++) {
        snprintf(quantity, sizeof quantity, "stage %s", stages[s].name);
        sb_bench_add(rows, name, n, threads, quantity, "ns", &t->stage[s], 1e9 / particle_steps);
    }
    sb_bench_add(rows, name, n, threads, SB_BENCH_STEP, "ns", &t->step, 1e9 / particle_steps);
    sb_bench_add(rows, name, n, threads, "time per simulated second", "s", &t->step, 1 / t->simulated);
    const double median = sb_bench_median(&t->step);
    const sb_bench_value values[] = {
        {"particle-steps per second", "1/s", median > 0 ? particle_steps / median : 0},
        {"iterations per step", "1", t->iterations / steps},
        {"time step", "s", t->simulated / steps},
        {"boundary particles", "1", (double)subject->model.wall_count},
        {"memory of the simulation", "B/particle", (double)sb_sim_bytes(subject->sim) / (double)n},
        {"peak memory", "B/particle", (double)subject->peak / (double)n},
        {"total peak memory", "MB", 1e-6 * (double)subject->peak},
        {"set-up", "s", subject->setup},
    };
    sb_bench_add_values(rows, name, n, threads, values, sizeof values / sizeof *values);
}

static sb_status one_scene(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    const plan *p = request->of;
    const bool quick = request->quick;
    const int steps = quick ? 2 : p->steps, before = quick ? 2 : p->before;
    const char *resolution = quick ? p->quick_resolution : p->resolution;
    const sb_override overrides[] = {{"numerics.settle_steps", quick ? "5" : "60"}, {"resolution", resolution}};
    char name[SB_BENCH_NAME];
    sb_bench_subject subject;
    times *t = sb_alloc(1, sizeof *t);
    if (!t) return sb_fail_memory(error, "samples");
    snprintf(name, sizeof name, "%s%s", p->name, quick ? " but coarser" : "");
    sb_status status =
        sb_bench_subject_make(request->assets, p->file, overrides, resolution ? 2 : 1, before, &subject, error);
    if (status == SB_OK) {
        status = measure(&subject, steps, request->repeats, t, error);
        if (status == SB_OK) add_all(name, &subject, steps, t, rows);
        sb_bench_subject_free(&subject);
    }
    sb_free(t);
    return status;
}

sb_status sb_bench_scenes(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    sb_bench_request one = *request;
    sb_status status = SB_OK;
    for (size_t p = 0; p < sizeof plans / sizeof plans[0] && status == SB_OK; p++) {
        one.of = &plans[p];
        status = sb_bench_in_child(one_scene, &one, rows, error);
    }
    return status;
}
