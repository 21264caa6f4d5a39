/* Stokes waves: the equations of the free surface hold with errors that fall with the order, the coefficients are those
   of an independent program, and the limits of the theory. */
#include "../check.h"
#include "physics/waves/regular_wave.h"
#include "physics/waves/steady_wave.h"
#include "physics/waves/stokes.h"

#include <stdio.h>
#include <string.h>

static const double g = 9.81;

/* Largest errors over a wave: of the surface as a streamline, over c; of Bernoulli's equation, over g/k. */
static void residuals(int order, double kd, double steepness, double *kinematic, double *dynamic)
{
    enum { PHASES = 64 };
    const double k = 2.3, length = 2 * M_PI / k, depth = kd / k;
    sb_stokes wave;
    sb_error error = {0};
    if (sb_stokes_create(order, 2 * steepness / k, length, depth, g, &wave, &error) != SB_OK)
        fail_msg("%s", error.text);
    double head[PHASES], mean = 0;
    *kinematic = *dynamic = 0;
    for (int i = 0; i < PHASES; i++) {
        const double x = length * i / PHASES, step = 1e-4 * length;
        const double eta = sb_stokes_elevation(&wave, x);
        const double slope = (8 * (sb_stokes_elevation(&wave, x + step) - sb_stokes_elevation(&wave, x - step)) -
                              sb_stokes_elevation(&wave, x + 2 * step) + sb_stokes_elevation(&wave, x - 2 * step)) /
                             (12 * step);
        double u, w;
        sb_stokes_velocity(&wave, x, depth + eta, &u, &w);
        *kinematic = fmax(*kinematic, fabs(w - slope * (u - wave.celerity)) / wave.celerity);
        head[i] = 0.5 * ((u - wave.celerity) * (u - wave.celerity) + w * w) + g * eta;
        mean += head[i] / PHASES;
    }
    for (int i = 0; i < PHASES; i++) *dynamic = fmax(*dynamic, fabs(head[i] - mean) * k / g);
}

/* Of order n the errors are as the steepness to the power n + 1. */
static void errors_fall_with_the_order(void **state)
{
    (void)state;
    static const double depths[] = {0.7, 1, 1.5, 3, 40};
    static const int orders[] = {2, 3, 4, 5};
    for (size_t d = 0; d < sizeof depths / sizeof *depths; d++)
        for (size_t o = 0; o < sizeof orders / sizeof *orders; o++) {
            double coarse[2], fine[2];
            const double steep = 0.02;
            residuals(orders[o], depths[d], steep, &coarse[0], &coarse[1]);
            residuals(orders[o], depths[d], steep / 2, &fine[0], &fine[1]);
            for (int k = 0; k < 2; k++) {
                const double power = log2(coarse[k] / fine[k]);
                if (o == 3 || d == 1)
                    printf("kd %4.1f, order %d, %s: error %.2e, power %.3f\n", depths[d], orders[o],
                           k ? "pressure" : "streamline", coarse[k], power);
                assert_true(power > orders[o] + 0.8);
            }
        }
}

/* Published output of Fenton's own program for H/d = 0.3, L/d = 8, fifth order without a mean current: elevations E_j k
   and speed over sqrt(g d); and the speed of a Fourier solution with 20 terms. */
static void the_wave_of_fentons_program(void **state)
{
    (void)state;
    static const double e[] = {1.1085623e-1, 2.7030818e-2, 6.3316832e-3, 2.1243859e-3, 6.2180771e-4};
    static const double b[] = {1.3411476e-1, 1.5378594e-2, 1.4247651e-3, 3.5681394e-5, -2.3287527e-5};
    sb_stokes wave;
    assert_int_equal(sb_stokes_create(5, 0.3, 8, 1, g, &wave, NULL), SB_OK);
    const double k = wave.number;
    for (int j = 0; j < 5; j++) {
        assert_near(wave.surface[j] * k, e[j], 1e-8);
        /* Its B_j: u = sqrt(g/k) sum j B_j cosh(j k z)/cosh(j k d) cos(j k x). */
        assert_near(wave.velocity[j] / sqrt(g / k) / (j + 1), b[j], 1e-8);
    }
    assert_near(wave.celerity / sqrt(g), 0.9391, 6e-5);
    assert_near(wave.celerity / sqrt(g), 0.9395, 6e-4);
}

static void limits(void **state)
{
    (void)state;
    sb_stokes wave;
    sb_regular_wave second;
    sb_error error = {0};
    assert_int_equal(sb_stokes_create(5, 0.2, 1, 1, g, &wave, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "breaks"));
    assert_int_equal(sb_stokes_create(5, 0.3, 12, 1, g, &wave, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "too long"));
    assert_int_equal(sb_stokes_create(1, 0.3, 12, 1, g, &wave, &error), SB_OK);
    /* The second order is that of the paddles, apart from their mean current. */
    assert_int_equal(sb_regular_wave_create(SB_WAVE_STOKES2, 0.1, 2, 1, g, &second, NULL), SB_OK);
    assert_int_equal(sb_stokes_create(2, 0.1, second.length, 1, g, &wave, NULL), SB_OK);
    assert_near(wave.surface[1], second.second, 1e-12);
    for (int i = 0; i < 8; i++) {
        sb_wave_motion motion;
        double u, w;
        sb_regular_wave_at(&second, 0.1 * i * wave.length, 0, 0.6, &motion);
        sb_stokes_velocity(&wave, 0.1 * i * wave.length, 0.6, &u, &w);
        assert_near(u, motion.u - second.current, 1e-12);
        assert_near(w, motion.w, 1e-12);
    }
}

/* A wave of a period has the length that gives this period, and that of the steady wave without expansion. */
static void waves_of_a_period(void **state)
{
    (void)state;
    static const double waves[][3] = {{0.12, 1.2, 0.5}, {0.02, 0.6, 5}, {0.1, 3, 0.8}, {1, 8, 10}}; /* H, T, d */
    for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
        const double height = waves[i][0], depth = waves[i][2];
        sb_steady_wave steady;
        sb_stokes wave, again;
        assert_true(sb_steady_wave_of(height, waves[i][1], depth, g, &steady));
        /* of an observer for whom the water below the troughs stands on average */
        const double period = steady.length / (steady.speed - steady.current);
        assert_int_equal(sb_stokes_of_period(5, height, period, depth, g, &wave, NULL), SB_OK);
        printf("H %g m, T %.4g s, d %g m: length %.5g m, steady wave %.5g m\n", height, period, depth, wave.length,
               steady.length);
        assert_near(wave.length, steady.length, 1e-3 * steady.length);
        assert_near(wave.length, period * wave.celerity, 1e-12 * wave.length);
        assert_int_equal(sb_stokes_create(5, height, wave.length, depth, g, &again, NULL), SB_OK);
        assert_memory_equal(&wave, &again, sizeof wave);
        assert_int_equal(sb_stokes_of_period(1, height, period, depth, g, &wave, NULL), SB_OK);
        assert_near(wave.length, period * wave.celerity, 1e-9 * wave.length);
    }
    sb_error error = {0};
    sb_stokes wave;
    assert_int_equal(sb_stokes_of_period(5, 0.3, 1, 1, g, &wave, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "breaks"));
    assert_int_equal(sb_stokes_of_period(5, 0.3, 30, 1, g, &wave, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "too long"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_fall_with_the_order),
        cmocka_unit_test(the_wave_of_fentons_program),
        cmocka_unit_test(limits),
        cmocka_unit_test(waves_of_a_period),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
