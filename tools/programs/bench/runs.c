/* Measures whole runs of the program, once each: the run time of a user, including set-up and measuring. */
#include "base/file.h"
#include "base/memory.h"
#include "program.h"
#include "sections.h"
#include "summary_text.h"

typedef struct plan {
    const char *name, *quick_name, *scene, *preset;
    const char *resolution, *quick_resolution, *quick_duration;
    const char *settings[2];
} plan;

static const plan plans[] = {
    {"plant at 4 m; default",
     "plant but coarser; default",
     "scenes/plant.yaml",
     "default",
     "resolution=4",
     "resolution=24",
     "duration=1",
     {NULL}},
    {"plant at 4 m; paper",
     "plant but coarser; paper",
     "scenes/plant.yaml",
     "paper",
     "resolution=4",
     "resolution=24",
     "duration=1",
     {NULL}},
    {"column at 1 cm",
     "column but coarser",
     "scenes/dam-break-column.yaml",
     NULL,
     "resolution=0.01",
     "resolution=0.03",
     "duration=0.05",
     {NULL}},
    {"column at 1 cm, shorter step",
     "column but coarser, shorter step",
     "scenes/dam-break-column.yaml",
     NULL,
     "resolution=0.01",
     "resolution=0.03",
     "duration=0.05",
     {"numerics.time_step_factor=0.15", "numerics.source_relaxation=0.7"}},
};
static const plan island = {"conical island",
                            "conical island but coarser",
                            "validation/island/island.yaml",
                            NULL,
                            NULL,
                            "resolution=0.2",
                            "duration=0.1",
                            {NULL}};

static sb_status one_run(const sb_bench_request *request, const plan *p, sb_bench_rows *rows, sb_error *error)
{
    char scene[SB_PATH_MAX], *summary;
    sb_bench_program run = {.scene = scene, .preset = p->preset, .threads = request->threads};
    size_t n = 0;
    const char *resolution = request->quick ? p->quick_resolution : p->resolution;
    if (resolution) run.settings[n++] = resolution;
    for (size_t s = 0; s < sizeof p->settings / sizeof *p->settings && p->settings[s]; s++)
        run.settings[n++] = p->settings[s];
    if (request->quick) {
        run.settings[n++] = p->quick_duration;
        run.settings[n++] = "numerics.settle_steps=5";
    }
    sb_status status = sb_path_join(scene, request->assets, p->scene, error);
    if (status == SB_OK) status = sb_bench_program_run(&run, &summary, error);
    if (status != SB_OK) return status;
    const char *name = request->quick ? p->quick_name : p->name;
    const double fluid = sb_json_number_in(summary, "fluid_particles");
    const size_t count = fluid > 0 ? (size_t)fluid : 0;
    if (count == 0) status = sb_fail(error, SB_FAILED, "%s: summary.json: no fluid_particles", name);
    const double wall = sb_json_number_in(summary, "wall_s"), simulated = sb_json_number_in(summary, "simulated_s");
    const sb_bench_value values[] = {
        {"run time", "s", wall},
        {"simulated time", "s", simulated},
        {"run time per simulated second", "s", wall / simulated},
        {"steps", "1", sb_json_number_in(summary, "steps")},
        {"iterations per step", "1", sb_json_number_in(summary, "mean_iterations")},
        {"compression, mean", "%", 100 * sb_json_number_in(summary, "compression_mean")},
        {"compression, worst particle", "%", 100 * sb_json_number_in(summary, "compression_max")},
        {"peak memory", "B/particle", sb_json_number_in(summary, "peak_memory_bytes") / (double)count},
    };
    if (status == SB_OK)
        sb_bench_add_values(rows, name, count, request->threads, values, sizeof values / sizeof *values);
    sb_free(summary);
    return status == SB_OK ? sb_bench_complete(rows, error) : status;
}

sb_status sb_bench_runs(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t p = 0; p < sizeof plans / sizeof plans[0] && status == SB_OK; p++)
        status = one_run(request, &plans[p], rows, error);
    return status;
}

sb_status sb_bench_island(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    return one_run(request, &island, rows, error);
}
