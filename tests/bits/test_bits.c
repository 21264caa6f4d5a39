/* Tests that runs have the same bits with 1, 2, 3 and 8 threads, with and without consumers, on this instruction set:
   the column and the plant at coarse spacings, the column with each preset. */
#include "app/program.h"

#include "base/memory.h"
#include "output/json_check.h"
#include "sim/sim.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Name of the instruction set of this program; "default": the basic set of the processor. */
#ifdef SB_INSTRUCTIONS
#define SET SB_INSTRUCTIONS
#else
#define SET "default"
#endif

/* fused: hash after 30 steps with fused multiply-add (x86-64-v3 and -v4), plain: without. They are those of the release
   build by gcc 12.2. A commit that changes bits on purpose changes them and says so. */
static const struct {
    const char *name, *file, *preset, *resolution, *settle;
    uint64_t fused, plain;
} scenes[] = {
    {"column", SB_SOURCE_DIR "/assets/validation/column/column.yaml", "default", "resolution=0.035",
     "numerics.settle_steps=20", 0xb7bd2cc85da603b1, 0xa4640c211224e24b},
    {"column with boundary particles", SB_SOURCE_DIR "/assets/validation/column/column.yaml", "paper",
     "resolution=0.035", "numerics.settle_steps=20", 0x2f5a2af1e0181126, 0x7d2e545b3b99ba4a},
    {"column with explicit steps", SB_SOURCE_DIR "/assets/validation/column/column.yaml", "wen", "resolution=0.035",
     "numerics.settle_steps=0", 0xc2cb2e4487cd2b92, 0x1f6b1b16aeec0e2c},
    {"plant", SB_SOURCE_DIR "/assets/scenes/plant.yaml", "default", "resolution=20", "numerics.settle_steps=20",
     0xcb8876efbbaa6b8e, 0xf51e72a053ac1153},
};

static uint64_t count_steps(void)
{
    const char *value = getenv("SB_BITS_STEPS");
    return value && *value ? strtoull(value, NULL, 10) : 30;
}

/* The instruction set that shorebreak selects on this machine. */
static const char *selected_set(void)
{
#ifdef SB_INSTRUCTIONS
    __builtin_cpu_init();
    return __builtin_cpu_supports("x86-64-v4")   ? "x86-64-v4"
           : __builtin_cpu_supports("x86-64-v3") ? "x86-64-v3"
                                                 : "x86-64";
#else
    return "default";
#endif
}

static bool is_available(void)
{
    return strcmp(selected_set(), "x86-64-v4") == 0 || strcmp(SET, selected_set()) == 0 || strcmp(SET, "x86-64") == 0;
}

typedef struct end {
    uint64_t hash;
    double time; /* s */
} end;

/* Holds the state to the kept one, where the build is that of the kept states. */
static void check_kept(size_t s, uint64_t hash)
{
#if defined(SB_INSTRUCTIONS) && defined(NDEBUG) && !defined(__clang__) && __GNUC__ == 12 && __GNUC_MINOR__ == 2
    const uint64_t kept = strcmp(SET, "x86-64") == 0 ? scenes[s].plain : scenes[s].fused;
    if (count_steps() == 30 && hash != kept)
        fail_msg("%s, %s: the state hash is %016llx, expected %016llx: does a commit change bits without meaning to?",
                 SET, scenes[s].name, (unsigned long long)hash, (unsigned long long)kept);
#else
    (void)s;
    (void)hash;
#endif
}

static end run_simulation(const sb_scene *scene, const sb_model *model, int threads)
{
    sb_sim *sim = NULL;
    sb_error error = {0};
    omp_set_num_threads(threads);
    sb_status status = sb_sim_create(scene, model, NULL, &sim, &error);
    if (status == SB_OK) status = sb_sim_settle(sim, &error);
    for (uint64_t step = count_steps(); step > 0 && status == SB_OK; step--) status = sb_sim_step(sim, &error);
    if (status != SB_OK) fail_msg("%s", error.text);
    const end final = {sb_sim_hash(sim), sb_sim_report(sim)->time};
    sb_sim_destroy(sim);
    return final;
}

