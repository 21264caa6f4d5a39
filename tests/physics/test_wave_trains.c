/* Paddles that make waves of long duration: transfer functions against integrals, and trains against wave theory. */
#include "../check.h"
#include "physics/wavemakers/paddle_second.h"
#include "physics/wavemakers/paddle_third.h"
#include "physics/wavemakers/wave_train.h"
#include "physics/waves/breaking.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/steady_wave.h"

#include <stdio.h>
#include <string.h>

static const double GRAVITY = 9.81;

/* The share of cosh kz in the motion, by the midpoint rule; its wave has H/S = sinh kd times it. */
static double gain_by_integrals(sb_paddle_motion motion, double k, double d)
{
    enum { N = 20000 };
    double top = 0, bottom = 0;
    for (int i = 0; i < N; i++) {
        const double z = d * (i + 0.5) / N, c = cosh(k * z);
        top += (motion == SB_PADDLE_FLAP ? z / d : 1) * c;
        bottom += c * c;
    }
    return top / bottom * sinh(k * d);
}

static void gain_is_that_of_the_integrals(void **state)
{
    (void)state;
    for (double kd = 0.02; kd < 9; kd *= 1.3)
        for (int motion = SB_PADDLE_PISTON; motion <= SB_PADDLE_FLAP; motion++) {
            const double d = 0.7, expected = gain_by_integrals(motion, kd / d, d);
            assert_near(sb_paddle_gain(motion, kd / d, d), expected, 1e-6 * expected);
        }
}

/* Figures of four laboratory waves to their last digit. */
static void gains_of_known_waves(void **state)
{
    (void)state;
    const struct {
        double period, depth, gain;
    } waves[] = {{1.2, 0.5, 1.4167}, {2.02, 0.4, 0.6697}, {2, 0.25, 0.5227}, {3.33, 0.36, 0.3694}};
    for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
        const double k = sb_wave_number(waves[i].period, waves[i].depth, GRAVITY);
        assert_near(sb_paddle_gain(SB_PADDLE_PISTON, k, waves[i].depth), waves[i].gain, 5.1e-5);
    }
}

/* The water that the paddle displaces is in the waves that leave, W/k, and in those that stay. */
static void evanescent_waves_hold_the_rest_of_the_water(void **state)
{
    (void)state;
    enum { N = 4000 };
    for (double period = 0.6; period < 6; period *= 1.5)
        for (int motion = SB_PADDLE_PISTON; motion <= SB_PADDLE_FLAP; motion++) {
            const double d = 0.5, omega = 2 * M_PI / period, k = sb_wave_number(period, d, GRAVITY);
            double held = 0;
            for (int i = 0; i < N; i++) {
                /* x = 5 d s^2 resolves the start. */
                const double s = (i + 0.5) / N, x = 5 * d * s * s;
                held += sb_paddle_evanescent(motion, omega, d, GRAVITY, x) * 10 * d * s / N;
            }
            const double moved = motion == SB_PADDLE_PISTON ? d : 0.5 * d;
            assert_near(sb_paddle_gain(motion, k, d) / k + held, moved, 1e-3 * moved);
        }
}

static void one_frequency_is_absorbed_entirely(void **state)
{
    (void)state;
    for (double period = 0.6; period < 7; period *= 1.4)
        for (double distance = 0; distance < 0.1; distance += 0.03) {
            const sb_band_part band = {2 * M_PI / period, 1};
            const double slow = 0.02 * band.omega, d = 0.5;
            const sb_absorbing_filter f =
                sb_absorbing_filter_of(SB_PADDLE_PISTON, &band, 1, slow, d, GRAVITY, distance);
            assert_true(f.gain > 0 && f.pole > 0);
            assert_near(sb_absorbing_reflection(&f, SB_PADDLE_PISTON, band.omega, d, GRAVITY, distance), 0, 1e-9);
        }
}

/* A gain with no filter at the paddle itself, with the waves that stay ignored, reflects (1 - q)/(1 + q), q = G
   W/omega: the gain of long waves leaves 9 % at kd 1.53 and 3 % at 0.67. Long waves make few waves that stay. */
