/* Third order of a piston's waves: against a tank of nonlinear potential flow, in which low waves show the tank's own
   error. */
#include "check.h"
#include "physics/wavemakers/paddle_second.h"
#include "physics/wavemakers/paddle_third.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/steady_wave.h"
#include "potential_tank.h"

#include <math.h>
#include <stdio.h>

static const double GRAVITY = 9.81;

/* First harmonic in the tank, and that of a steady wave of the height. third: the piston moves for the latter; else for
   H/2. */
static double made(double kd, double height, int third, double *first)
{
    const double omega = sqrt(GRAVITY * kd * tanh(kd)), period = 2 * M_PI / omega;
    sb_steady_wave steady;
    assert_true(sb_steady_wave_of(height, period, 1, GRAVITY, &steady));
    *first = steady.first;
    const double amplitude = third ? sb_paddle_third_amplitude(steady.first, kd, 1, NULL) : 0.5 * height;
    const potential_tank tank = {.depth = 1,
                                 .gravity = GRAVITY,
                                 .period = period,
                                 .stroke = amplitude / sb_piston_height_over_stroke(kd),
                                 .second = sb_paddle_second(2 * amplitude, omega, 1, GRAVITY),
                                 .points = 24,
                                 .lengths = 6,
                                 .periods = 10};
    return potential_tank_run(&tank);
}

static void steep_waves_have_the_first_harmonic_of_steady_waves(void **state)
{
    (void)state;
    const struct {
        double kd, steepness; /* H/L */
    } cases[] = {{0.65, 0.014}, {1, 0.045}, {1.7, 0.06}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double kd = cases[i].kd, height = cases[i].steepness * 2 * M_PI / kd;
        double low, high;
        const double tank = made(kd, 0.1 * height, 0, &low) / (0.05 * height);
        const double plain = made(kd, height, 0, &high) / (0.5 * height) / tank;
        const double share = made(kd, height, 1, &high) / high / tank;
        const double loss = sb_paddle_third_loss(kd) * pow(M_PI * cases[i].steepness, 2);
        printf("kd %g, H/L %g: tank %.4f; for H/2 the linear wave less %.4f, by the table %.4f; of the steady wave "
               "%.4f\n",
               kd, cases[i].steepness, tank, 1 - plain, loss, share);
        assert_near(1 - plain, loss, 0.15 * loss);
        assert_near(share, 1, 0.005);
    }
}

/* Between the values that were found it has no steps, and it ends with a value. */
static void losses_are_continuous(void **state)
{
    (void)state;
    double last = sb_paddle_third_loss(0.05);
    assert_true(last > sb_paddle_third_loss(0.3));
    for (double kd = 0.05; kd < 20; kd *= 1.002) {
        const double loss = sb_paddle_third_loss(kd);
        assert_true(loss > 1.4 && fabs(loss / last - 1) < 0.02);
        last = loss;
    }
    assert_true(last == sb_paddle_third_loss(50));
    /* low waves are linear */
    assert_near(sb_paddle_third_amplitude(1e-5, 1, 1, NULL), 1e-5, 1e-13);
    bool steep;
    assert_true(sb_paddle_third_amplitude(0.2, 1, 1, &steep) < 0.222 && !steep);
    assert_true(sb_paddle_third_amplitude(0.3, 1, 1, &steep) < 0.365 && steep);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steep_waves_have_the_first_harmonic_of_steady_waves),
        cmocka_unit_test(losses_are_continuous),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
