/* Tests of the analysis of waves by the validation cases, with signals whose waves are known, and of its theory. */
#include "check.h"

#include "physics/waves/dispersion.h"
#include "physics/waves/steady_wave.h"
#include "theory.h"
#include "wave_fit.h"

static const double g = 9.81;

static void known_harmonics_are_found(void **state)
{
    (void)state;
    sb_curve curve = {0};
    const double period = 1.7, omega = 2 * M_PI / period;
    for (int i = 0; i < 300; i++) {
        const double t = 20 + 0.04 * i;
        const double y = i == 40 ? (double)NAN
                                 : 0.01 + 0.5 * cos(omega * t - 0.7) + 0.1 * cos(2 * omega * t + 1.1) +
                                       0.03 * cos(4 * omega * t - 2);
        sb_curve_add(&curve, t, y);
    }
    /* Six periods and a part of one: the fit needs no whole periods. */
    const sb_wave_fit fit = sb_wave_fit_of(&curve, period, 20.5, 31.3);
    assert_near(fit.amplitude[0], 0.5, 1e-9);
    assert_near(fit.phase[0], 0.7, 1e-9);
    assert_near(fit.amplitude[1], 0.1, 1e-9);
    assert_near(fit.phase[1], -1.1, 1e-9);
    assert_near(fit.amplitude[2], 0, 1e-9);
    assert_near(fit.amplitude[3], 0.03, 1e-9);
    assert_true(isnan(sb_wave_fit_of(&curve, period, 100, 110).amplitude[0]));
    sb_curve_free(&curve);
}

/* A wave with a second crest in its trough has two crossings per period, but one height. */
static void height_is_that_of_a_period(void **state)
{
    (void)state;
    sb_curve curve = {0};
    for (int i = 0; i <= 4000; i++) {
        const double t = 0.002 * i;
        sb_curve_add(&curve, t, cos(M_PI * t) + 0.9 * cos(2 * M_PI * t));
    }
    /* Crest 1.9; trough where sin(s) (1 + 3.6 cos(s)) = 0: cos(s) = -1/3.6. */
    const double c = -1 / 3.6, trough = c + 0.9 * (2 * c * c - 1);
    const sb_wave_range range = sb_wave_fit_range(&curve, 2, 0, 8);
    assert_near(range.crest, 1.9, 1e-5);
    assert_near(range.trough, trough, 1e-5);
    assert_near(sb_wave_fit_height(&curve, 2, 0, 8), 1.9 - trough, 2e-5);
    assert_true(isnan(sb_wave_fit_height(&curve, 2, 0, 1.9)));
    sb_curve_free(&curve);
}

/* In a closed flume the current carries back what linear waves carry forward to second order, g H^2/(8 c d); the wave
   then has its period over the ground. */
static void closed_flume_has_a_return_current(void **state)
{
    (void)state;
    sb_stokes wave;
    double current;
    const double period = 2.3, depth = 1, height = 0.04;
    assert_true(sb_wave_fit_stokes(height, period, depth, g, &wave, &current));
    assert_near(wave.length, (wave.celerity + current) * period, 1e-9);
    assert_near(current, -g * height * height / (8 * wave.celerity * depth), 0.002 * fabs(current));
    /* A wave of no height is that of linear theory. */
    assert_true(sb_wave_fit_stokes(1e-6, period, depth, g, &wave, &current));
    assert_near(wave.length, 2 * M_PI / sb_wave_number(period, depth, g), 1e-6);
    /* Steep waves are longer than linear ones, but less so with the return current. */
    assert_true(sb_wave_fit_stokes(0.25, period, depth, g, &wave, &current));
    assert_in_range((uintmax_t)(wave.length * 1000), 6290, 6380);
    assert_false(sb_wave_fit_stokes(0.8, period, depth, g, &wave, &current)); /* breaks */
    assert_false(sb_wave_fit_stokes((double)NAN, period, depth, g, &wave, &current));
}

/* Force and moment as computed independently by the formulas of MacCamy and Fuchs; a slender cylinder has the force of
   inertia, 2 rho pi a^2 times the acceleration, a quarter of a period before the crest. */
