/* Tests of the order of convergence. */
#include "check.h"

#include "order.h"

#include <string.h>

enum { LEVELS = 3 };

/* value = limit + c h^p at these spacings. */
static void fill(sb_level *levels, const double *spacings, size_t count, double limit, double c, double p)
{
    for (size_t i = 0; i < count; i++)
        levels[i] = (sb_level){spacings[i], limit + c * pow(spacings[i], p), (double)NAN};
}

static void test_exact_orders_are_found_at_unequal_ratios(void **state)
{
    (void)state;
    static const double spacings[LEVELS] = {5, 3, 2}, orders[] = {0.55, 0.8, 1, 1.7, 2};
    for (size_t k = 0; k < sizeof orders / sizeof *orders; k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            sb_level l[LEVELS];
            fill(l, spacings, LEVELS, 7, sign * 0.4, orders[k]);
            sb_convergence c = sb_converge(l, LEVELS);
            assert_int_equal(c.kind, SB_ORDER_OBSERVED);
            assert_near(c.order, orders[k], 1e-9);
            assert_near(c.extrapolated, 7, 1e-8);
            assert_near(c.uncertainty, 1.25 * 0.4 * pow(2, orders[k]), 1e-8);
        }
}

static void test_three_finest_measured_spacings_count(void **state)
{
    (void)state;
    static const double spacings[5] = {16, 8, 4, 2, 1};
    sb_level l[5];
    fill(l, spacings, 5, 1, 3, 1);
    l[0].value = 1e6;
    l[3].value = (double)NAN; /* 8, 4, 1 remain */
    sb_convergence c = sb_converge(l, 5);
    assert_int_equal(c.kind, SB_ORDER_OBSERVED);
    assert_near(c.order, 1, 1e-9);
    assert_near(c.extrapolated, 1, 1e-8);
}

/* An order of 5 by chance must not make the error bar vanish. */
static void test_error_bar_limits_order_to_two(void **state)
{
    (void)state;
    static const double spacings[LEVELS] = {4, 2, 1};
    sb_level l[LEVELS];
    fill(l, spacings, LEVELS, 0, 1, 5);
    sb_convergence c = sb_converge(l, LEVELS);
    assert_near(c.order, 5, 1e-9);
    assert_near(c.uncertainty, 1.25 * 992 / 4 / 3,
                1e-9); /* second order: a quarter of the coarse difference, a third */
    /* Nor an order above the largest. */
    const sb_level chance[LEVELS] = {{4, 100, (double)NAN}, {2, 50, (double)NAN}, {1, 49.99, (double)NAN}};
    assert_near(sb_converge(chance, LEVELS).uncertainty, 1.25 * 50 / 4 / 3, 1e-9);
}

static void test_order_near_zero_gives_no_extrapolation(void **state)
{
    (void)state;
    static const double spacings[LEVELS] = {4, 2, 1};
    sb_level l[LEVELS];
    fill(l, spacings, LEVELS, 0, 1, 0.3);
    sb_convergence c = sb_converge(l, LEVELS);
    assert_int_equal(c.kind, SB_ORDER_SLOW);
    assert_true(isnan(c.extrapolated));
    assert_true(c.uncertainty >= 3 * (pow(4, 0.3) - 1) && c.uncertainty >= 1); /* the limit is within */
}

static void test_spacing_with_one_seed_gets_scatter_of_others(void **state)
{
    (void)state;
    const sb_level all[LEVELS] = {{4, 9, 0.5}, {2, 5, 0.5}, {1, 3, 0.5}};
    sb_level one[LEVELS] = {{4, 9, 0.5}, {2, 5, 0.25}, {1, 3, (double)NAN}};
    assert_near(sb_converge(one, LEVELS).uncertainty, sb_converge(all, LEVELS).uncertainty, 1e-12);
}

static sb_convergence of_values(double a, double b, double c, double error)
{
    const sb_level l[LEVELS] = {{4, a, error}, {2, b, error}, {1, c, error}};
    return sb_converge(l, LEVELS);
}