static void plain_gain_reflects_as_known(void **state)
{
    (void)state;
    const double d = 0.5;
    for (double kd = 0.01; kd < 0.1; kd *= 2) {
        const double omega = sqrt(GRAVITY * kd / d * tanh(kd)), w = sb_paddle_gain(SB_PADDLE_PISTON, kd / d, d);
        const sb_absorbing_filter f = {.gain = 0.5 * omega / w, .pole = (double)INFINITY};
        const double r = sb_absorbing_reflection(&f, SB_PADDLE_PISTON, omega, d, GRAVITY, 0);
        assert_near(r, 0.5 / 1.5, 0.01);
    }
}

static sb_wavemaker_parameters parameters_of(const char *kind)
{
    return (sb_wavemaker_parameters){.kind = sb_wavemaker_find(kind),
                                     .height = 0.06,
                                     .depth = 0.5,
                                     .gravity = GRAVITY,
                                     .period = 1.6,
                                     .ramp = -1,
                                     .lasts = (double)INFINITY,
                                     .gamma = 3.3,
                                     .components = 300,
                                     .seed = 4,
                                     .distance = 6,
                                     .focus = 20};
}

static sb_wave_train *train_of(const sb_wavemaker_parameters *parameters)
{
    void *state = NULL;
    sb_error error = {0};
    if (parameters->kind->create(parameters, &state, &error) != SB_OK) fail_msg("%s", error.text);
    return state;
}

static double surface_of(const sb_wave_train *train, double t, double x)
{
    double sum = 0;
    for (size_t i = 0; i < train->count; i++)
        sum +=
            train->part[i].amplitude * cos(train->part[i].omega * t + train->part[i].phase - train->part[i].number * x);
    return sum;
}

static void regular_waves_choose_their_theory(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("regular");
    sb_wave_train *train = train_of(&p);
    assert_string_equal(train->facts.theory, "second-order");
    assert_near(train->ramp, 2 * p.period, 1e-12);
    const double omega = 2 * M_PI / p.period, t = 17.3;
    sb_steady_wave steady;
    assert_true(sb_steady_wave_of(p.height, p.period, p.depth, p.gravity, &steady));
    const double linear = sb_paddle_third_amplitude(steady.first, train->facts.number, p.depth, NULL);
    assert_near(train->part[0].amplitude, linear, 1e-12);
    const double stroke = 2 * linear / sb_paddle_gain(SB_PADDLE_PISTON, train->facts.number, p.depth);
    const double complex second = sb_paddle_second(2 * linear, omega, p.depth, p.gravity);
    const double expected = 0.5 * stroke * sin(omega * t) + creal(second * cexp(CMPLX(0, 2 * omega * t)));
    assert_near(sb_wave_train_displacement(train, t), expected, 1e-12);
    sb_wave_train_destroy(train);
    p.period = 2;
    p.depth = 0.25;
    train = train_of(&p);
    assert_string_equal(train->facts.theory, "cnoidal");
    sb_wave_train_destroy(train);
    sb_error error = {0};
    void *none = NULL;
    p.theory = SB_WAVE_STOKES2;
    assert_int_equal(p.kind->create(&p, &none, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "26.3"));
    p.theory = SB_WAVE_AUTO;
    p.height = 0.3;
    assert_int_equal(p.kind->create(&p, &none, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "breaks"));
}

/* The motion goes on from heights with a steady wave to those without, to deep water and to the breaking height. */
static void steep_waves_are_told(void **state)
{
    (void)state;
    const double depths[] = {0.9, 1.2, 2, 5, 40, 90};
    for (size_t d = 0; d < 6; d++) {
        sb_wavemaker_parameters p = parameters_of("regular");
        p.depth = 1;
        p.theory = SB_WAVE_STOKES2;
        p.period = 2 * M_PI / sqrt(GRAVITY * depths[d] * tanh(depths[d]));
        const double most = sb_breaking_height(depths[d], 1);
        const double valid = SB_URSELL_LIMIT * pow(depths[d] / (2 * M_PI), 2);
        bool told = false;
        for (double share = 0.05; share < 1; share += 0.05) {
            p.height = share * fmin(most, valid);
            sb_wave_train *train = train_of(&p);
            const double factor = train->part[0].amplitude / (0.5 * p.height);
            if (!(factor > 0.85 && factor < 1.22)) fail_msg("kd %g, share %g: %g", depths[d], share, factor);
            told = p.kind->warning(&p) != NULL;
            assert_true(share < 0.5 ? !told : true);
            sb_wave_train_destroy(train);
        }
        assert_true(told || depths[d] < 3);
    }
}

