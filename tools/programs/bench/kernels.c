/* Measures the stages of a step and the passes of a pressure iteration, in a basin of water at rest. */
#include "base/clock.h"
#include "base/memory.h"
#include "child.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "subject.h"

#include <omp.h>
#include <string.h>

/* Passes of one iteration, each timed separately. */
enum pass { LOAD, ACCELERATION, DIVERGENCE, JUDGEMENT, PASSES };
enum { ITERATIONS = 10 };

/* Smallest traffic and work of a pass. Bytes: those that a usual cache does not keep until they are needed again
   (fields once per particle, lists once per pair; the record of a neighbour is assumed to be in a cache). Operations:
   on floats. */
typedef struct work {
    const char *name;
    double bytes_particle, bytes_pair, operations_pair;
} work;

static const work works[] = {
    /* lists are written; 1 in 5 tested particles is a neighbour; 8 operations per test, 25 per kernel */
    {"neighbours", 16 + 40 + 12, 4, 5 * 8 + 25},
    /* three passes: moments, their mean, the force */
    {"stress_correction", 16 + 6 + 20 + 36 + 6 + 20 + 36 + 6 + 32, 12, 21 + 13 + 33},
    {"forces", 16 + 16 + 4 + 6 + 16, 4, 30},
    {"source", 16 + 16 + 16 + 6 + 8, 4, 15},
    {"sort", 3 * 36 + 4 * 16, 0, 0},
    {"pressure load", 4 + 16 + 16, 0, 0},
    {"pressure acceleration", 16 + 16 + 6 + 16, 4, 11},
    {"pressure divergence", 16 + 16 + 16 + 6 + 4, 4, 15},
};

static const work *work_of(const char *name)
{
    for (size_t w = 0; w < sizeof works / sizeof works[0]; w++)
        if (strcmp(works[w].name, name) == 0) return &works[w];
    return NULL;
}

static void time_passes(sb_sim *sim, double seconds[PASSES])
{
    double at[PASSES + 1];
    at[LOAD] = sb_clock();
    sb_pressure_load(sim, sim->work.unknown);
    at[ACCELERATION] = sb_clock();
    sim->passes->accelerate(sim);
    at[DIVERGENCE] = sb_clock();
    sb_pressure_diverge(sim, sim->work.residual);
    at[JUDGEMENT] = sb_clock();
    sb_pressure_judge(sim);
    at[PASSES] = sb_clock();
    for (int p = 0; p < PASSES; p++) seconds[p] = at[p + 1] - at[p];
}

/* Times of all repeats. */
typedef struct times {
    sb_bench_samples stage[SB_STAGES_MAX], load, acceleration, divergence, judgement, step;
} times;

static sb_status measure(sb_bench_subject *subject, int repeats, times *t, sb_error *error)
{
    sb_status status = SB_OK;
    for (int r = 0; r < repeats && status == SB_OK; r++) {
        double step, stage[SB_STAGES_MAX] = {0}, pass[PASSES];
        status = sb_bench_repeat(subject, 1, &step, stage, error);
        if (status != SB_OK) break;
        time_passes(subject->sim, pass);
        sb_bench_sample(&t->step, step);
        for (size_t s = 0; s < SB_STAGES_MAX; s++) sb_bench_sample(&t->stage[s], stage[s]);
        sb_bench_sample(&t->load, pass[LOAD]);
        sb_bench_sample(&t->acceleration, pass[ACCELERATION]);
        sb_bench_sample(&t->divergence, pass[DIVERGENCE]);
        sb_bench_sample(&t->judgement, pass[JUDGEMENT]);
    }
    return status;
}

/* Adds the rows of a pass: per particle, per pair, and its fractions of memory bandwidth and of arithmetic speed. */
static void add_pass(sb_bench_rows *rows, const char *name, size_t n, double pairs, const sb_bench_samples *samples,
                     const sb_bench_request *request)
{
    const int threads = omp_get_max_threads();
    const double per_particle = 1 / (double)n;
    sb_bench_add(rows, name, n, threads, SB_BENCH_PER_PARTICLE, "ns", samples, 1e9 * per_particle);
    const double median = per_particle * sb_bench_median(samples);
    const work *of = work_of(name);
    if (!of || !(median > 0)) return;
    const double bytes = of->bytes_particle + pairs * of->bytes_pair, operations = pairs * of->operations_pair;
    if (of->bytes_pair > 0)
        sb_bench_add(rows, name, n, threads, "time per pair", "ns", samples, 1e9 * per_particle / pairs);
    sb_bench_add_value(rows, name, n, threads, "share of bandwidth", "%", 100 * bytes / (median * request->copy));
    if (operations > 0)
        sb_bench_add_value(rows, name, n, threads, "share of arithmetic", "%",
                           100 * operations / (median * request->arithmetic));
}

/* Sum of one or two stages: neighbour search and sort are judged together. */
static sb_bench_samples sum_of(const times *t, const sb_stage_time *stages, size_t count, const char *a, const char *b)
{
    sb_bench_samples sum = {.count = 0};
    for (int r = 0; r < t->step.count; r++) {
        double value = 0;
        for (size_t s = 0; s < count; s++)
            if (strcmp(stages[s].name, a) == 0 || (b && strcmp(stages[s].name, b) == 0)) value += t->stage[s].value[r];
        sb_bench_sample(&sum, value);
    }
    return sum;
}

static void add_all(const sb_bench_subject *subject, const times *t, const sb_bench_request *request,
                    sb_bench_rows *rows)
{
    const sb_stage_time *stages;
    const size_t n = subject->sim->state.n, count = sb_sim_stages(subject->sim, &stages);
    const double pairs = 4 * (double)subject->sim->work.pairs.used / (double)n;
    const sb_bench_samples search = sum_of(t, stages, count, "sort", "neighbours");
    const sb_bench_samples pressure = sum_of(t, stages, count, "pressure", NULL);
    sb_bench_add_value(rows, "basin", n, omp_get_max_threads(), "pairs per particle", "1", pairs);
    for (size_t s = 0; s < count; s++) add_pass(rows, stages[s].name, n, pairs, &t->stage[s], request);
    const struct {
        const char *name;
        const sb_bench_samples *samples;
    } passes[] = {
        {"pressure load", &t->load},
        {"pressure acceleration", &t->acceleration},
        {"pressure divergence", &t->divergence},
        {"pressure judgement", &t->judgement},
        {"sort and search", &search},
        {SB_BENCH_STEP, &t->step},
    };
    for (size_t p = 0; p < sizeof passes / sizeof passes[0]; p++)
        add_pass(rows, passes[p].name, n, pairs, passes[p].samples, request);
    /* The stage contains the iterations, a first guess and a last acceleration. */
    sb_bench_add(rows, SB_BENCH_ITERATION, n, omp_get_max_threads(), SB_BENCH_PER_PARTICLE, "ns", &pressure,
                 1e9 / ((double)n * ITERATIONS));
}

static sb_status one_size(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    sb_bench_subject subject;
    times *t = sb_alloc(1, sizeof *t);
    if (!t) return sb_fail_memory(error, "samples");
    sb_status status = sb_bench_basin_make(request, "10", &subject, error);
    if (status == SB_OK) {
        status = measure(&subject, request->repeats, t, error);
        if (status == SB_OK) add_all(&subject, t, request, rows);
        sb_bench_subject_free(&subject);
    }
    sb_free(t);
    return status;
}

sb_status sb_bench_kernels(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    static const size_t full[] = {200000, 1000000, 0}, quick[] = {8000, 0};
    return sb_bench_sizes(one_size, request, request->quick ? quick : full, rows, error);
}