/* Runs shorebreak to the same time, with all consumers of frames or without any. */
static void check_program(size_t s, end final, bool consumers, const char *threads)
{
    char until[40], hash[32], frames[3][192];
    snprintf(until, sizeof until, "%.17g", final.time);
    const double interval = consumers ? final.time / 5 : 0;
    const double pictures = getenv("SB_BITS_STEPS")
                                ? interval
                                : 0; /* pictures take long; test_consumers_hash draws some in every test run */
    snprintf(frames[0], sizeof frames[0],
             "render={interval: %.6g, width: 64, height: 36, video: false, cameras: [{name: c, eye: [0, -500, 500], "
             "target: [0, 0, 0]}]}",
             pictures);
    snprintf(frames[1], sizeof frames[1], "output={particle_interval: %.6g, plots: false}", interval);
    snprintf(frames[2], sizeof frames[2], "stream={enabled: %s, url: 'memq://'}", consumers ? "true" : "false");
    RUN_AND_FORGET(0, "run", scenes[s].file, "--out", "bits", "--quiet", "--overwrite", "--until", until, "--threads",
                   threads, "--preset", scenes[s].preset, "--set", scenes[s].resolution, "--set", scenes[s].settle,
                   "--set", frames[0], "--set", frames[1], "--set", frames[2]);
    char *text = text_of("bits/summary.json");
    const char *value = json_find(text, "state_hash");
    assert_non_null(value);
    assert_int_equal(sscanf(value, "\"%31[0-9a-f]\"", hash), 1);
    sb_free(text);
    assert_near(json_number_of("bits/summary.json", "steps"), (double)count_steps(), 0);
    if (strtoull(hash, NULL, 16) != final.hash)
        fail_msg("%s: %s threads %s consumers: the state hash of shorebreak is %s, expected %016llx", scenes[s].name,
                 threads, consumers ? "with" : "without", hash, (unsigned long long) final.hash);
}

static void check_scene(size_t s)
{
    static const int counts[] = {2, 3, 8};
    char resolution[64], steps[64];
    sb_scene scene = {0};
    sb_model model = {0};
    sb_error error = {0};
    snprintf(resolution, sizeof resolution, "%s", strchr(scenes[s].resolution, '=') + 1);
    snprintf(steps, sizeof steps, "%s", strchr(scenes[s].settle, '=') + 1);
    const sb_override overrides[] = {{"resolution", resolution}, {"numerics.settle_steps", steps}};
    if (sb_scene_read(scenes[s].file, scenes[s].preset, overrides, 2, &scene, &error) != SB_OK ||
        sb_model_build(&scene, &model, &error) != SB_OK)
        fail_msg("%s", error.text);
    const end alone = run_simulation(&scene, &model, 1);
    printf("%s, %s: %016llx after %llu steps, %g s\n", SET, scenes[s].name, (unsigned long long)alone.hash,
           (unsigned long long)count_steps(), alone.time);
    check_kept(s, alone.hash);
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        if (run_simulation(&scene, &model, counts[c]).hash != alone.hash)
            fail_msg("%s: %d threads give another state", scenes[s].name, counts[c]);
    sb_model_free(&model);
    sb_scene_free(&scene);
    if (strcmp(SET, selected_set()) != 0) return;
    check_program(s, alone, false, "1");
    check_program(s, alone, true, "3");
}

static void scene_has_its_bits(void **state)
{
    const size_t *row = *state;
    check_scene(*row);
}

int main(void)
{
    enum { ROWS = sizeof scenes / sizeof *scenes };
    struct CMUnitTest tests[ROWS];
    size_t rows[ROWS];
    if (!is_available()) return 77; /* the processor does not have this instruction set */
    for (size_t s = 0; s < ROWS; s++) {
        rows[s] = s;
        tests[s] =
            (struct CMUnitTest){.name = scenes[s].name, .test_func = scene_has_its_bits, .initial_state = &rows[s]};
    }
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
