#include "subject.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"

static const char KIND[] = "bench"; /* of archives in memory only */
enum { VERSION = 1 };

sb_status sb_bench_subject_build(const char *assets, const char *name, const sb_override *overrides, size_t count,
                                 sb_bench_subject *subject, sb_error *error)
{
    char path[SB_PATH_MAX];
    const double start = sb_clock();
    *subject = (sb_bench_subject){.sim = NULL};
    sb_status status = sb_path_join(path, assets, name, error);
    if (status == SB_OK) status = sb_scene_read(path, NULL, overrides, count, &subject->scene, error);
    if (status == SB_OK) status = sb_model_build(&subject->scene, &subject->model, error);
    if (status == SB_OK) status = sb_sim_create(&subject->scene, &subject->model, NULL, &subject->sim, error);
    if (status == SB_OK) {
        sb_model_free_start(&subject->model);
        sb_model_free_walls(&subject->model);
    }
    subject->setup = sb_clock() - start;
    if (status != SB_OK) sb_bench_subject_free(subject);
    return status;
}

sb_status sb_bench_subject_make(const char *assets, const char *name, const sb_override *overrides, size_t count,
                                int steps, sb_bench_subject *subject, sb_error *error)
{
    sb_status status = sb_bench_subject_build(assets, name, overrides, count, subject, error);
    if (status != SB_OK) return status;
    status = sb_sim_settle(subject->sim, error);
    for (int s = 0; status == SB_OK && s < steps; s++) status = sb_sim_step(subject->sim, error);
    subject->peak = sb_memory_peak();
    if (status == SB_OK) {
        sb_archive_begin(&subject->state, KIND, VERSION);
        sb_sim_save(subject->sim, &subject->state);
        status = sb_archive_close(&subject->state, error);
    }
    if (status != SB_OK) sb_bench_subject_free(subject);
    return status;
}

sb_status sb_bench_basin_make(const sb_bench_request *request, const char *settle_steps, sb_bench_subject *subject,
                              sb_error *error)
{
    char resolution[32];
    sb_bench_basin(request->particles, resolution);
    const sb_override overrides[] = {{"resolution", resolution},
                                     {"numerics.settle_steps", settle_steps},
                                     {"numerics.min_iterations", "10"},
                                     {"numerics.max_iterations", "10"}};
    return sb_bench_subject_make(request->assets, "benchmark/basin.yaml", overrides,
                                 sizeof overrides / sizeof overrides[0], 1, subject, error);
}

void sb_bench_subject_free(sb_bench_subject *subject)
{
    sb_archive_out_free(&subject->state);
    sb_sim_destroy(subject->sim);
    sb_model_free(&subject->model);
    sb_scene_free(&subject->scene);
    *subject = (sb_bench_subject){.sim = NULL};
}

sb_status sb_bench_restore(sb_bench_subject *subject, sb_error *error)
{
    sb_archive_in in = {.own = NULL};
    sb_status status =
        sb_archive_parse(&in, "the saved state", subject->state.bytes, subject->state.used, KIND, VERSION, error);
    if (status == SB_OK) status = sb_sim_load(subject->sim, &in, error);
    sb_archive_in_free(&in);
    return status;
}

sb_status sb_bench_repeat(sb_bench_subject *subject, int steps, double *seconds, double stage_seconds[SB_STAGES_MAX],
                          sb_error *error)
{
    sb_sim *sim = subject->sim;
    const sb_stage_time *stages;
    double before[SB_STAGES_MAX] = {0};
    sb_status status = sb_bench_restore(subject, error);
    if (status == SB_OK) status = sb_sim_step(sim, error);
    if (status == SB_OK) status = sb_bench_restore(subject, error);
    const size_t count = sb_sim_stages(sim, &stages);
    for (size_t s = 0; s < count; s++) before[s] = stages[s].seconds;
    const double start = sb_clock();
    for (int s = 0; status == SB_OK && s < steps; s++) status = sb_sim_step(sim, error);
    *seconds = sb_clock() - start;
    for (size_t s = 0; stage_seconds && s < count; s++) stage_seconds[s] = stages[s].seconds - before[s];
    if (status != SB_OK) return status;
    const uint64_t hash = sb_sim_hash(sim);
    if (subject->result && hash != subject->result)
        return sb_fail(error, SB_FAILED, "%d steps from the same state gave the hashes %016llx and %016llx", steps,
                       (unsigned long long)subject->result, (unsigned long long)hash);
    subject->result = hash;
    return SB_OK;
}
