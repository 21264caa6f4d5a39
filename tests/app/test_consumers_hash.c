/* Neither consumers nor the number of threads change a bit of a run's final state. */
#include "program.h"

#include "../output/json_check.h"
#include "base/memory.h"

#include <stdio.h>
#include <string.h>

/* More particles than one block of a parallel loop holds. */
#define SPACING "resolution=0.06", "--set", "numerics.settle_steps=20"

static char plain[32];

static void hash_of(const char *run, char hash[32])
{
    char name[64];
    snprintf(name, sizeof name, "%s/summary.json", run);
    char *text = text_of(name);
    const char *value = json_find(text, "state_hash");
    assert_non_null(value);
    assert_int_equal(sscanf(value, "\"%31[0-9a-f]\"", hash), 1);
    assert_int_equal(strlen(hash), 16);
    sb_free(text);
}

/* The reference: one thread, no consumer. */
static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "plain", "--quiet", "--until", "0.06", "--set", SPACING, "--set",
                   "render.interval=0", "--set", "output.particle_interval=0");
    hash_of("plain", plain);
    assert_near(json_number_of("plain/summary.json", "pictures"), 0, 0);
    assert_near(json_number_of("plain/summary.json", "particle_files"), 0, 0);
    assert_true(json_number_of("plain/summary.json", "fluid_particles") > 1500);
    return 0;
}

static void pictures_and_files_change_nothing(void **state)
{
    (void)state;
    char hash[32];
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "drawn", "--quiet", "--until", "0.06", "--set", SPACING, "--set",
                   "render.interval=0.02", "--set", "output.particle_interval=0.01");
    hash_of("drawn", hash);
    assert_string_equal(hash, plain);
    assert_near(json_number_of("drawn/summary.json", "pictures"), 4, 0);
    assert_near(json_number_of("drawn/summary.json", "particle_files"), 7, 1);
}

static void the_stream_changes_nothing(void **state)
{
    (void)state;
    char hash[32];
    outcome o = RUN(0, "run", "tank3.yaml", "--out", "sent", "--quiet", "--until", "0.06", "--set", SPACING, "--set",
                    "render.interval=0", "--set", "output.particle_interval=0", "--set", "stream.enabled=true", "--set",
                    "stream.url='memq://'", "--set", "stream.interval=0.01");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    hash_of("sent", hash);
    assert_string_equal(hash, plain);
    char *log = text_of("sent/run.jsonl");
    assert_contains(log, "\"stream: "); /* the log contains its number of frames */
    assert_null(strstr(log, "stream: off"));
    assert_null(strstr(log, "stream: 0 frames"));
    sb_free(log);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    static const char *const counts[] = {"1", "2", "3"};
    for (int i = 0; i < 3; i++) {
        char hash[32];
        RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "threads", "--quiet", "--overwrite", "--until", "0.06", "--set",
                       SPACING, "--set", "render.interval=0", "--threads", counts[i]);
        assert_near(json_number_of("threads/summary.json", "threads"), i + 1, 0);
        hash_of("threads", hash);
        assert_string_equal(hash, plain);
    }
}

/* Different states have different hashes. */
static void the_hash_depends_on_the_state(void **state)
{
    (void)state;
    char hash[32];
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "other", "--quiet", "--until", "0.06", "--set", SPACING, "--set",
                   "render.interval=0", "--set", "output.particle_interval=0", "--set", "fluid.gravity=9.8");
    hash_of("other", hash);
    assert_string_not_equal(hash, plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_and_files_change_nothing),
        cmocka_unit_test(the_stream_changes_nothing),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(the_hash_depends_on_the_state),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
