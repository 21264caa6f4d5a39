/* Quick forms of stress cases, by the programs themselves. */
#include "check.h"

#include "base/memory.h"
#include "tools/tool.h"

#include <stdio.h>
#include <string.h>

static char *spoken; /* by the last one that was run */

static int set_up(void **state)
{
    (void)state;
    return tool_begin();
}

static int tear_down(void **state)
{
    (void)state;
    sb_free(spoken);
    return tool_end();
}

/* Exit status of the battery with these arguments. */
static int stress(const char *arguments)
{
    char all[300];
    snprintf(all, sizeof all, "--jobs 1 %s", arguments);
    const int status = tool_run("shorebreak-stress", all);
    sb_free(spoken);
    spoken = tool_text("said");
    assert_non_null(spoken);
    return status;
}

static void must_pass(const char *names)
{
    char arguments[256];
    snprintf(arguments, sizeof arguments, "--quick %s", names);
    int status = stress(arguments);
    if (status != 0) fail_msg("exit status %d:\n%s", status, spoken);
}

static void test_still_water_rests(void **state)
{
    (void)state;
    must_pass("still-water flume");
}

static void test_thin_plates_hold(void **state)
{
    (void)state;
    must_pass("plates");
}

static void test_impacts_make_no_energy(void **state)
{
    (void)state;
    must_pass("drop jet");
}

static void test_each_solver_keeps_its_word(void **state)
{
    (void)state;
    must_pass("time-step tolerance");
}

static void test_walls_paddles_and_open_sides_hold(void **state)
{
    (void)state;
    must_pass("sampling paddles immersed leaving ends");
}

static void test_starts_frames_films_and_broken_meshes_hold(void **state)
{
    (void)state;
    must_pass("film frame start meshes");
}

/* Numerics at the ends of their ranges may spoil a run, but not the program. */
static void test_no_key_crashes_or_hangs(void **state)
{
    (void)state;
    int status = stress("--quick keys");
    if ((status != 0 && status != 4) || strstr(spoken, ": signal ") || strstr(spoken, ": hung"))
        fail_msg("exit status %d:\n%s", status, spoken);
}

static void test_what_was_run_is_kept(void **state)
{
    (void)state;
    must_pass("jet");
    assert_null(strstr(spoken, "exit status"));
    assert_true(tool_says("out/quick/stability.md", "slice-into-corner"));
    assert_true(tool_says("out/quick/stability.md", "not run")); /* other cases */
}

static void test_bad_command_lines(void **state)
{
    (void)state;
    assert_int_equal(stress("stil-water"), 1);
    assert_non_null(strstr(spoken, "stress: stil-water: no such case; --list names them"));
    assert_int_equal(stress("--quik"), 1);
    assert_non_null(strstr(spoken, "--quik: no such option"));
    assert_int_equal(stress(""), 1);
    assert_non_null(strstr(spoken, "no case named"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_still_water_rests),
        cmocka_unit_test(test_thin_plates_hold),
        cmocka_unit_test(test_impacts_make_no_energy),
        cmocka_unit_test(test_what_was_run_is_kept),
        cmocka_unit_test(test_each_solver_keeps_its_word),
        cmocka_unit_test(test_walls_paddles_and_open_sides_hold),
        cmocka_unit_test(test_starts_frames_films_and_broken_meshes_hold),
        cmocka_unit_test(test_no_key_crashes_or_hangs),
        cmocka_unit_test(test_bad_command_lines),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
