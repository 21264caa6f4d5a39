/* Synthetic signals of gauges in a line: known incident and reflected waves are found again. */
#include "../check.h"
#include "base/random.h"
#include "physics/records/reflection.h"
#include "physics/waves/dispersion.h"

enum { GAUGES = 5, HARMONICS = 3 };

static const double period = 2.2, depth = 0.8;
static const double places[GAUGES] = {3, 3.31, 3.83, 4.2, 4.9};

/* Amplitudes and phases of what the signal consists of. */
typedef struct signal {
    double incident, reflected, phase, lag;
    double second, second_reflected; /* free second harmonic */
    double noise, level;
} signal;

static double surface(const signal *s, size_t gauge, int sample, double t)
{
    const double w = 2 * M_PI / period, k = sb_wave_number(period, depth, 9.81),
                 k2 = sb_wave_number(period / 2, depth, 9.81);
    const double x = places[gauge], noise = sb_random(7 + gauge, (uint64_t)sample) - 0.5;
    return s->level + s->incident * cos(k * x - w * t + s->phase) + s->reflected * cos(k * x + w * t + s->lag) +
           s->second * cos(k2 * x - 2 * w * t) + s->second_reflected * cos(k2 * x + 2 * w * t + 1) + s->noise * noise;
}

/* The splits of all harmonics from the first `gauges` gauges, sampled every 0.05 s for `time` s. */
static void split(const signal *s, size_t gauges, double time, sb_split out[HARMONICS])
{
    double a[GAUGES][HARMONICS], b[GAUGES][HARMONICS], scratch[64] = {0};
    assert_true(sb_harmonics_size(HARMONICS) <= 64);
    for (size_t g = 0; g < gauges; g++) {
        double sums[64] = {0};
        for (int i = 0; i * 0.05 < time; i++) {
            const double t = 100 + i * 0.05;
            sb_harmonics_add(sums, HARMONICS, 2 * M_PI / period, t, surface(s, g, i, t));
        }
        assert_true(sb_harmonics_solve(sums, HARMONICS, scratch, a[g], b[g]));
    }
    for (int h = 0; h < HARMONICS; h++) {
        double cosines[GAUGES], sines[GAUGES];
        for (size_t g = 0; g < gauges; g++) {
            cosines[g] = a[g][h];
            sines[g] = b[g][h];
        }
        out[h] = sb_split_of(places, cosines, sines, gauges, sb_wave_number(period / (h + 1), depth, 9.81));
    }
}

static void known_waves_are_found(void **state)
{
    (void)state;
    sb_split out[HARMONICS];
    for (double ratio = 0; ratio <= 1; ratio += 0.25)
        for (size_t gauges = 3; gauges <= GAUGES; gauges++) {
            /* Neither whole periods nor a level of 0 are needed. */
            const signal s = {.incident = 0.05,
                              .reflected = 0.05 * ratio,
                              .phase = 0.3,
                              .lag = 2,
                              .second = 0.008,
                              .second_reflected = 0.003,
                              .level = 7};
            split(&s, gauges, 9.7, out);
            assert_near(out[0].incident, 0.05, 1e-12);
            assert_near(out[0].reflected, 0.05 * ratio, 1e-12);
            assert_near(out[1].incident, 0.008, 1e-12);
            assert_near(out[1].reflected, 0.003, 1e-12);
            assert_near(out[2].incident, 0, 1e-12);
            assert_near(out[0].misfit, 0, 1e-12);
        }
}

/* White noise of standard deviation s over N samples gives each amplitude of a gauge an error of s sqrt(2/N); the split
   divides it by sqrt(N s(2 - s)), s the separation. */
static void noise_averages_out(void **state)
{
    (void)state;
    sb_split out[HARMONICS];
    const signal s = {.incident = 0.05, .reflected = 0.02, .noise = 0.02};
    split(&s, GAUGES, 44, out);
    const double deviation = 0.02 / sqrt(12), separation = out[0].separation,
                 one = deviation * sqrt(2 / 880.0 / GAUGES / (separation * (2 - separation)));
    assert_near(out[0].incident, 0.05, 3 * one);
    assert_near(out[0].reflected, 0.02, 3 * one);
    assert_true(fabs(out[0].reflected - 0.02) > 1e-6 && out[0].misfit > 0.1 * one && out[0].misfit < 5 * one);
}

