/* Makes the n-th allocation of a whole run fail: the run must report it and free all of its memory. One n in STRIDE is
   tested; all of them if SB_EACH_ALLOCATION is "all". */
#include "../check.h"

#include "app/run/run.h"
#include "base/file.h"
#include "base/memory.h"
#include "render/renderer.h"
#include "sim/sim.h"

#include <fcntl.h>
#include <ftw.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { STRIDE = 37, RUNS_MAX = 100000 };

/* Number of blocks that src/base/memory.c has in use. No other file of the project calls these two functions. */
static atomic_long blocks;
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *pointer);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *pointer);

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    void *pointer = __real_aligned_alloc(alignment, size);
    atomic_fetch_add(&blocks, pointer != NULL);
    return pointer;
}

void __wrap_free(void *pointer)
{
    atomic_fetch_sub(&blocks, pointer != NULL);
    __real_free(pointer);
}

static const char text[] =
    "title: a small run\n"
    "dimensions: 2\n"
    "resolution: 0.1\n"
    "duration: 0.03\n"
    "domain: {min: [0, 0], max: [1.2, 0.8]}\n"
    "water: {boxes: [{min: [0.2, 0], max: [0.7, 0.4]}]}\n"
    "numerics: {settle_steps: 2}\n"
    "bodies:\n"
    "  - {name: paddle, shape: box, min: [0, 0], max: [0.1, 0.6]}\n"
    "  - {name: step, shape: box, min: [0.8, 0], max: [1.2, 0.2], report: true}\n"
    "wavemakers: [{name: w, body: paddle, kind: goring, height: 0.05, depth: 0.4, direction: [1, 0]}]\n"
    "measure:\n"
    "  interval: 0.01\n"
    "  gauges: [{name: wet, x: 0.4}, {name: a, x: 0.5}, {name: b, x: 0.7}]\n"
    "  reflections: [{name: s, gauges: [wet, a, b], period: 0.1, harmonics: 2, depth: 0.4, window: 0.1}]\n"
    "  probes: [{name: deep, at: [0.4, 0.2]}]\n"
    "  planes: [{name: over, from: [0.9], to: [0.9], z_min: 0, z_max: 0.8, record: true}]\n"
    "  runups: [{name: up, from: [0.5], to: [1.1]}]\n"
    "  map: {min: [0], max: [1], cell: 0.2}\n"
    "render:\n"
    "  interval: 0\n"
    "  width: 32\n"
    "  height: 32\n"
    "  cameras: [{name: side, eye: [1, -3, 1.5], target: [1, 0.4, 0.3]}]\n"
    "output: {particle_interval: 0.02, plots: false, checkpoint: {minutes: 0}}\n";

static char folder[] = "/tmp/shorebreak-memory-XXXXXX";
static char scene_path[64], out_path[64];

static int remove_entry(const char *path, const struct stat *about, int kind, struct FTW *where)
{
    (void)about, (void)kind, (void)where;
    return remove(path);
}

static sb_status run_with(const sb_override *override, const sb_run_options *manner, sb_error *error)
{
    sb_scene scene = {0};
    sb_status status = sb_scene_read(scene_path, NULL, override, override != NULL, &scene, error);
    if (status == SB_OK) status = sb_run(&scene, out_path, manner, error);
    sb_scene_free(&scene);
    return status;
}

/* Runs a scene from its text to the end. */
static sb_status run_once(sb_error *error)
{
    return run_with(NULL, &(sb_run_options){.overwrite = true, .quiet = true}, error);
}

/* A run that writes checkpoints, and one that resumes from a checkpoint. A run continues if memory for writing a
   checkpoint runs out. */
static const sb_override checkpoints = {"output.checkpoint.steps", "2"};

static sb_status run_saved(sb_error *error)
{
    return run_with(&checkpoints, &(sb_run_options){.overwrite = true, .quiet = true}, error);
}

static sb_status run_resumed(sb_error *error)
{
    return run_with(&checkpoints, &(sb_run_options){.quiet = true, .resume = true}, error);
}

