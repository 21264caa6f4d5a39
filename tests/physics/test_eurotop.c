/* The formulas of EurOtop 2018: values worked out by hand, and how they depend on crest and slope. */
#include "../check.h"
#include "physics/records/eurotop.h"

static const double g = 9.81;

static void values_worked_out_by_hand(void **state)
{
    (void)state;
    /* sqrt(g) = 3.132092. At the still level the exponential is 1. H = 1: 0.047 sqrt(g) = 0.14720832. */
    assert_near(sb_eurotop_vertical(1, 0, g), 0.14720832, 1e-7);
    /* R/H = 1/2.35: exp(-1) = 0.36787944. */
    assert_near(sb_eurotop_vertical(1, 1 / 2.35, g), 0.36787944 * 0.14720832, 1e-7);
    /* R/H = 2/2.35: 2^1.3 = 2.46228883, exp(-2.46228883) = 0.08523962. */
    assert_near(sb_eurotop_vertical(1, 2 / 2.35, g), 0.08523962 * 0.14720832, 1e-7);
    /* A slope of 1:4, T^2 = 2 pi/(0.04 g) for H = 1: steepness 0.04, x = 0.25/0.2 = 1.25; 0.023/0.5 * 1.25 = 0.0575. */
    const double period = sqrt(2 * M_PI / (0.04 * g));
    assert_near(sb_eurotop_slope(1, 0, 0.25, period, g), 0.0575 * 3.132092, 1e-6);
    /* 2.7 R/1.25 = 1. */
    assert_near(sb_eurotop_slope(1, 1.25 / 2.7, 0.25, period, g), 0.0575 * 3.132092 * 0.36787944, 1e-6);
    /* A slope of 1:2, x = 2.5: 0.0813 is below 0.09 at R = 0, but with R/H = 1/1.5 the limit is the smaller one:
       0.09/e, beside 0.08131728 exp(-(1.8/2.5)^1.3) = 0.08131728 * 0.52078006. */
    assert_near(sb_eurotop_slope(1, 1 / 1.5, 0.5, period, g), 0.09 * 0.36787944 * 3.132092, 1e-6);
}

/* Steep slopes begin at the limit of 1:2 and end at the vertical wall. 1:1: a = 0.08, b = 1.92. */
static void steep_slopes_are_between(void **state)
{
    (void)state;
    for (double r = 0; r < 2.5; r += 0.5) {
        const double limit = 0.09 * exp(-pow(1.5 * r, 1.3)) * sqrt(g);
        assert_near(sb_eurotop_slope(1, r, 0.5 + 1e-9, 0, g), limit, 1e-6 * limit);
        assert_near(sb_eurotop_slope(1, r, 1e9, 0, g), sb_eurotop_vertical(1, r, g),
                    3e-3 * sb_eurotop_vertical(1, r, g));
        assert_near(sb_eurotop_slope(1, r, 1, 0, g), 0.08 * exp(-pow(1.92 * r, 1.3)) * sqrt(g), 1e-12);
        for (double s = 0.6; s < 5; s += 0.2)
            assert_true(sb_eurotop_slope(1, r, s + 0.2, 0, g) <= sb_eurotop_slope(1, r, s, 0, g));
    }
}

/* Rates are as sqrt(g H^3) at the same R/H and steepness, and fall with the crest. */
static void scale_and_order(void **state)
{
    (void)state;
    for (double r = 0; r < 3; r += 0.25) {
        assert_near(sb_eurotop_vertical(0.1, 0.1 * r, g), sb_eurotop_vertical(1, r, g) * pow(0.1, 1.5), 1e-15);
        assert_near(sb_eurotop_slope(0.25, 0.25 * r, 0.3, 2, g), sb_eurotop_slope(1, r, 0.3, 4, g) / 8, 1e-15);
        assert_true(sb_eurotop_vertical(1, r + 0.1, g) < sb_eurotop_vertical(1, r, g));
        assert_true(sb_eurotop_slope(1, r + 0.1, 0.3, 6, g) < sb_eurotop_slope(1, r, 0.3, 6, g));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_worked_out_by_hand),
        cmocka_unit_test(steep_slopes_are_between),
        cmocka_unit_test(scale_and_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