/* The highest steady waves by the Fourier series, which ends a few per cent below them, are below the limit and near
   it; very long ones break as the highest solitary wave. */
static void waves_break_as_the_highest_steady_waves(void **state)
{
    (void)state;
    static const double periods[] = {1.6, 2.3, 3, 4};
    for (size_t i = 0; i < sizeof periods / sizeof *periods; i++) {
        double high = 0;
        sb_steady_wave wave, found = {0};
        for (double height = 0.3; height < 0.8 && sb_steady_wave_of(height, periods[i], 1, GRAVITY, &wave);
             height += 0.005) {
            high = height;
            found = wave;
        }
        const double most = sb_breaking_height(2 * M_PI / found.length, 1);
        printf("T %g s: found to %.3f m, limit %.4f m of its length, %.4f m of the linear one\n", periods[i], high,
               most, sb_breaking_height(sb_wave_number(periods[i], 1, GRAVITY), 1));
        assert_true(high < most && high > 0.93 * most);
    }
    assert_near(sb_breaking_height(1e-6, 1), SB_SOLITARY_HIGHEST, 1e-4);
    assert_near(sb_breaking_height(1000, 1), 0.141063 * 2 * M_PI / 1000, 1e-6);
}

static void long_waves_break_below_the_highest_solitary_wave(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("regular");
    p.depth = 1;
    p.period = 12;
    for (int auto_too = 0; auto_too < 2; auto_too++) {
        sb_error error = {0};
        void *none = NULL;
        p.theory = auto_too ? SB_WAVE_AUTO : SB_WAVE_CNOIDAL;
        p.height = 0.84;
        assert_int_equal(p.kind->create(&p, &none, &error), SB_BAD_INPUT);
        if (!strstr(error.text, "breaks, expected a height of at most 0.792 m")) fail_msg("%s", error.text);
        p.height = 0.79;
        sb_wave_train *train = train_of(&p);
        assert_string_equal(train->facts.theory, "cnoidal");
        sb_wave_train_destroy(train);
    }
}

/* dX/dt is the mean velocity C eta/(d + eta) of the wave at the paddle, at which the phase that it returns is. */
static void cnoidal_piston_moves_with_the_water(void **state)
{
    (void)state;
    const double heights[] = {1e-5, 0.02, 0.06, 0.12};
    for (size_t i = 0; i < 4; i++) {
        sb_cnoidal wave;
        sb_error error = {0};
        if (sb_cnoidal_of_period(heights[i], 2.5, 0.25, GRAVITY, &wave, &error) != SB_OK) fail_msg("%s", error.text);
        const double top = wave.celerity * heights[i] / 0.25;
        for (double t = -3; t < 9; t += 0.0717) {
            const double step = 1e-4;
            double phase;
            sb_wave_motion motion;
            const double x = sb_cnoidal_piston(&wave, t, &phase);
            sb_cnoidal_at(&wave, phase, 0, &motion);
            const double speed =
                (sb_cnoidal_piston(&wave, t + step, NULL) - sb_cnoidal_piston(&wave, t - step, NULL)) / (2 * step);
            const double expected = wave.celerity * motion.elevation / (0.25 + motion.elevation);
            assert_near(speed, expected, 1e-4 * top);
            assert_near(remainder(x - wave.celerity * t - phase * wave.length, wave.length), 0, 1e-9);
            assert_near(sb_cnoidal_piston(&wave, t + 2.5, NULL), x, 1e-9);
        }
        assert_near(sb_cnoidal_piston(&wave, 0, NULL), 0, 1e-12);
    }
}

