/* Tests of the operations on curves. */
#include "check.h"

#include "curve.h"

static sb_curve made_of(size_t count, double step, double (*f)(double))
{
    sb_curve curve = {0};
    for (size_t i = 0; i < count; i++) {
        double x = (double)i * step;
        sb_curve_add(&curve, x, f(x));
    }
    return curve;
}

static double straight(double x)
{
    return 3 - 2 * x;
}

static double hill(double x)
{
    return 5 - 4 * (x - 0.537) * (x - 0.537);
}

static double wave(double x)
{
    return sin(2 * M_PI * x);
}

static void test_interpolation_is_exact_on_a_line_and_nan_outside(void **state)
{
    (void)state;
    sb_curve c = made_of(11, 0.1, straight);
    for (double x = 0; x <= 1; x += 0.013) assert_near(sb_curve_at(&c, x), straight(x), 1e-12);
    assert_near(sb_curve_at(&c, c.x[10]), c.y[10], 0);
    assert_true(isnan(sb_curve_at(&c, -1e-9)));
    assert_true(isnan(sb_curve_at(&c, 1.0001)));
    c.y[4] = (double)NAN;
    assert_true(isnan(sb_curve_at(&c, 0.35)));
    sb_curve_free(&c);
}

static void test_resampling_keeps_both_ends(void **state)
{
    (void)state;
    sb_curve c = made_of(11, 0.1, straight);
    sb_curves made = {0};
    const sb_curve *r = sb_curve_resample(&made, &c, 0.2, 0.8, 0.05);
    assert_int_equal(r->count, 13);
    assert_near(sb_curve_x(r, 12), 0.8, 1e-12);
    assert_near(sb_curve_last(r), straight(0.8), 1e-12);
    assert_near(sb_curve_first(r), straight(0.2), 1e-12);
    assert_true(isnan(sb_curve_y(r, 13)));
    sb_curve_free(&c);
    assert_true(sb_curves_free(&made));
}

static void test_sort_is_stable(void **state)
{
    (void)state;
    static const double xs[] = {2, 1, 2, 0, 1};
    sb_curve c = {0};
    for (int i = 0; i < 5; i++) sb_curve_add(&c, xs[i], i);
    sb_curve_sort(&c);
    static const double order[] = {3, 1, 4, 0, 2};
    for (int i = 0; i < 5; i++) assert_near(c.y[i], order[i], 0);
    sb_curve_free(&c);
}

static void test_filters_match_brute_force(void **state)
{
    (void)state;
    sb_curve c = made_of(200, 0.01, wave);
    sb_curves made = {0};
    for (size_t i = 0; i < c.count; i += 7) c.y[i] += i % 2 ? 3 : -2;
    c.y[50] = (double)NAN;
    const double window = 0.1;
    const sb_curve *mean = sb_curve_mean_filter(&made, &c, window), *median = sb_curve_median_filter(&made, &c, window);
    for (size_t i = 0; i < c.count; i++) {
        double sum = 0, below = 0, above = 0, count = 0;
        if (i == 50) {
            assert_true(isnan(mean->y[i]) && isnan(median->y[i]));
            continue;
        }
        for (size_t k = 0; k < c.count; k++) {
            if (isnan(c.y[k]) || fabs(c.x[k] - c.x[i]) > 0.5 * window + 1e-9) continue;
            sum += c.y[k];
            count++;
            below += c.y[k] < median->y[i];
            above += c.y[k] > median->y[i];
        }
        assert_near(mean->y[i], sum / count, 1e-12);
        assert_true(below <= count / 2 && above <= count / 2);
    }
    sb_curve_free(&c);
    assert_true(sb_curves_free(&made));
}

static void test_impulse_is_the_trapezoid_with_interpolated_ends(void **state)
{
    (void)state;
    sb_curve line = made_of(11, 0.1, straight), fine = made_of(2001, 0.001, wave);
    assert_near(sb_curve_integral(&line, 0.13, 0.77), 3 * 0.64 - (0.77 * 0.77 - 0.13 * 0.13), 1e-12);
    /* the rule is too low by step^2/12 times the change of slope, 1.05e-6 */
    assert_near(sb_curve_integral(&fine, 0, 0.5), 1 / M_PI, 1.1e-6);
    assert_near(sb_curve_integral(&fine, 0.25, 1.25), 0, 1e-9);
    assert_true(isnan(sb_curve_integral(&line, -0.1, 0.5)));
    sb_curve_free(&line);
    sb_curve_free(&fine);
}

