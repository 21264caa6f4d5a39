/* Tests of figures, of their judgement over seeds, and of theory. */
#include "check.h"

#include "results.h"
#include "theory.h"

#include <string.h>

static void test_errors_and_limits(void **state)
{
    (void)state;
    sb_figures f = {0};
    sb_figure_share(&f, "a", "N", 200, 190, 200, 5, "over %d", 3);
    sb_figure_share(&f, "b", "N", 200, 189, 200, 5, "%s", "");
    sb_figure_difference(&f, "c", "s", 1, 1.2, 0.1, "%s", "");
    sb_figure_below(&f, "d", "%", -30, 1, "%s", "");
    sb_figure_below(&f, "e", "%", (double)NAN, 1, "%s", "");
    sb_figure_report(&f, "g", "m", (double)NAN, 3, "%s", "");
    const bool passes[] = {true, false, false, true, false, true};
    const double errors[] = {-5, -5.5, 0.2, -30};
    for (size_t i = 0; i < 6; i++) assert_int_equal(f.rows[i].pass, passes[i]);
    for (size_t i = 0; i < 4; i++) assert_near(f.rows[i].error, errors[i], 1e-12);
    assert_string_equal(f.rows[0].note, "over 3");
    assert_ptr_equal(sb_figures_find(&f, "c"), &f.rows[2]);
    assert_null(sb_figures_find(&f, "z"));
    sb_figures_free(&f);
}

static void test_band_error_is_from_nearer_edge(void **state)
{
    (void)state;
    static const double values[] = {15, 20, 23, 24, 8.5, 8, (double)NAN};
    static const double errors[] = {0, 0, 15, 20, -15, -20};
    static const bool passes[] = {true, true, true, false, true, false, false};
    sb_figures f = {0};
    for (size_t i = 0; i < 7; i++) {
        sb_figure_band(&f, "p", "Pa", 10, 20, values[i], 15, "%s", "");
        assert_int_equal(f.rows[i].pass, passes[i]);
        if (i < 6) assert_near(f.rows[i].error, errors[i], 1e-12);
    }
    sb_figures_free(&f);
}

enum { SEEDS = 3 };

static void test_worst_seed_decides(void **state)
{
    (void)state;
    static const double values[SEEDS] = {101, 97, 102};
    sb_plan plan = {.resolution = 1, .judged = true, .seeds = SEEDS}, coarse = {.resolution = 2};
    sb_result runs[SEEDS + 1];
    memset(runs, 0, sizeof runs);
    for (int i = 0; i < SEEDS; i++) {
        runs[i + 1].request = (sb_request){.plan = &plan, .seed = i + 1};
        runs[i + 1].state = SB_RESULT_DONE;
        sb_figure_share(&runs[i + 1].figures, "v", "", 100, values[i], 100, 2.5, "%s", "");
        sb_figure_below(&runs[i + 1].figures, "one-sided", "%", values[i] - 101, 2, "%s", "");
    }
    runs[0].request = (sb_request){.plan = &coarse, .seed = 1};
    runs[0].state = SB_RESULT_DONE;
    sb_case_results results = {.count = SEEDS + 1, .runs = runs};
    assert_ptr_equal(sb_results_judged(&results), &runs[1]);
    sb_judgement j = sb_results_judge(&results, 0);
    assert_int_equal(j.seeds, SEEDS);
    assert_near(j.mean, 100, 1e-12);
    assert_near(j.worst, -3, 1e-12);
    sb_seed_spread spread = sb_results_spread(&results, "v");
    assert_near(spread.value, 5, 1e-12);
    assert_near(spread.resolution, 1, 0);
    assert_true(isnan(sb_results_spread(&results, "unknown").value));
    assert_false(j.pass);
    assert_near(sb_results_judge(&results, 1).worst, 1, 1e-12); /* not -4 */
    size_t limited, passed;
    sb_results_count(&results, &limited, &passed);
    assert_int_equal(limited, 2);
    assert_int_equal(passed, 1);
    snprintf(runs[2].run.build, sizeof runs[2].run.build, "another");
    j = sb_results_judge(&results, 0);
    assert_int_equal(j.seeds, SEEDS - 1);
    assert_near(j.worst, 2, 1e-12);
    /* If the judged spacing has one seed, the spread is that of the spacing with several seeds. */
    coarse.judged = true;
    plan.judged = false;
    sb_figure_share(&runs[0].figures, "v", "", 100, 7, 100, 2.5, "%s", "");
    assert_ptr_equal(sb_results_judged(&results), &runs[0]);
    assert_int_equal(sb_results_judge(&results, 0).seeds, 1);
    spread = sb_results_spread(&results, "v");
    assert_near(spread.value, 1, 1e-12); /* 101 and 102; the run of another program does not count */
    assert_near(spread.resolution, 1, 0);
    runs[3].figures.rows[0].value = (double)NAN; /* not measured: no spread is known */
    assert_true(isnan(sb_results_spread(&results, "v").value));
    for (int i = 0; i <= SEEDS; i++) sb_figures_free(&runs[i].figures);
}

/* Deep water: 1 - (k a)^2/8; the shift vanishes at k h = 1.07 (depth 0.17 of the length). */
static void test_standing_wave_frequency_shift(void **state)
{
    (void)state;
    assert_near(sb_theory_standing_shift(20, 0.1), 1 - 0.01 / 8, 1e-9);
    assert_near(sb_theory_standing_shift(1.058, 0.1), 1, 2e-5);
    assert_true(sb_theory_standing_shift(0.7, 0.1) > 1.0005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_errors_and_limits),
        cmocka_unit_test(test_band_error_is_from_nearer_edge),
        cmocka_unit_test(test_worst_seed_decides),
        cmocka_unit_test(test_standing_wave_frequency_shift),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