/* At a place that moves with the paddle a cnoidal wave has a positive mean, about the one of second order that the
   filter of an absorbing paddle takes away: the law's surface there has none. */
static void surfaces_have_no_mean_beside_the_paddle(void **state)
{
    (void)state;
    enum { N = 1000 };
    sb_wavemaker_parameters p = parameters_of("regular");
    p.period = 2;
    p.depth = 0.25;
    sb_wave_train *train = train_of(&p);
    double sum[2] = {0}, square = 0;
    for (int far = 0; far < 2; far++) {
        sb_wave_train_place(train, 0.1 * far);
        for (int i = 0; i < N; i++) {
            const double z = sb_wave_train_surface(train, train->ramp + p.period * i / N);
            sum[far] += z / N;
            square += far ? 0 : z * z / N;
        }
    }
    assert_near(sum[0], 0, 1e-6);
    assert_near(sum[1], 0, 1e-6);
    sb_wave_train_place(train, 0);
    const double k = train->facts.number;
    printf("mean of the surface %.4g m, of second order %.4g m\n", train->mean,
           square * sb_paddle_mean_of_square(k, p.depth));
    assert_true(train->mean > 0.5 * square * sb_paddle_mean_of_square(k, p.depth));
    assert_true(train->mean < 3 * square * sb_paddle_mean_of_square(k, p.depth));
    sb_wave_train_destroy(train);
}

static void irregular_waves_have_their_height_and_peak(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("irregular");
    sb_wave_train *train = train_of(&p);
    double m0 = 0, at_peak = 0, m2 = 0;
    for (size_t i = 0; i < train->count; i++) {
        const sb_train_part *part = &train->part[i];
        const double f = part->omega * p.period / (2 * M_PI), energy = 0.5 * part->amplitude * part->amplitude;
        m0 += energy;
        m2 += energy * f * f;
        if (fabs(f - 1) < 0.1) at_peak += energy;
    }
    assert_near(4 * sqrt(m0), p.height, 1e-12);
    assert_true(at_peak > 0.4 * m0 && at_peak < 0.6 * m0);
    double all = 0, squares = 0;
    for (double f = 0.5005; f < 3; f += 0.001) {
        const double s =
            exp(-1.25 / pow(f, 4)) / pow(f, 5) * pow(3.3, exp(-0.5 * pow((f - 1) / (f <= 1 ? 0.07 : 0.09), 2)));
        all += s;
        squares += s * f * f;
    }
    assert_near(sqrt(m0 / m2), sqrt(all / squares), 0.002);
    const double first = sb_wave_train_displacement(train, 40);
    sb_wave_train_destroy(train);
    train = train_of(&p);
    assert_true(sb_wave_train_displacement(train, 40) == first);
    sb_wave_train_destroy(train);
    p.seed = 5;
    train = train_of(&p);
    assert_true(sb_wave_train_displacement(train, 40) != first);
    sb_wave_train_destroy(train);
}

static void focused_waves_meet_at_their_place_and_time(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("focused");
    sb_wave_train *train = train_of(&p);
    assert_near(surface_of(train, p.focus, p.distance), 0.5 * p.height, 1e-12);
    for (double t = 0; t < 40; t += 0.31)
        for (double x = 0; x < 12; x += 0.43) assert_true(surface_of(train, t, x) <= 0.5 * p.height + 1e-12);
    assert_true(fabs(surface_of(train, 4, 0)) < 0.1 * p.height);
    sb_wave_train_destroy(train);
}

/* The sum of the parts at the distance is the surface of the file. */
static void signal_is_made_at_its_distance(void **state)
{
    (void)state;
    const char *path = SB_BINARY_DIR "/wave-train-signal.txt";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("time (s), surface (m)\n", file);
    enum { ROWS = 400 };
    const double step = 0.1;
    for (int i = 0; i < ROWS; i++) {
        const double t = i * step - 20;
        fprintf(file, "%.3f, %.9f\n", i * step, 0.04 * exp(-t * t / 20) * sin(3.1 * t) + 0.002);
    }
    assert_int_equal(fclose(file), 0);
    sb_wavemaker_parameters p = parameters_of("signal");
    char name[] = SB_BINARY_DIR "/wave-train-signal.txt";
    p.file = name;
    sb_wave_train *train = train_of(&p);
    for (int i = 0; i < ROWS; i++) {
        const double t = i * step - 20, expected = 0.04 * exp(-t * t / 20) * sin(3.1 * t);
        assert_near(surface_of(train, i * step, p.distance), expected, 0.0015);
    }
    assert_near(train->lasts, ROWS * step, 1e-9);
    assert_near(sb_wave_train_displacement(train, 0), 0, 0);
    sb_wave_train_destroy(train);
}