static void test_unobservable_orders_are_classified(void **state)
{
    (void)state;
    assert_int_equal(of_values(1, 2, 1.5, (double)NAN).kind, SB_ORDER_OSCILLATING);
    assert_int_equal(of_values(1, 2, 4, (double)NAN).kind, SB_ORDER_DIVERGING);
    assert_int_equal(of_values(1, 2, 3, (double)NAN).kind, SB_ORDER_DIVERGING);
    assert_int_equal(of_values(1, 2, 2.5, 0.3).kind, SB_ORDER_NOISE);
    assert_int_equal(of_values(1, 2, 2.5, 0.1).kind, SB_ORDER_OBSERVED);
    assert_int_equal(of_values(3, 3, 3, (double)NAN).kind, SB_ORDER_NOISE);
    assert_near(of_values(1, 2, 4, (double)NAN).uncertainty, 9, 1e-12);
    assert_near(of_values(1, 2, 2.5, 0.3).uncertainty, 2.1, 1e-12);
    assert_true(isnan(of_values(1, 2, 1.5, (double)NAN).order));
    assert_true(isnan(of_values(1, 2, 1.5, (double)NAN).extrapolated));
    for (int kind = SB_ORDER_ASSUMED; kind <= SB_ORDER_MISSING; kind++)
        assert_true(strlen(sb_order_remark((sb_order_kind)kind)) > 0);
}

static void test_two_spacings_assume_first_order(void **state)
{
    (void)state;
    const sb_level l[2] = {{3, 10, (double)NAN}, {2, 9, (double)NAN}};
    sb_convergence c = sb_converge(l, 2);
    assert_int_equal(c.kind, SB_ORDER_ASSUMED);
    assert_near(c.uncertainty, 6, 1e-12); /* limit 7 by first order, three times the distance */
    assert_true(isnan(c.extrapolated));
    c = sb_converge(l, 1);
    assert_int_equal(c.kind, SB_ORDER_MISSING);
    assert_true(isnan(c.uncertainty));
}

static void test_scatter_widens_the_error_bar(void **state)
{
    (void)state;
    double without = of_values(9, 5, 3, (double)NAN).uncertainty;
    assert_near(of_values(9, 5, 3, 0.5).uncertainty, sqrt(without * without + 0.25), 1e-12);
}

static void test_range_covers_all_combinations_of_seeds(void **state)
{
    (void)state;
    static const double spacings[3] = {4, 2, 1};
    static const double a[] = {9}, b[] = {5, 6}, c[] = {3, 4.9};
    const double *const values[3] = {a, b, c};
    static const size_t seeds[3] = {1, 2, 2};
    /* Ratios 4/2, 4/0.1, 3/3, 3/1.1; the third has no order. */
    sb_order_range r = sb_order_over_seeds(spacings, values, seeds);
    assert_near(r.low, 1, 1e-9);
    assert_near(r.high, log2(40), 1e-6);
    assert_near(r.share, 0.75, 1e-12);
    /* A failed seed is not part of any combination. */
    static const double lost[] = {(double)NAN, 4.9};
    const double *const without[3] = {a, b, lost};
    r = sb_order_over_seeds(spacings, without, seeds);
    assert_near(r.share, 1, 1e-12);
    static const double none[] = {(double)NAN, (double)NAN};
    const double *const nothing[3] = {a, b, none};
    assert_true(isnan(sb_order_over_seeds(spacings, nothing, seeds).share));
}

static void test_mean_and_standard_error_ignore_nan(void **state)
{
    (void)state;
    static const double values[] = {1, (double)NAN, 3, 5};
    double mean, error;
    sb_mean_of(values, 4, &mean, &error);
    assert_near(mean, 3, 1e-12);
    assert_near(error, 2 / sqrt(3), 1e-12);
    sb_mean_of(values, 2, &mean, &error);
    assert_near(mean, 1, 1e-12);
    assert_true(isnan(error));
    sb_mean_of(values + 1, 1, &mean, &error);
    assert_true(isnan(mean));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact_orders_are_found_at_unequal_ratios),
        cmocka_unit_test(test_three_finest_measured_spacings_count),
        cmocka_unit_test(test_error_bar_limits_order_to_two),
        cmocka_unit_test(test_order_near_zero_gives_no_extrapolation),
        cmocka_unit_test(test_spacing_with_one_seed_gets_scatter_of_others),
        cmocka_unit_test(test_unobservable_orders_are_classified),
        cmocka_unit_test(test_two_spacings_assume_first_order),
        cmocka_unit_test(test_scatter_widens_the_error_bar),
        cmocka_unit_test(test_range_covers_all_combinations_of_seeds),
        cmocka_unit_test(test_mean_and_standard_error_ignore_nan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
