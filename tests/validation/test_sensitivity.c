/* Tests of the sensitivity report for runs within, beyond their targets, failed, and without effect. */
#include "check.h"

#include "base/memory.h"
#include "sensitivity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const sb_plan plan = {.resolution = 0.1, .judged = true};
static const sb_case of = {.name = "a", .headline = "height"};

static void add(sb_result *r, double height, double noise)
{
    r->state = SB_RESULT_DONE;
    sb_figure_share(&r->figures, "height", "m", 2, height, 2, 10, " ");
    sb_figure_below(&r->figures, "noise", "%", noise, 1, " ");
    sb_figure_report(&r->figures, "pressure", "Pa", (double)NAN, 1e6, " ");
}

/* With the defaults both figures are within their targets. Seed 2 misses one; the height of seed 3 could not be
   measured. The first key's decreased run failed; the last key's change has no effect. */
static void test_report_shows_headline_and_largest_error(void **state)
{
    (void)state;
    const sb_common_options options = {.command = "a command"};
    const sb_store store = {.options = &options, .machine = "a machine", .commit = "abc"};
    sb_sensitivity_study study = {.store = &store, .count = 1};
    const size_t runs = 1 + SB_SENSITIVITY_PAIR * sb_sensitivity_rows();
    study.runs = sb_alloc(runs, sizeof *study.runs);
    assert_non_null(study.runs);
    for (size_t i = 0; i < runs; i++) study.runs[i].request = (sb_request){.of = &of, .plan = &plan};
    add(&study.runs[0], 2.1, 0.25);
    study.runs[0].run.scene.numerics = (sb_numerics){.support = 2.5};
    add(&study.runs[1], 1.9, 4);
    add(&study.runs[2], (double)NAN, 0.1);
    study.runs[3].state = SB_RESULT_FAILED;
    study.runs[runs - 1].request.of = NULL;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    sb_sensitivity_report(out, &study);
    assert_int_equal(fclose(out), 0);
    assert_non_null(strstr(text, "| (defaults) | | +5 |\n| (start seed 2 / 3) | 1 | -5 / –! |\n"));
    assert_non_null(strstr(text, "| support | 2.5 | failed / – |\n"));
    assert_non_null(strstr(text, "- a: height, error in %, target 10, at 0.1 m\n"));
    assert_non_null(
        strstr(text, "| (defaults) | | 2 of 2, 0.5× |\n| (start seed 2 / 3) | 1 | 1 of 2, 4× / 1 of 2, none |\n"));
    assert_non_null(strstr(text, "- a: height\n"));
    free(text);
    for (size_t i = 0; i < runs; i++) sb_figures_free(&study.runs[i].figures);
    sb_free(study.runs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_report_shows_headline_and_largest_error)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