/* The surface of a list, far from the paddle, is the one that docs/waves.md states: a cos(wt - kx + phase). */
static void phases_of_a_list_are_those_at_the_paddle(void **state)
{
    (void)state;
    char list[] = SB_BINARY_DIR "/wave-train-phase.txt";
    FILE *file = fopen(list, "w");
    assert_non_null(file);
    fputs("0.02 1.6 0\n0.01 1.1 90\n", file);
    assert_int_equal(fclose(file), 0);
    sb_wavemaker_parameters p = parameters_of("components");
    p.file = list;
    p.ramp = 0;
    sb_wave_train *train = train_of(&p);
    const double x = 10, one = 2 * M_PI / 1.6, other = 2 * M_PI / 1.1;
    sb_wave_train_place(train, x);
    for (double t = 5; t < 9; t += 0.37)
        assert_near(sb_wave_train_surface(train, t),
                    0.02 * cos(one * t - sb_wave_number(1.6, p.depth, GRAVITY) * x) -
                        0.01 * sin(other * t - sb_wave_number(1.1, p.depth, GRAVITY) * x),
                    1e-9);
    sb_wave_train_destroy(train);
}

/* The waves of an irregular sea as a list and as a signal break where the sea does: Hs 0.6 m of 1.5 s on 1 m, whose
   limit is 0.454 m. One wave may be higher: its height is 2a. */
static void sums_break_however_they_are_given(void **state)
{
    (void)state;
    char list[] = SB_BINARY_DIR "/wave-train-list.txt", signal[] = SB_BINARY_DIR "/wave-train-high.txt";
    sb_wavemaker_parameters p = parameters_of("irregular");
    p.depth = 1;
    p.period = 1.5;
    for (int high = 0; high < 2; high++) {
        p.kind = sb_wavemaker_find("irregular");
        p.height = 0.42;
        sb_wave_train *sea = train_of(&p);
        const double scale = high ? 0.6 / 0.42 : 1;
        FILE *waves = fopen(list, "w"), *series = fopen(signal, "w");
        assert_non_null(waves);
        assert_non_null(series);
        for (size_t i = 0; i < sea->count; i++)
            fprintf(waves, "%.9g %.9g %g\n", scale * sea->part[i].amplitude, 2 * M_PI / sea->part[i].omega,
                    sea->part[i].phase * 180 / M_PI);
        for (int i = 0; i < 3000; i++) fprintf(series, "%.9g %.9g\n", 0.1 * i, scale * surface_of(sea, 0.1 * i, 0));
        assert_int_equal(fclose(waves), 0);
        assert_int_equal(fclose(series), 0);
        sb_wave_train_destroy(sea);
        for (int k = 0; k < 2; k++) {
            p.kind = sb_wavemaker_find(k == 0 ? "components" : "signal");
            p.file = k == 0 ? list : signal;
            void *train = NULL;
            sb_error error = {0};
            const sb_status status = p.kind->create(&p, &train, &error);
            if (status != (high ? SB_BAD_INPUT : SB_OK) || (high && !strstr(error.text, "together have a significant")))
                fail_msg("%s: status %d: %s", p.kind->name, (int)status, error.text);
            sb_wave_train_destroy(train);
        }
    }
    FILE *one = fopen(list, "w");
    assert_non_null(one);
    fputs("0.22 1.5 0\n", one);
    assert_int_equal(fclose(one), 0);
    p.kind = sb_wavemaker_find("components");
    p.file = list;
    sb_wave_train_destroy(train_of(&p));
}

