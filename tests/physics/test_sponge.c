/* Reflection by sponges: known figures of long waves, and a field solved in time. */
#include "../check.h"
#include "physics/absorption/sponge.h"
#include "physics/waves/dispersion.h"

static const double GRAVITY = 9.81;

static void profiles_run_from_nothing_to_all(void **state)
{
    (void)state;
    for (int p = SB_SPONGE_LINEAR; p <= SB_SPONGE_CUBIC; p++) {
        assert_true(sb_sponge_share(p, -0.3) == 0 && sb_sponge_share(p, 0) == 0);
        assert_true(sb_sponge_share(p, 1) == 1 && sb_sponge_share(p, 2) == 1);
        assert_near(sb_sponge_share(p, 0.5), pow(0.5, p + 1), 1e-15);
    }
}

/* Long waves, quadratic strength, a wall behind: figures computed with another program. */
static void long_waves_reflect_as_known(void **state)
{
    (void)state;
    const struct {
        double lengths, strength, reflection, within;
    } cases[] = {
        {0.5, 2.6, 0.037, 6e-4}, {1, 2.6, 0.017, 6e-4}, {1.46, 2.4, 0.0009, 6e-5}, {2, 1.8, 0.0004, 6e-5},
        {0.5, 4.5, 0.165, 6e-4}, {1, 4.5, 0.050, 6e-4}, {1.46, 4.5, 0.0105, 6e-5}, {2, 4.5, 0.0022, 6e-5},
    };
    const double depth = 0.1, period = 40, omega = 2 * M_PI / period;
    const double length = 2 * M_PI / sb_wave_number(period, depth, GRAVITY);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_near(sb_sponge_reflection(SB_SPONGE_QUADRATIC, cases[i].strength * omega, omega, depth, GRAVITY,
                                         cases[i].lengths * length),
                    cases[i].reflection, cases[i].within);
}

static void no_strength_is_a_wall(void **state)
{
    (void)state;
    for (double period = 0.5; period < 5; period *= 1.7)
        assert_near(sb_sponge_reflection(SB_SPONGE_LINEAR, 0, 2 * M_PI / period, 0.5, GRAVITY, 3), 1, 1e-9);
}

/* Water that stands still is a wall. A cubic of 1000 slices begins softly, which takes up to 2 %. */
static void endless_strength_is_a_wall(void **state)
{
    (void)state;
    for (int p = SB_SPONGE_LINEAR; p <= SB_SPONGE_CUBIC; p++)
        for (double period = 0.7; period < 8; period *= 1.8)
            for (double strength = 1e9; strength < 2e12; strength *= 10)
                assert_near(sb_sponge_reflection(p, strength, 2 * M_PI / period, 1, GRAVITY, 5), 1, 0.02);
}

/* Deep water: constant strength over half a wavelength lets exp(-2 Im(k) l) return, k = omega^2/g (1 + i s/omega),
   apart from what the front reflects. A cubic of little strength has no front and the mean of a quarter. */
static void deep_waves_decay_by_their_wave_number(void **state)
{
    (void)state;
    const double omega = 5, depth = 3, number = omega * omega / GRAVITY, length = 4 * 2 * M_PI / number;
    for (double strength = 0.05; strength < 0.5; strength *= 2) {
        const double expected = exp(-2 * number * strength / omega * length / 4);
        assert_near(sb_sponge_reflection(SB_SPONGE_CUBIC, strength, omega, depth, GRAVITY, length), expected,
                    0.01 * expected);
    }
}

/* Linear long waves in time on a staggered grid, with a wall behind the zone: the reflection from greatest and least
   amplitude before it. */