/* Draws a picture of the model at rest. */
static sb_status draw_once(sb_error *error)
{
    sb_scene scene = {0};
    sb_model model = {0};
    sb_sim *sim = NULL;
    sb_renderer *renderer = NULL;
    sb_image image = {0};
    sb_frame *frame = NULL;
    sb_status status = sb_scene_read(scene_path, NULL, NULL, 0, &scene, error);
    if (status == SB_OK) status = sb_model_build(&scene, &model, error);
    if (status == SB_OK) status = sb_sim_create(&scene, &model, NULL, &sim, error);
    if (status == SB_OK && !(frame = sb_sim_snapshot(sim))) status = sb_fail_memory(error, "a frame");
    if (status == SB_OK) status = sb_renderer_create(&scene, &model, &renderer, error);
    if (status == SB_OK) status = sb_renderer_draw(renderer, frame, 0, &image, error);
    if (status == SB_OK) status = sb_png_write(out_path, &image, error);
    sb_image_free(&image);
    sb_renderer_destroy(renderer);
    sb_frame_release(frame);
    sb_sim_destroy(sim);
    sb_model_free(&model);
    sb_scene_free(&scene);
    return status;
}

static void check_failure(long n, sb_status status, bool may_continue, const sb_error *error)
{
    if (may_continue && status == SB_OK) return;
    if (status != SB_FAILED || !strstr(error->text, "out of memory"))
        fail_msg("allocation %ld: status %d, \"%s\"", n, (int)status, error->text);
}

/* Calls the work with stderr discarded, because it prints many warnings here. Returns its status. */
static sb_status quietly(sb_status (*work)(sb_error *), sb_error *error)
{
    int saved = dup(STDERR_FILENO), null = open("/dev/null", O_WRONLY);
    dup2(null, STDERR_FILENO);
    close(null);
    sb_status status = work(error);
    dup2(saved, STDERR_FILENO);
    close(saved);
    return status;
}

/* Runs with the n-th allocation failing, for increasing n, until a run makes fewer than n allocations. Returns that n.
   may_continue: the work may succeed without the failed allocation. */
static long fail_each(sb_status (*work)(sb_error *), long first, long stride, bool may_continue)
{
    for (long n = first; n < RUNS_MAX; n += stride) {
        sb_error error = {0};
        long before = atomic_load(&blocks);
        sb_memory_fail_at(n);
        sb_status status = quietly(work, &error);
        bool failed = !sb_memory_fail_pending();
        sb_memory_fail_at(0);
        if (atomic_load(&blocks) != before)
            fail_msg("allocation %ld: %ld blocks left", n, atomic_load(&blocks) - before);
        if (!failed) {
            if (status != SB_OK) fail_msg("%s", error.text);
            print_message("%ld allocations\n", n - 1);
            return n;
        }
        check_failure(n, status, may_continue, &error);
    }
    fail_msg("more than %d allocations", RUNS_MAX);
    return 0;
}

static long chosen_stride(void)
{
    const char *requested = getenv("SB_EACH_ALLOCATION");
    return requested && strcmp(requested, "all") == 0 ? 1 : STRIDE;
}

static void test_a_run(void **state)
{
    (void)state;
    sb_error error = {0};
    if (run_once(&error) != SB_OK) fail_msg("%s", error.text);
    assert_true(fail_each(run_once, 1, chosen_stride(), false) > 300);
}

static void test_checkpoints(void **state)
{
    (void)state;
    sb_error error = {0};
    if (run_saved(&error) != SB_OK) fail_msg("%s", error.text);
    assert_true(fail_each(run_resumed, 1, chosen_stride(), true) > 100);
    assert_true(fail_each(run_saved, 1, chosen_stride(), true) > 300);
}

static void test_a_picture(void **state)
{
    (void)state;
    sb_error error = {0};
    nftw(out_path, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    if (draw_once(&error) != SB_OK) fail_msg("%s", error.text);
    assert_true(fail_each(draw_once, 1, chosen_stride(), false) > 30);
}

static int make_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder)) return -1;
    snprintf(scene_path, sizeof scene_path, "%s/scene.yaml", folder);
    snprintf(out_path, sizeof out_path, "%s/out", folder);
    FILE *file = fopen(scene_path, "w");
    return file && fputs(text, file) >= 0 && fclose(file) == 0 ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_run),
        cmocka_unit_test(test_checkpoints),
        cmocka_unit_test(test_a_picture),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