/* A second harmonic that is bound to the first has twice its wave number: it does not disturb the first, and the free
   split of the second shows it as misfit. */
static void bound_harmonics_show_as_misfit(void **state)
{
    (void)state;
    const double k = sb_wave_number(period, depth, 9.81);
    double cosines[GAUGES], sines[GAUGES];
    for (size_t g = 0; g < GAUGES; g++) {
        cosines[g] = 0.01 * cos(2 * k * places[g]);
        sines[g] = 0.01 * sin(2 * k * places[g]);
    }
    const sb_split bound = sb_split_of(places, cosines, sines, GAUGES, 2 * k);
    assert_near(bound.incident, 0.01, 1e-12);
    assert_near(bound.reflected, 0, 1e-12);
    const sb_split as_free = sb_split_of(places, cosines, sines, GAUGES, sb_wave_number(period / 2, depth, 9.81));
    assert_true(as_free.misfit > 1e-4);
}

/* Amplitudes of free and bound waves, incident and reflected, at phases of their own, by the surface itself. */
static void four_waves(const double *x, size_t count, double free, double bound, const double amplitude[4],
                       double *cosines, double *sines)
{
    for (size_t g = 0; g < count; g++) {
        cosines[g] = sines[g] = 0;
        for (int m = 0; m < 4; m++) {
            const double k = m < 2 ? free : bound, phase = k * x[g] + 0.4 + 1.1 * m;
            cosines[g] += amplitude[m] * cos(phase); /* a cos(kx - wt + p) = a cos(kx + p) cos wt + ... */
            sines[g] += amplitude[m] * (m % 2 ? -sin(phase) : sin(phase));
        }
    }
}

/* Four and five gauges find free and bound waves of half the period, whatever their ratio. */
static void free_and_bound_waves_are_told_apart(void **state)
{
    (void)state;
    const double free = sb_wave_number(period / 2, depth, 9.81), bound = 2 * sb_wave_number(period, depth, 9.81);
    const double cases[][4] = {{0.008, 0.003, 0.01, 0.002}, {0, 0, 0.01, 0}, {0.01, 0, 0, 0}, {0.001, 0.004, 0, 0.02}};
    for (size_t c = 0; c < 4; c++)
        for (size_t gauges = 4; gauges <= GAUGES; gauges++) {
            double cosines[GAUGES], sines[GAUGES];
            four_waves(places, gauges, free, bound, cases[c], cosines, sines);
            const sb_split out = sb_split_bound_of(places, cosines, sines, gauges, free, bound);
            assert_near(out.incident, cases[c][0], 1e-12);
            assert_near(out.reflected, cases[c][1], 1e-12);
            assert_near(out.bound_incident, cases[c][2], 1e-12);
            assert_near(out.bound_reflected, cases[c][3], 1e-12);
            assert_near(out.misfit, 0, 1e-12);
        }
}

/* The separation bounds what errors of the gauges do: over all directions of an error of length e the worst amplitude
   has e/sqrt(count s), which the singular vector attains. Three places, and waves of one speed, have none. */
