/* Tests of tools/validate: two cheap cases with tolerances for their coarse forms; a finished run is not repeated; bad
   command lines are refused. */
#include "check.h"

#include "sheet.h"
#include "tools/tool.h"

#include <stdio.h>
#include <string.h>

static sb_sheet results;

static int validate(const char *arguments)
{
    char all[1024];
    snprintf(all, sizeof all, "%s --jobs 2", arguments);
    return tool_run("shorebreak-validate", all);
}

static int set_up(void **state)
{
    (void)state;
    if (tool_begin() != 0) return -1;
    /* 0: all within their targets; 4: some missed, as coarse forms may. */
    int status = validate("--quick still-water-2d standing-wave");
    if (status != 0 && status != 4) return -1;
    sb_error error = {0};
    if (sb_sheet_read(tool_path("out/quick/validation/results.csv"), &results, &error) == SB_OK) return 0;
    print_error("%s\n", error.text);
    return -1;
}

static int tear_down(void **state)
{
    (void)state;
    sb_sheet_free(&results);
    return tool_end();
}

/* Value of a column for the judged figure. */
static double figure(const char *name, const char *quantity, const char *column)
{
    for (size_t row = 0; row < results.rows; row++)
        if (strcmp(sb_sheet_text(&results, row, sb_sheet_column(&results, "case")), name) == 0 &&
            strcmp(sb_sheet_text(&results, row, sb_sheet_column(&results, "judged")), "yes") == 0 &&
            strcmp(sb_sheet_text(&results, row, sb_sheet_column(&results, "quantity")), quantity) == 0)
            return sb_sheet_number(&results, row, sb_sheet_column(&results, column));
    fail_msg("no figure %s of %s", quantity, name);
    return (double)NAN;
}

static void test_still_water_stays_at_rest(void **state)
{
    (void)state;
    const char *name = "still-water-2d";
    assert_near(figure(name, "force on all bodies, mean", "value"), 1, 0.002);
    assert_true(figure(name, "force on all bodies, standard deviation", "value") <= 1);
    assert_true(figure(name, "kinetic energy, growth", "value") <= 5);
    assert_true(figure(name, "level, worst gauge", "value") <= 0.5);
    assert_true(figure(name, "speed, root mean square", "value") <= 1);
}

/* At 25 particles over the depth the wave is a particle and a quarter high. */
static void test_coarse_standing_wave_oscillates(void **state)
{
    (void)state;
    const char *name = "standing-wave";
    assert_near(figure(name, "period", "error"), 0, 5);
    assert_true(figure(name, "decay of the amplitude", "value") < 5); /* % per period */
    assert_true(figure(name, "second wave, half the wave number", "value") <= 10);
    assert_true(figure(name, "second wave, 1.5 times the wave number", "value") <= 10);
}

static void test_finished_run_is_not_repeated(void **state)
{
    (void)state;
    int status = validate("--quick still-water-2d");
    assert_true(status == 0 || status == 4);
    assert_false(tool_contains("output", "0.05 m:"));
    assert_true(tool_contains("output", "validation.md"));
    assert_true(tool_contains("out/quick/validation.md", "still-water-2d"));
    assert_true(tool_contains("out/quick/validation.md", "not run")); /* the other cases */
}

static void test_bad_command_lines_are_refused(void **state)
{
    (void)state;
    assert_int_equal(validate("still-watr"), 1);
    assert_true(tool_contains("output", "validate: still-watr: no such case; --list shows the cases"));
    assert_int_equal(validate("--quik"), 1);
    assert_true(tool_contains("output", "--quik: no such option"));
    assert_int_equal(validate(""), 1);
    assert_true(tool_contains("output", "no case given"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_still_water_stays_at_rest),
        cmocka_unit_test(test_coarse_standing_wave_oscillates),
        cmocka_unit_test(test_finished_run_is_not_repeated),
        cmocka_unit_test(test_bad_command_lines_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
