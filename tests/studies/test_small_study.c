/* Tests of tools/study with a still tank: impulses equal the weight, finished runs are not repeated, quantities can be
   selected, a report stays if nothing is stored, bad command lines are refused. */
#include "check.h"

#include "sheet.h"
#include "tools/tool.h"

#include <stdio.h>
#include <string.h>

#define SCENE "'" SB_SOURCE_DIR "/assets/validation/still-water/flat.yaml'"
#define TINY SCENE " --resolutions 0.05,0.1 --seeds 2 --set duration=0.5 --set numerics.time_step_max=0.005"

static int study(const char *arguments)
{
    char all[2048];
    snprintf(all, sizeof all, "%s --jobs 2", arguments);
    return tool_run("shorebreak-study", all);
}

static int set_up(void **state)
{
    (void)state;
    return tool_begin() == 0 && study(TINY) == 0 ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    return tool_end();
}

/* The tank carries 1000 kg/m for 0.5 s and at most a step more, at every spacing. */
static void test_vertical_impulse_is_weight_times_duration(void **state)
{
    (void)state;
    sb_sheet sheet = {0};
    size_t met = 0;
    assert_int_equal(sb_sheet_read(tool_path("out/runs.csv"), &sheet, NULL), SB_OK);
    size_t value = sb_sheet_column(&sheet, "value"), seed = sb_sheet_column(&sheet, "seed");
    for (size_t r = 0; r < sheet.rows; r++) {
        if (!strstr(sb_sheet_text(&sheet, r, 0), "vertical impulse")) continue;
        assert_near(sb_sheet_number(&sheet, r, value), -9810 * 0.5, 0.02 * 9810 * 0.5);
        assert_near(sb_sheet_number(&sheet, r, seed), (double)(1 + met % 2), 0);
        assert_true(sb_sheet_number(&sheet, r, sb_sheet_column(&sheet, "cpu_s")) > 0);
        met++;
    }
    assert_int_equal(met, 4);
    sb_sheet_free(&sheet);
}

static void test_report_has_every_kind_of_quantity(void **state)
{
    (void)state;
    assert_true(tool_contains("out/study.md", "study.png") || tool_contains("out/study.md", "No plot"));
    assert_true(tool_contains("out/study.md", "| tank, impulse |"));
    assert_true(tool_contains("out/study.md", "| tank, peak |"));
    assert_true(tool_contains("out/study.md", "| g1, crest |"));
    assert_true(tool_contains("out/study.md", "two spacings: first order assumed"));
    assert_true(tool_contains("out/orders.csv", "two spacings: first order assumed"));
}

static void test_runs_are_stored_and_patterns_select(void **state)
{
    (void)state;
    assert_int_equal(study(TINY " --quantity 'g?, *' --quantity 'tank, peak'"), 0);
    assert_false(tool_contains("output", "flat, 0.1 m:"));
    assert_true(tool_contains("output", "| g2, crest |"));
    assert_true(tool_contains("output", "| tank, peak |"));
    assert_false(tool_contains("output", "| tank, impulse |"));
    assert_int_equal(study(TINY " --quantity nothing"), 1);
    assert_true(tool_contains("output", "--quantity"));
}

/* No run of this duration is stored. */
static void test_report_stays_without_runs(void **state)
{
    (void)state;
    assert_int_equal(study(TINY " --set duration=0.25 --report-only"), 0);
    assert_true(tool_contains("output", "study.md: not changed, because "));
    assert_true(tool_contains("out/study.md", "| g2, crest |"));
}

static void test_bad_command_lines_are_refused(void **state)
{
    (void)state;
    assert_int_equal(study(SCENE), 1);
    assert_true(tool_contains("output", "expected two spacings or more"));
    assert_int_equal(study(SCENE " --resolutions 0.1,x"), 1);
    assert_true(tool_contains("output", "--resolutions 0.1,x: expected metres > 0"));
    assert_int_equal(study(SCENE " --resolutions 0.1,0.2,0.1"), 1);
    assert_true(tool_contains("output", "0.1 is given twice"));
    assert_int_equal(study(SCENE " --resolutions 0.2,0.1 --set resolution=1"), 1);
    assert_true(tool_contains("output", "use --resolutions, --seeds or --preset for this key"));
    assert_int_equal(study(SCENE " --resolutions 0.2,0.1 --set nothing.there=1"), 1);
    assert_true(tool_contains("output", "nothing"));
    assert_int_equal(study("/nowhere.yaml --resolutions 0.2,0.1"), 1);
    assert_true(tool_contains("output", "/nowhere.yaml: no such file"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_vertical_impulse_is_weight_times_duration),
        cmocka_unit_test(test_report_has_every_kind_of_quantity),
        cmocka_unit_test(test_runs_are_stored_and_patterns_select),
        cmocka_unit_test(test_report_stays_without_runs),
        cmocka_unit_test(test_bad_command_lines_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