static void cylinder_has_the_load_of_theory(void **state)
{
    (void)state;
    const double k = sb_wave_number(1.2, 0.5, g), chen = sb_wave_number(1.22, 0.505, g);
    const sb_cylinder_load a = sb_theory_cylinder(0.06, k, 0.5, 0.23, 1000, g);
    assert_near(a.force, 79.80, 0.01);
    assert_near(a.moment, 23.12, 0.01);
    assert_near(a.lead * 180 / M_PI, 90 - 16.7, 0.05);
    const sb_cylinder_load c = sb_theory_cylinder(0.07, chen, 0.505, 0.125, 1000, g);
    assert_near(c.force, 31.47, 0.01);
    assert_near(c.moment, 9.17, 0.01);
    const double radius = 1e-3;
    const sb_cylinder_load thin = sb_theory_cylinder(0.06, k, 0.5, radius, 1000, g);
    /* The acceleration's integral over the depth is g H/2 tanh kd. */
    const double inertia = 2 * 1000 * M_PI * radius * radius * g * 0.03 * tanh(k * 0.5);
    assert_near(thin.force, inertia, 1e-4 * inertia);
    assert_near(thin.lead, M_PI / 2, 1e-4);
}

/* Alone: the steady wave, which is exact. With an equal one: the standing wave, whose frequency does not depend on its
   amplitude at kd = 1.058 [Tadjbakhsh and Keller 1960]. In deep water a wave that meets another one is shorter by twice
   what its own height makes it longer [Longuet-Higgins and Phillips 1962]. */
static void waves_that_meet_change_their_length(void **state)
{
    (void)state;
    static const double depths[] = {0.5, 0.7, 1, 1.5, 3};
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        const double k = depths[i], period = 2 * M_PI / sqrt(g * k * tanh(k)), height = 0.01 * pow(fmin(k, 1), 2);
        sb_steady_wave wave;
        assert_true(sb_steady_wave_of(height, period, 1, g, &wave));
        const double change = 2 * M_PI / wave.length / k - 1;
        assert_near(sb_wave_fit_met(k, 0.5 * height, 0, 1) - 1, change, 0.02 * fabs(change));
    }
    const double low = sb_wave_fit_met(1.05, 0.01, 0.01, 1) - 1, high = sb_wave_fit_met(1.065, 0.01, 0.01, 1) - 1;
    assert_true(low < 0 && high > 0);
    const double slope = pow(60 * 0.0005, 2);
    assert_near(sb_wave_fit_met(60, 0.0005, 0, 1) - 1, -slope, 0.05 * slope);
    assert_near(sb_wave_fit_met(60, 0, 0.0005, 1) - 1, 2 * slope, 0.05 * slope);
}

/* A force and a record of it by another clock, 7.3 s ahead: the lag is found, and no other number is fitted. Where the
   record is too short for all lags there is none. */
static void clocks_are_laid_over_each_other(void **state)
{
    (void)state;
    static const double period = 1.22, apart = 7.3;
    sb_curves list = {0};
    sb_curve *own = sb_curve_new(&list), *data = sb_curve_new(&list);
    for (int i = 0; i < 600; i++) {
        const double t = 0.02 * i, phase = 2 * M_PI * t / period;
        sb_curve_add(own, t, t < 5.9 ? 99 : 30 * cos(phase) + 3 * cos(2 * phase));
    }
    for (int i = 0; i < 1000; i++) {
        const double t = 12.1 + 0.0123 * i, phase = 2 * M_PI * (t - apart) / period;
        sb_curve_add(data, t, 30 * cos(phase) + 3 * cos(2 * phase));
    }
    double lag;
    const double least = sb_wave_fit_least(own, data, 5.9, 12.1 + 2 * period - 1, period, &lag);
    assert_near(remainder(lag - apart, period), 0, period / 244);
    assert_true(least < 0.4); /* half a try is 0.08 N per degree */
    assert_true(isnan(sb_wave_fit_least(own, data, 5.9, 0, period, &lag)) && isnan(lag));
    sb_curves_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_harmonics_are_found),           cmocka_unit_test(height_is_that_of_a_period),
        cmocka_unit_test(closed_flume_has_a_return_current),   cmocka_unit_test(cylinder_has_the_load_of_theory),
        cmocka_unit_test(waves_that_meet_change_their_length), cmocka_unit_test(clocks_are_laid_over_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
