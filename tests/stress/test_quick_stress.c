/* Tests of tools/stress: quick forms of the stress cases. */
#include "check.h"

#include "base/memory.h"
#include "tools/tool.h"

#include <stdio.h>
#include <string.h>

static char *output; /* of the last run of the tool */

static int set_up(void **state)
{
    (void)state;
    return tool_begin();
}

static int tear_down(void **state)
{
    (void)state;
    sb_free(output);
    return tool_end();
}

/* Exit status of tools/stress with these arguments. */
static int stress(const char *arguments)
{
    char all[300];
    snprintf(all, sizeof all, "--jobs 1 %s", arguments);
    const int status = tool_run("shorebreak-stress", all);
    sb_free(output);
    output = tool_text("output");
    assert_non_null(output);
    return status;
}

static void assert_passes(const char *names)
{
    char arguments[256];
    snprintf(arguments, sizeof arguments, "--quick %s", names);
    int status = stress(arguments);
    if (status != 0) fail_msg("exit status %d:\n%s", status, output);
}

static void test_still_water(void **state)
{
    (void)state;
    assert_passes("still-water flume");
}

static void test_thin_plates(void **state)
{
    (void)state;
    assert_passes("plates");
}

static void test_impacts_add_no_energy(void **state)
{
    (void)state;
    assert_passes("drop jet");
}

static void test_solvers_meet_tolerances(void **state)
{
    (void)state;
    assert_passes("time-step tolerance");
}

static void test_walls_paddles_and_open_sides(void **state)
{
    (void)state;
    assert_passes("sampling paddles immersed leaving ends");
}

static void test_starts_frames_films_and_defective_meshes(void **state)
{
    (void)state;
    assert_passes("film frame start meshes");
}

/* Extreme values of keys may make a run fail, but must not crash the program. */
static void test_no_key_crashes_or_hangs(void **state)
{
    (void)state;
    int status = stress("--quick keys");
    if ((status != 0 && status != 4) || strstr(output, ": signal ") || strstr(output, ": hung"))
        fail_msg("exit status %d:\n%s", status, output);
}

static void test_trials_are_stored(void **state)
{
    (void)state;
    assert_passes("jet");
    assert_null(strstr(output, "exit status"));
    assert_true(tool_contains("out/quick/stability.md", "slice-into-corner"));
    assert_true(tool_contains("out/quick/stability.md", "not run")); /* other cases */
}

static void test_bad_command_lines_are_refused(void **state)
{
    (void)state;
    assert_int_equal(stress("stil-water"), 1);
    assert_non_null(strstr(output, "stress: stil-water: no such case; --list shows the cases"));
    assert_int_equal(stress("--quik"), 1);
    assert_non_null(strstr(output, "--quik: no such option"));
    assert_int_equal(stress(""), 1);
    assert_non_null(strstr(output, "no case given"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_still_water),
        cmocka_unit_test(test_thin_plates),
        cmocka_unit_test(test_impacts_add_no_energy),
        cmocka_unit_test(test_trials_are_stored),
        cmocka_unit_test(test_solvers_meet_tolerances),
        cmocka_unit_test(test_walls_paddles_and_open_sides),
        cmocka_unit_test(test_starts_frames_films_and_defective_meshes),
        cmocka_unit_test(test_no_key_crashes_or_hangs),
        cmocka_unit_test(test_bad_command_lines_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