static void test_moments(void **state)
{
    (void)state;
    sb_curve c = made_of(1000, 0.001, wave), shifted = {0};
    assert_near(sb_curve_mean(&c, 0, 0.9995), 0, 1e-12);
    assert_near(sb_curve_rms(&c, 0, 0.9995), sqrt(0.5), 1e-12);
    sb_curve_sum(&shifted, &c);
    sb_curve_map(&shifted, 1, 0, 2, 7);
    assert_near(sb_curve_deviation(&shifted, 0, 1), 2 * sqrt(0.5), 1e-12);
    sb_curve_map(&shifted, 1, 0, 0.5, -3.5 + 0.25);
    assert_near(sb_curve_rms_difference(&shifted, &c, 0, 1), 0.25, 1e-12);
    assert_true(isnan(sb_curve_mean(&c, 5, 6)));
    sb_curve_free(&c);
    sb_curve_free(&shifted);
}

static void test_sum_takes_the_first_curve_and_adds_others(void **state)
{
    (void)state;
    sb_curve sum = {0}, c = made_of(11, 0.1, straight), shorter = made_of(3, 0.1, wave);
    sb_curve_sum(&sum, &c);
    sb_curve_sum(&sum, &shorter);
    assert_int_equal(sum.count, 11);
    assert_near(sum.y[2], straight(0.2) + wave(0.2), 1e-12);
    assert_near(sum.y[3], straight(0.3), 1e-12);
    assert_true(isnan(sb_curve_first(&(sb_curve){0})) && isnan(sb_curve_last(&(sb_curve){0})));
    sb_curve_free(&sum);
    sb_curve_free(&c);
    sb_curve_free(&shorter);
}

static void test_peak_of_a_parabola_is_exact_between_points(void **state)
{
    (void)state;
    sb_curve c = made_of(21, 0.05, hill);
    sb_peak peak = sb_curve_peak(&c, 0, 1, 0.2);
    assert_near(peak.x, 0.537, 1e-9);
    assert_near(peak.y, 5, 1e-9);
    peak = sb_curve_peak(&c, 0, 0.32, 0.2); /* on a slope the parabola's top is far off */
    assert_near(peak.x, 0.3, 1e-12);
    sb_curve_map(&c, 1, 0, -1, 0); /* opens upwards */
    peak = sb_curve_peak(&c, 0.38, 0.72, 0.1);
    assert_near(peak.y, -hill(0.7), 1e-12);
    peak = sb_curve_peak(&c, 3, 4, 0.1);
    assert_true(isnan(peak.x) && isnan(peak.y));
    assert_int_equal(sb_curve_lowest(&c, 0, 1), 11);
    sb_curve_free(&c);
}

static void test_onset_is_between_points_and_after_the_start(void **state)
{
    (void)state;
    sb_curve c = made_of(200, 0.01, wave);
    assert_near(sb_curve_onset(&c, 0.5, 0), 1.0 / 12, 1e-4);
    assert_near(sb_curve_onset(&c, 0.5, 0.5), 13.0 / 12, 1e-4);
    assert_true(isnan(sb_curve_onset(&c, 1.5, 0)));
    sb_curve_free(&c);
}

static void test_line_through_points(void **state)
{
    (void)state;
    sb_curve c = made_of(11, 0.1, straight);
    double a, b;
    c.y[3] = (double)NAN;
    assert_true(sb_curve_line(&c, 0, 1, &a, &b));
    assert_near(a, 3, 1e-12);
    assert_near(b, -2, 1e-12);
    assert_false(sb_curve_line(&c, 0.05, 0.15, &a, &b));
    sb_curve_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_interpolation_is_exact_on_a_line_and_nan_outside),
        cmocka_unit_test(test_resampling_keeps_both_ends),
        cmocka_unit_test(test_sort_is_stable),
        cmocka_unit_test(test_filters_match_brute_force),
        cmocka_unit_test(test_impulse_is_the_trapezoid_with_interpolated_ends),
        cmocka_unit_test(test_moments),
        cmocka_unit_test(test_sum_takes_the_first_curve_and_adds_others),
        cmocka_unit_test(test_peak_of_a_parabola_is_exact_between_points),
        cmocka_unit_test(test_onset_is_between_points_and_after_the_start),
        cmocka_unit_test(test_line_through_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
