/* shorebreak compare on real runs in 2D and 3D, with a film; and refusals. */
#include "program.h"

#include "base/memory.h"

#include <string.h>

static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "a", "--quiet", "--set",
                   "measure.map={min: [0, 0], max: [2.6, 0.8], cell: 0.1}");
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "b", "--quiet", "--set",
                   "measure.map={min: [0, 0], max: [2.6, 0.8], cell: 0.1}", "--set", "fluid.gravity=7");
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "c", "--quiet", "--set",
                   "measure.map={min: [0, 0], max: [2.6, 0.8], cell: 0.1}", "--set", "numerics.seed=5");
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "flat", "--quiet");
    return 0;
}

static void two_runs(void **state)
{
    (void)state;
    outcome o = RUN(0, "compare", "a", "b", "--out", "ab");
    assert_string_equal(o.err, "");
    assert_contains(o.out, "Loads on bodies\n");
    assert_contains(o.out, "post ");
    assert_contains(o.out, "ab/compare.html: ");
    outcome_free(&o);
    char *page = text_of("ab/compare.html");
    assert_contains(page, "<th scope=\"row\">fluid.gravity</th><td>9.81 m/s2</td><td>7 m/s2</td>");
    assert_contains(page, "numerics.seed=2");
    sb_free(page);
    assert_true(exists("ab/compare.csv"));
    assert_true(exists("ab/depth-difference-2.asc"));
    char *csv = text_of("ab/compare.csv");
    assert_contains(csv, "body,post,depth,m,b,1,"); /* the summary has the body's rectangle */
    sb_free(csv);
}

static void seeds(void **state)
{
    (void)state;
    outcome o = RUN(0, "compare", "b", "a", "c", "--out", "seeds");
    assert_contains(o.out, "a (2 runs)");
    outcome_free(&o);
}

static void refusals(void **state)
{
    (void)state;
    outcome o = RUN(1, "compare", "a", "flat");
    assert_one_line(o.err, "have 3 and 2 dimensions");
    assert_string_equal(o.out, "");
    outcome_free(&o);
    o = RUN(1, "compare", "a");
    assert_one_line(o.err, "1 run given: expected 2");
    outcome_free(&o);
    o = RUN(1, "compare");
    assert_one_line(o.err, "no run directory given");
    outcome_free(&o);
    assert_false(exists("compare"));
}

/* report --film has the film of the run, or says why not. */
static void film_in_a_report(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "report", "a", "--film", "--quiet");
    char *page = text_of("a/report.html");
    assert_contains(page, exists("a/side.mp4") ? "src=\"data:video/mp4;base64," : "The run has no film");
    sb_free(page);
    RUN_AND_FORGET(0, "report", "flat", "--film", "--quiet");
    page = text_of("flat/report.html");
    assert_contains(page, "The run has no film");
    sb_free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(two_runs), cmocka_unit_test(seeds), cmocka_unit_test(refusals),
                                       cmocka_unit_test(film_in_a_report)};
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