static void separation_of_four_waves_bounds_errors(void **state)
{
    (void)state;
    const double free = sb_wave_number(period / 2, depth, 9.81), bound = 2 * sb_wave_number(period, depth, 9.81);
    const double separation = sb_split_bound_separation(places, GAUGES, free, bound);
    double worst = 0;
    assert_true(separation > 0 && separation < 1);
    for (uint64_t n = 0; n < 20000; n++) {
        double cosines[GAUGES], sines[GAUGES], square = 0;
        for (size_t g = 0; g < GAUGES; g++) {
            cosines[g] = sb_random(3, 2 * (GAUGES * n + g)) - 0.5;
            sines[g] = sb_random(3, 2 * (GAUGES * n + g) + 1) - 0.5;
            square += cosines[g] * cosines[g] + sines[g] * sines[g];
        }
        const sb_split out = sb_split_bound_of(places, cosines, sines, GAUGES, free, bound);
        const double all = out.incident * out.incident + out.reflected * out.reflected +
                           out.bound_incident * out.bound_incident + out.bound_reflected * out.bound_reflected;
        worst = fmax(worst, sqrt(all / square));
    }
    const double limit = 1 / sqrt(GAUGES * separation);
    assert_true(worst <= limit * (1 + 1e-9) && worst > 0.9 * limit);
    assert_near(sb_split_bound_separation(places, 3, free, bound), 0, 1e-9);
    assert_near(sb_split_bound_separation(places, GAUGES, free, free), 0, 1e-9);
    const double zeros[GAUGES] = {0};
    assert_true(isnan(sb_split_bound_of(places, zeros, zeros, 3, free, bound).bound_incident));
    assert_true(isnan(sb_split_bound_of(places, zeros, zeros, GAUGES, free, free).incident));
}

static void singular_places_are_detected(void **state)
{
    (void)state;
    const double half[] = {1, 1.5, 2.5}, some[] = {1, 1.5, 2.1}, two[] = {0, 0.05}, k = 2 * M_PI;
    const double cosines[] = {1, -1, -1}, sines[3] = {0};
    assert_near(sb_split_separation(half, 3, k), 0, 1e-12);
    const sb_split none = sb_split_of(half, cosines, sines, 3, k);
    assert_true(isnan(none.incident) && isnan(none.reflected));
    assert_true(sb_split_separation(some, 3, k) > SB_SEPARATION_TRUSTED);
    assert_near(sb_split_separation(two, 2, k), SB_SEPARATION_TRUSTED, 2e-3);
    double sums[64] = {0}, scratch[64], a[3], b[3];
    for (int i = 0; i < 6; i++) sb_harmonics_add(sums, 3, 1, i, 1);
    assert_false(sb_harmonics_solve(sums, 3, scratch, a, b)); /* six samples, seven unknowns */
    for (int i = 0; i < 100; i++) sb_harmonics_add(sums, 3, 1, 1e-3 * i, 1);
    assert_true(!sb_harmonics_solve((double[64]){0}, 3, scratch, a, b));
}

/* With two samples per period the sine of a harmonic is 0 at all of them but for rounding. */
static void harmonics_need_more_than_two_samples(void **state)
{
    (void)state;
    enum { MOST = 5 };
    const double rows[] = {1, 2, 3, 9.99, 10, 10.01, 11};
    const int most[] = {0, 0, 1, 4, 4, 5, 5};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_int_equal(sb_harmonics_most(rows[i] * 0.1, 0.1), most[i]);
    assert_int_equal(sb_harmonics_most(0.9, 0.15), 2); /* 0.9/0.15 is rounded up to 6 */
    for (int harmonics = MOST; harmonics >= MOST - 1; harmonics--) {
        double sums[2 * MOST * 2 * MOST + 6 * MOST + 2] = {0}, scratch[sizeof sums / sizeof *sums], a[MOST], b[MOST];
        assert_true(sb_harmonics_size(harmonics) <= sizeof sums / sizeof *sums);
        for (int i = 0; i < 60; i++) {
            const double t = 5 + 0.1 * i;
            sb_harmonics_add(sums, harmonics, 2 * M_PI, t, 0.1 * cos(2 * M_PI * t) + 0.01 * sin(8 * M_PI * t));
        }
        const bool solved = sb_harmonics_solve(sums, harmonics, scratch, a, b);
        assert_true(solved == (harmonics < MOST));
        if (!solved) continue;
        assert_near(a[0], 0.1, 1e-12);
        assert_near(b[3], 0.01, 1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_waves_are_found),
        cmocka_unit_test(noise_averages_out),
        cmocka_unit_test(bound_harmonics_show_as_misfit),
        cmocka_unit_test(free_and_bound_waves_are_told_apart),
        cmocka_unit_test(separation_of_four_waves_bounds_errors),
        cmocka_unit_test(singular_places_are_detected),
        cmocka_unit_test(harmonics_need_more_than_two_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
