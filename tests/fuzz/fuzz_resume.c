/* Fuzzes the checkpoint that a run is resumed from, as the program reads it: the identity of the run, its times and
   counters, the positions in the tables, the particle files so far, and the state. An input that begins with 'e' is a
   sequence of edits to a valid checkpoint of a step, one that begins with 's' to a valid checkpoint of the settling.
   Any other input is the file itself. Each input is loaded as it is, and again with corrected checksums. */
#include "app/checkpoint/checkpoint.h"
#include "app/checkpoint/parts.h"
#include "app/run/run.h"
#include "base/memory.h"
#include "fuzz.h"

#include <ftw.h>
#include <string.h>

static const char text[] = "dimensions: 2\n"
                           "resolution: 0.1\n"
                           "duration: 0.05\n"
                           "domain: {min: [0, 0], max: [0.8, 0.6]}\n"
                           "water: {level: 0.3, seed: [0.4, 0.2]}\n"
                           "numerics: {settle_steps: 20}\n"
                           "measure: {interval: 0.01, gauges: [{name: g, x: 0.3}]}\n"
                           "output: {particle_interval: 0.02, plots: false}\n"
                           "render: {speed_max: 2}\n"; /* by default it depends on the model */

typedef struct bytes {
    uint8_t *data;
    size_t count;
} bytes;

static char directory[] = "/tmp/shorebreak-fuzz-resume-XXXXXX";
static sb_scene scene;
static run taker = {.lock = -1};
static bytes step, settling;
static char step_path[SB_PATH_MAX], settling_path[SB_PATH_MAX];

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)kind;
    (void)where;
    return remove(path);
}

static void clean_up(void)
{
    nftw(directory, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

static void must(sb_status status, const sb_error *error)
{
    if (status != SB_OK) fprintf(stderr, "%s\n", error->text);
    FUZZ_CHECK(status == SB_OK);
}

static bytes read_file(const char *path)
{
    char *data;
    size_t count;
    sb_error error = {0};
    must(sb_file_read(path, (size_t)1 << 24, &data, &count, &error), &error);
    return (bytes){(uint8_t *)data, count};
}

static void write_file(const char *path, bytes content)
{
    FILE *file = fopen(path, "wb");
    FUZZ_CHECK(file);
    FUZZ_CHECK(content.count == 0 || fwrite(content.data, 1, content.count, file) == content.count);
    FUZZ_CHECK(fclose(file) == 0);
}

/* Creates a simulation that has made no step, as a run does before it resumes. */
static void make_simulation(void)
{
    sb_error error = {0};
    sb_sim_destroy(taker.sim);
    taker.sim = NULL;
    must(sb_sim_create(&scene, &taker.model, NULL, &taker.sim, &error), &error);
}

static void save_third(void *context, int done, int most, double speed)
{
    (void)context;
    (void)most;
    (void)speed;
    if (done == 3) sb_checkpoint_write_settling(&taker);
}

/* Makes a run folder with its tables and both kinds of checkpoint. */
static void make(void)
{
    const sb_run_options quiet = {.quiet = true};
    sb_error error = {0};
    uint64_t *steps;
    size_t count;
    FUZZ_CHECK(mkdtemp(directory));
    atexit(clean_up);
    must(sb_scene_read(fuzz_save("scene.yaml", (const uint8_t *)text, strlen(text)), NULL, NULL, 0, &scene, &error),
         &error);
    must(sb_run(&scene, directory, &quiet, &error), &error);
    taker.scene = &scene;
    taker.directory = directory;
    taker.recorder.format = sb_particle_formats[0];
    must(sb_model_build(&scene, &taker.model, &error), &error);
    must(sb_checkpoint_begin(&taker, &error), &error);
    must(sb_checkpoint_identify(&taker, &error), &error);
    must(sb_checkpoint_list(&taker, &steps, &count, &error), &error);
    FUZZ_CHECK(count == 1);
    must(sb_checkpoint_path(&taker, steps[0], step_path, &error), &error);
    must(sb_checkpoint_settling_path(&taker, settling_path, &error), &error);
    sb_free(steps);
    step = read_file(step_path);
    make_simulation();
    must(sb_sim_settle_watched(taker.sim, save_third, NULL, &error), &error);
    settling = read_file(settling_path);
    must(sb_measure_create(&scene, &taker.model, taker.sim, &taker.measure, &error), &error);
}

static void try_bytes(bool settles, bytes content, bool valid)
{
    sb_error error = {0};
    write_file(settles ? settling_path : step_path, content);
    const sb_status status = settles ? sb_checkpoint_load_settling(&taker, &error) : sb_checkpoint_load(&taker, &error);
    if (status != SB_OK) fuzz_check_refusal(status, &error);
    if (valid) must(status, &error);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (!taker.sim) make();
    const bool settles = size > 0 && data[0] == 's', edits = settles || (size > 0 && data[0] == 'e');
    const bytes *whole = settles ? &settling : &step;
    bytes tried = {.count = edits ? whole->count : size};
    tried.data = malloc(tried.count ? tried.count : 1);
    FUZZ_CHECK(tried.data);
    memcpy(tried.data, edits ? whole->data : data, tried.count);
    if (edits) fuzz_edit(tried.data, tried.count, data + 1, size - 1);
    try_bytes(settles, tried, false);
    fuzz_repair(tried.data, tried.count, SB_CHECKPOINT_KIND, SB_CHECKPOINT_FORMAT);
    try_bytes(settles, tried, false);
    free(tried.data);
    /* After any error, the valid checkpoint can still be loaded. */
    try_bytes(settles, *whole, true);
    return 0;
}