/* Root mean square of the reflected share over the energy of a train. */
static double reflected_of(const sb_wave_train *train, const sb_absorbing_filter *filter, double distance)
{
    double sum = 0, all = 0;
    for (size_t i = 0; i < train->count; i++) {
        const double weight = train->part[i].amplitude * train->part[i].amplitude;
        const double r =
            sb_absorbing_reflection(filter, SB_PADDLE_PISTON, train->part[i].omega, train->depth, GRAVITY, distance);
        sum += weight * r * r;
        all += weight;
    }
    return sqrt(sum / all);
}

/* JONSWAP waves: the filter is far better than the gain omega/W of the peak alone. */
static void spectra_are_absorbed(void **state)
{
    (void)state;
    for (double kd = 0.4; kd < 2; kd *= 1.5) {
        sb_wavemaker_parameters p = parameters_of("irregular");
        const double omega = sqrt(GRAVITY * kd / p.depth * tanh(kd)), distance = 0.15 * p.depth;
        p.period = 2 * M_PI / omega;
        p.height = 0.02;
        sb_paddle paddle = {.kind = p.kind};
        sb_wave_train *train = train_of(&p);
        sb_absorbing_filter filter;
        sb_error error = {0};
        paddle.state = train;
        if (sb_paddle_fit_absorption(&p, &paddle, distance, &filter, &error) != SB_OK) fail_msg("%s", error.text);
        const sb_absorbing_filter plain = {.gain = omega / sb_paddle_gain(SB_PADDLE_PISTON, kd / p.depth, p.depth),
                                           .pole = (double)INFINITY,
                                           .slow = filter.slow};
        const double r = reflected_of(train, &filter, distance), other = reflected_of(train, &plain, distance);
        printf("kd %.3g at the peak: %.3g %% reflected, %.3g %% by the gain alone\n", kd, 100 * r, 100 * other);
        assert_true(r < 0.5 * other);
        assert_true(kd > 1 || r < 0.05);
        sb_wave_train_destroy(train);
    }
}

/* The surface that is expected at a place: waves that leave and waves that stay. */
static void surface_near_the_paddle_contains_all_waves(void **state)
{
    (void)state;
    sb_wavemaker_parameters p = parameters_of("regular");
    p.theory = SB_WAVE_LINEAR;
    sb_wave_train *train = train_of(&p);
    const double omega = 2 * M_PI / p.period, k = train->facts.number, x = 0.05, t = 12.3;
    sb_wave_train_place(train, x);
    const double near = sb_paddle_evanescent(SB_PADDLE_PISTON, omega, p.depth, GRAVITY, x);
    assert_near(sb_wave_train_surface(train, t),
                0.03 * cos(omega * t - k * x) + near * sb_wave_train_displacement(train, t), 1e-12);
    sb_wave_train_destroy(train);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gain_is_that_of_the_integrals),
        cmocka_unit_test(gains_of_known_waves),
        cmocka_unit_test(evanescent_waves_hold_the_rest_of_the_water),
        cmocka_unit_test(one_frequency_is_absorbed_entirely),
        cmocka_unit_test(plain_gain_reflects_as_known),
        cmocka_unit_test(regular_waves_choose_their_theory),
        cmocka_unit_test(steep_waves_are_told),
        cmocka_unit_test(long_waves_break_below_the_highest_solitary_wave),
        cmocka_unit_test(waves_break_as_the_highest_steady_waves),
        cmocka_unit_test(surfaces_have_no_mean_beside_the_paddle),
        cmocka_unit_test(cnoidal_piston_moves_with_the_water),
        cmocka_unit_test(irregular_waves_have_their_height_and_peak),
        cmocka_unit_test(focused_waves_meet_at_their_place_and_time),
        cmocka_unit_test(signal_is_made_at_its_distance),
        cmocka_unit_test(phases_of_a_list_are_those_at_the_paddle),
        cmocka_unit_test(sums_break_however_they_are_given),
        cmocka_unit_test(spectra_are_absorbed),
        cmocka_unit_test(surface_near_the_paddle_contains_all_waves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