static double reflection_in_time(double strength, double omega, double depth, double zone)
{
    enum { CELLS = 2400 };
    static double eta[CELLS], u[CELLS + 1];
    const double speed = sqrt(GRAVITY * depth), wave = 2 * M_PI * speed / omega;
    const double dx = (3 * wave + zone) / CELLS, dt = 0.5 * dx / speed, front = 3 * wave;
    double least = INFINITY, most = 0;
    static double high[CELLS];
    for (int i = 0; i < CELLS; i++) eta[i] = u[i] = high[i] = 0;
    u[CELLS] = 0;
    const int steps = (int)(16 * 2 * M_PI / omega / dt), last = (int)(14 * 2 * M_PI / omega / dt);
    for (int s = 0; s < steps; s++) {
        /* In at the left: u = 2 c eta_in/d - c eta/d lets the reflected wave out. */
        const double in = fmin(s * dt * omega / 12, 1) * sin(omega * s * dt);
        u[0] = speed / depth * (2 * in - eta[0]);
        for (int i = 1; i < CELLS; i++) {
            const double g = strength * sb_sponge_share(SB_SPONGE_QUADRATIC, (i * dx - front) / zone) * dt / 2;
            u[i] = ((1 - g) * u[i] - GRAVITY * dt / dx * (eta[i] - eta[i - 1])) / (1 + g);
        }
        for (int i = 0; i < CELLS; i++) eta[i] -= depth * dt / dx * (u[i + 1] - u[i]);
        for (int i = 0; i < CELLS && s > last; i++) high[i] = fmax(high[i], fabs(eta[i]));
    }
    for (int i = 0; i * dx < 2 * wave; i++) {
        if (i * dx < wave) continue;
        least = fmin(least, high[i]);
        most = fmax(most, high[i]);
    }
    return (most - least) / (most + least);
}

static void prediction_is_that_of_waves_in_time(void **state)
{
    (void)state;
    const double depth = 0.1, omega = 2 * M_PI / 40, wave = 2 * M_PI / sb_wave_number(40, depth, GRAVITY);
    const double strengths[] = {0.8, 2.6, 6};
    for (int i = 0; i < 3; i++) {
        const double s = strengths[i] * omega, zone = 0.6 * wave;
        const double predicted = sb_sponge_reflection(SB_SPONGE_QUADRATIC, s, omega, depth, GRAVITY, zone);
        assert_near(reflection_in_time(s, omega, depth, zone), predicted, 0.006);
    }
}

static void best_strength_has_no_better_neighbour(void **state)
{
    (void)state;
    for (double lengths = 0.5; lengths < 2; lengths += 0.5)
        for (int p = SB_SPONGE_LINEAR; p <= SB_SPONGE_CUBIC; p++) {
            const double omega = 2.732, depth = 1, zone = lengths * 6.29;
            const double best = sb_sponge_best(p, omega, depth, GRAVITY, zone);
            const double least = sb_sponge_reflection(p, best, omega, depth, GRAVITY, zone);
            for (double s = 0.1 * omega; s < 15 * omega; s *= 1.3)
                assert_true(sb_sponge_reflection(p, s, omega, depth, GRAVITY, zone) >= least);
        }
}

/* The loss on the way, summed in small parts with a group speed by finite differences of the dispersion relation. */
static void viscosity_takes_its_share_per_second(void **state)
{
    (void)state;
    for (int p = SB_SPONGE_LINEAR; p <= SB_SPONGE_CUBIC; p++)
        for (double depth = 0.1; depth < 10; depth *= 3) {
            enum { PARTS = 2000 };
            const double omega = 2.732, length = 7, viscosity = 0.02,
                         k = sb_wave_number(2 * M_PI / omega, depth, GRAVITY);
            const double step = 1e-5 * k, above = sqrt(GRAVITY * (k + step) * tanh((k + step) * depth)),
                         below = sqrt(GRAVITY * (k - step) * tanh((k - step) * depth));
            const double group = (above - below) / (2 * step);
            double left = 1;
            for (int i = 0; i < 2 * PARTS; i++) {
                const int at = i < PARTS ? i : 2 * PARTS - 1 - i;
                const double here = viscosity * sb_sponge_share(p, (at + 0.5) / PARTS);
                left *= exp(-2 * here * k * k * length / PARTS / group);
            }
            assert_near(sb_sponge_viscous_reflection(p, viscosity, omega, depth, GRAVITY, length), left, 1e-6);
        }
    /* The basin of Wen et al.: alpha 0.6, h 0.06 m, 10 sqrt(g d) of 0.5 m. */
    assert_near(sb_sponge_viscosity(0.6, 0.06, 22.147, 3), 0.03986, 1e-5);
    assert_near(sb_sponge_viscous_reflection(SB_SPONGE_QUADRATIC, 0, 2, 1, GRAVITY, 3), 1, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(profiles_run_from_nothing_to_all),
        cmocka_unit_test(long_waves_reflect_as_known),
        cmocka_unit_test(no_strength_is_a_wall),
        cmocka_unit_test(endless_strength_is_a_wall),
        cmocka_unit_test(deep_waves_decay_by_their_wave_number),
        cmocka_unit_test(prediction_is_that_of_waves_in_time),
        cmocka_unit_test(best_strength_has_no_better_neighbour),
        cmocka_unit_test(viscosity_takes_its_share_per_second),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
