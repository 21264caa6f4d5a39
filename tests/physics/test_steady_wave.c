/* Steady waves by a Fourier series: they are those of linear theory, of Stokes' fifth order and of cnoidal theory where
   these are right. */
#include "check.h"
#include "physics/waves/cnoidal.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/steady_wave.h"
#include "physics/waves/stokes.h"

static const double g = 9.81;

static void low_waves_are_linear(void **state)
{
    (void)state;
    for (double period = 0.2; period < 8; period *= 1.6) { /* kd 100 to 0.27 */
        sb_steady_wave wave;
        assert_true(sb_steady_wave_of(1e-5, period, 1, g, &wave));
        assert_near(wave.length, 2 * M_PI / sb_wave_number(period, 1, g), 1e-6 * wave.length);
        assert_near(wave.first, 5e-6, 1e-9);
        assert_near(wave.speed, wave.length / period, 1e-9);
    }
}

/* No water is carried: the current is minus what the wave of theory carries over the depth, g H^2/(8 c d) to second
   order. Fenton's series is right to 1e-4 here. */
static void waves_of_middle_depth_are_stokes_waves(void **state)
{
    (void)state;
    static const double cases[][2] = {{0.04, 2.3}, {0.25, 2.3}, {0.15, 1.5}, {0.1, 1.2}}; /* H, T in m, s; depth 1 m */
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sb_steady_wave wave;
        sb_stokes stokes;
        assert_true(sb_steady_wave_of(cases[i][0], cases[i][1], 1, g, &wave));
        assert_int_equal(sb_stokes_create(5, cases[i][0], wave.length, 1, g, &stokes, NULL), SB_OK);
        assert_near(stokes.celerity + wave.current, wave.speed, 1e-4 * wave.speed);
        const double carried = g * cases[i][0] * cases[i][0] / (8 * wave.speed);
        const double steep = 2 * M_PI * cases[i][0] / wave.length;
        assert_near(wave.current, -carried, steep * steep * carried);
        assert_true(wave.residual < 1e-10);
    }
}

/* The error of cnoidal theory is of second order in H/d. */
static void low_long_waves_are_cnoidal(void **state)
{
    (void)state;
    for (double height = 0.01; height < 0.1; height *= 2) {
        sb_steady_wave wave;
        sb_cnoidal cnoidal;
        assert_true(sb_steady_wave_of(height, 12, 1, g, &wave));
        assert_int_equal(sb_cnoidal_of_period(height, 12, 1, g, &cnoidal, NULL), SB_OK);
        assert_near(wave.length, cnoidal.length, 2 * height * height * wave.length);
    }
}

/* High waves longer than Stokes' are those of cnoidal theory to the first order in H/d. Where the series ends too
   early, none is found rather than a wrong one. */
static void long_high_waves_are_right_or_none(void **state)
{
    (void)state;
    size_t found = 0;
    for (double height = 0.05; height < 0.6; height *= 1.6)
        for (double period = 7; period < 90; period *= 1.25) {
            sb_steady_wave wave;
            sb_cnoidal cnoidal;
            if (!sb_steady_wave_of(height, period, 1, g, &wave)) continue;
            assert_int_equal(sb_cnoidal_of_period(height, period, 1, g, &cnoidal, NULL), SB_OK);
            assert_near(wave.length, cnoidal.length, 0.5 * height * height * wave.length);
            assert_true(wave.first > 0.15 * height);
            found++;
        }
    assert_true(found > 10);
}

/* High waves in shallow water, by an independent program with 50 terms. */
static void high_waves_are_those_of_another_program(void **state)
{
    (void)state;
    static const double cases[][3] = {/* H, T, length in m, s; depth 1 m */
                                      {0.5, 10.097, 36.07},
                                      {0.35, 13.424, 46.66},
                                      {0.63, 2.3, 6.766},
                                      {0.5458, 2.4985, 7.380}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sb_steady_wave wave;
        assert_true(sb_steady_wave_of(cases[i][0], cases[i][1], 1, g, &wave));
        assert_near(wave.length, cases[i][2], 3e-4 * wave.length);
    }
}

static void waves_that_break_are_none(void **state)
{
    (void)state;
    sb_steady_wave wave;
    assert_false(sb_steady_wave_of(0.95, 16.757, 1, g, &wave));
    assert_false(sb_steady_wave_of(0.95, 2.3, 1, g, &wave));
    assert_false(sb_steady_wave_of(0, 2.3, 1, g, &wave));
    assert_false(sb_steady_wave_of((double)NAN, 2.3, 1, g, &wave));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(low_waves_are_linear),
        cmocka_unit_test(waves_of_middle_depth_are_stokes_waves),
        cmocka_unit_test(low_long_waves_are_cnoidal),
        cmocka_unit_test(long_high_waves_are_right_or_none),
        cmocka_unit_test(high_waves_are_those_of_another_program),
        cmocka_unit_test(waves_that_break_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
