/* Every delivered scene passes `check` unchanged, and runs a few steps at a coarse spacing. */
#include "program.h"

#include "../output/json_check.h"
#include "base/memory.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Factor on the particle spacing: the plant at 6 m then has some thousand particles. */
static const double COARSER = 2.5;
enum { STEPS = 4 };

static double number(const char *json, const char *key)
{
    const char *value = json_find(json, key);
    if (!value) fail_msg("no %s in %s", key, json);
    return strtod(value, NULL);
}

static void check_and_run(const char *scene, const char *name)
{
    char spacing[64], until[64], run[512];
    outcome o = RUN(0, "check", scene, "--json");
    assert_true(json_valid(o.out));
    if (strstr(o.out, "\"cell_m\"")) { /* depth-averaged water alone: seconds */
        assert_true(number(o.out, "wet_cells") > 100);
        outcome_free(&o);
        RUN_AND_FORGET(0, "run", scene, "--out", name, "--quiet", "--set", "output.plots=false");
        return;
    }
    assert_true(number(o.out, "fluid_particles") > 500);
    snprintf(spacing, sizeof spacing, "resolution=%.9g", COARSER * number(o.out, "resolution_m"));
    snprintf(until, sizeof until, "%.9g", STEPS * COARSER * number(o.out, "time_step_s"));
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", scene, "--out", name, "--quiet", "--until", until, "--set", spacing, "--set",
                   "render.interval=0", "--set", "output.particle_interval=0", "--set", "output.plots=false", "--set",
                   "numerics.settle_steps=10");
    snprintf(run, sizeof run, "%s/summary.json", name);
    assert_true(json_number_of(run, "steps") >= STEPS);
    assert_true(json_number_of(run, "fluid_particles") > 50);
    assert_near(json_number_of(run, "lost_particles"), 0, 0);
}

static void every_scene_checks_and_runs(void **state)
{
    (void)state;
    const char *const folder = SB_SOURCE_DIR "/assets/scenes";
    static const char *const promised[] = {"plant.yaml",       "dam-break-column.yaml", "solitary-flume.yaml",
                                           "still-water.yaml", "open-sea.yaml",         "plant-coast.yaml"};
    for (size_t p = 0; p < sizeof promised / sizeof promised[0]; p++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, promised[p]);
        if (access(path, R_OK) != 0) fail_msg("no %s", path);
    }
    DIR *listing = opendir(folder);
    assert_non_null(listing);
    for (struct dirent *entry; (entry = readdir(listing));) {
        char path[1024];
        size_t length = strlen(entry->d_name);
        if (length < 6 || strcmp(entry->d_name + length - 5, ".yaml") != 0) continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        print_message("%s\n", entry->d_name);
        check_and_run(path, entry->d_name);
    }
    closedir(listing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_scene_checks_and_runs)};
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
