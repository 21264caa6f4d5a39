/* Regular waves compared with tabulated values, with their limits, and with the equations that they solve. */
#include "../check.h"
#include "physics/waves/regular_wave.h"
#include "physics/waves/wave_sum.h"
#include "physics/waves/wave_theory.h"

#include <string.h>

static const double g = 9.81;

/* Three laboratory waves and one of a basin: k, L, k d, piston's H/S0, S0, H L^2/d^3 and eta2/a, computed independently
   from omega^2 = g k tanh kd and the closed forms. */
typedef struct tabulated {
    double period, depth, height, number, length, kd, ratio, stroke, ursell, second;
} tabulated;

static const tabulated table[] = {
    {1.2, 0.5, 0.12, 3.0675, 2.048, 1.534, 1.4167, 0.0847, 4.0, 0.132},
    {2.02, 0.40, 0.02, 1.6812, 3.737, 0.672, 0.6697, 0.0299, 4.4, 0.055},
    {2.0, 0.25, 0.06, 2.0941, 3.000, 0.524, 0.5227, 0.1148, 34.6, 0.39},
    {3.33, 0.36, 0.042, 1.0264, 6.121, 0.370, 0.3694, 0.1137, 33.7, 0.35},
};

static void tabulated_waves(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const tabulated *row = &table[i];
        sb_regular_wave wave;
        assert_int_equal(sb_regular_wave_create(SB_WAVE_LINEAR, row->height, row->period, row->depth, g, &wave, NULL),
                         SB_OK);
        assert_near(wave.number, row->number, 6e-5);
        assert_near(wave.length, row->length, 6e-4);
        assert_near(wave.number * row->depth, row->kd, 6e-4);
        const double ratio = sb_piston_height_over_stroke(wave.number * row->depth);
        assert_near(ratio, row->ratio, 6e-5);
        assert_near(row->height / ratio, row->stroke, 6e-5);
        assert_near(wave.ursell, row->ursell, 0.06);
        const double t = tanh(wave.number * row->depth);
        assert_near(wave.number * row->height / 8 * (3 - t * t) / (t * t * t), row->second,
                    row->second > 0.2 ? 6e-3 : 6e-4);
        if (row->ursell > SB_URSELL_LIMIT) continue;
        sb_regular_wave second;
        assert_int_equal(sb_regular_wave_create(SB_WAVE_AUTO, row->height, row->period, row->depth, g, &second, NULL),
                         SB_OK);
        assert_near(second.second / (row->height / 2), row->second, 6e-4);
    }
}

static void the_dispersion_relation_holds_to_rounding(void **state)
{
    (void)state;
    for (double period = 1e-2; period < 1e6; period *= 1.37)
        for (double depth = 1e-3; depth < 1e4; depth *= 7.3) {
            const double k = sb_wave_number(period, depth, g), omega = 2 * M_PI / period;
            assert_near(g * k * tanh(k * depth) / (omega * omega), 1, 1e-15 * 4);
        }
}

static void ratios_in_deep_and_shallow_water(void **state)
{
    (void)state;
    assert_near(sb_cosh_over_sinh(2, 0.3, 0.7), cosh(0.6) / sinh(1.4), 1e-15);
    assert_near(sb_sinh_over_sinh(2, 0.3, 0.7), sinh(0.6) / sinh(1.4), 1e-15);
    assert_near(sb_cosh_over_sinh(1, 5000, 5000), 1, 1e-15);
    assert_near(sb_sinh_over_sinh(1, 4999, 5000), exp(-1), 1e-15);
    assert_near(sb_sinh_over_sinh(1e-9, 1, 2), 0.5, 1e-15);
    assert_near(sb_piston_height_over_stroke(1e-4), 1e-4, 1e-11); /* shallow: kd */
    assert_near(sb_piston_height_over_stroke(1e3), 2, 1e-15);     /* deep: 2 */
}

/* The theory changes at the Ursell number from which the second harmonic is a quarter of the first. */
static void the_ursell_number_chooses(void **state)
{
    (void)state;
    sb_regular_wave wave;
    sb_error error = {0};
    assert_int_equal(sb_regular_wave_create(SB_WAVE_AUTO, 0.06, 2, 0.25, g, &wave, &error), SB_OK);
    assert_int_equal(wave.order, SB_WAVE_CNOIDAL);
    assert_int_equal(sb_regular_wave_create(SB_WAVE_AUTO, 0.12, 1.2, 0.5, g, &wave, &error), SB_OK);
    assert_int_equal(wave.order, SB_WAVE_STOKES2);
    assert_int_equal(sb_regular_wave_create(SB_WAVE_STOKES2, 0.06, 2, 0.25, g, &wave, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "34.5"));
    assert_int_equal(sb_regular_wave_create(SB_WAVE_AUTO, 0.5, 1.2, 0.5, g, &wave, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "breaks"));
    assert_int_equal(sb_regular_wave_create(SB_WAVE_CNOIDAL, 0.1, 0.5, 1, g, &wave, &error), SB_BAD_INPUT);
    assert_int_equal(sb_regular_wave_create(SB_WAVE_CNOIDAL, 0.1, 1e6, 1, g, &wave, &error), SB_BAD_INPUT);
}

/* The largest violations, at all phases, of: volume within the water; no flux through the surface; constant energy on
   the surface of a wave of constant form; no rotation. And the errors of the rates, and the means of elevation and
   flux. */
typedef struct violation {
    double volume, through, energy, rotation, rates, level, flux;
} violation;

static violation violation_of(const sb_regular_wave *wave)
{
    const double d = wave->depth, dx = 1e-4 * d, c = wave->celerity;
    const int count = 64;
    violation b = {0};
    double most = -HUGE_VAL, least = HUGE_VAL;
    for (int i = 0; i < count; i++) {
        const double s = wave->length * i / count;
        sb_wave_motion at, left, right, up, down, before, after;
        sb_regular_wave_at(wave, s, 0, HUGE_VAL, &at);
        sb_regular_wave_at(wave, s - dx, 0, d, &left);
        sb_regular_wave_at(wave, s + dx, 0, d, &right);
        const double slope = (right.elevation - left.elevation) / (2 * dx), eta = at.elevation;
        b.through = fmax(b.through, fabs(at.w - (at.u - c) * slope));
        const double energy = ((at.u - c) * (at.u - c) + at.w * at.w) / 2 + wave->gravity * eta;
        most = fmax(most, energy);
        least = fmin(least, energy);
        b.level += eta / count;
        const int layers = 400;
        for (int j = 0; j < layers; j++) { /* by the midpoint rule */
            sb_regular_wave_at(wave, s, 0, (d + eta) * (j + 0.5) / layers, &at);
            b.flux += at.u * (d + eta) / layers / count;
        }
        for (double z = 0.1 * d; z < 0.9 * (d + eta) - dx; z += 0.13 * d) {
            const double dt = dx / c;
            sb_regular_wave_at(wave, s - dx, 0, z, &left);
            sb_regular_wave_at(wave, s + dx, 0, z, &right);
            sb_regular_wave_at(wave, s, 0, z - dx, &down);
            sb_regular_wave_at(wave, s, 0, z + dx, &up);
            sb_regular_wave_at(wave, s, -dt, z, &before);
            sb_regular_wave_at(wave, s, dt, z, &after);
            sb_regular_wave_at(wave, s, 0, z, &at);
            b.volume = fmax(b.volume, fabs(right.u - left.u + up.w - down.w) / (2 * dx));
            b.rotation = fmax(b.rotation, fabs(up.u - down.u - right.w + left.w) / (2 * dx));
            b.rates = fmax(b.rates, fmax(fabs((after.u - before.u) / (2 * dt) - at.u_rate),
                                         fabs((after.w - before.w) / (2 * dt) - at.w_rate)));
        }
    }
    b.energy = most - least;
    return b;
}

static violation violation_of_height(sb_wave_order order, double height, double period)
{
    sb_regular_wave wave;
    assert_int_equal(sb_regular_wave_create(order, height, period, 1, 1, &wave, NULL), SB_OK);
    return violation_of(&wave);
}

/* Laplace's equation holds exactly; on the surface the errors are of the order above the theory's: halving the height
   divides those of a second-order wave by 8, those of a linear one by 4. Units: depth and sqrt(g d). */
static void linear_and_second_order_waves(void **state)
{
    (void)state;
    const double periods[] = {5, 9, 14}; /* kd 1.74, 0.77, 0.46 */
    for (size_t i = 0; i < 3; i++) {
        const double height = i == 2 ? 0.05 : 0.1;
        const violation high = violation_of_height(SB_WAVE_STOKES2, height, periods[i]);
        const violation low = violation_of_height(SB_WAVE_STOKES2, height / 2, periods[i]);
        assert_true(high.volume < 1e-7 && high.rotation < 1e-7 && high.rates < 1e-7);
        assert_near(high.through / low.through, 8, 1);
        assert_near(high.energy / low.energy, 8, 1.2);
        assert_near(high.level, 0, 1e-15);
        assert_true(fabs(high.flux) < pow(height, 3)); /* of higher order */
        const violation first = violation_of_height(SB_WAVE_LINEAR, 0.02, periods[i]);
        const violation half = violation_of_height(SB_WAVE_LINEAR, 0.01, periods[i]);
        assert_true(first.volume < 1e-7 && first.rotation < 1e-7 && first.rates < 1e-7);
        assert_near(first.through / half.through, 4, 0.4);
        assert_near(first.level, 0, 1e-15);
    }
}

/* A cnoidal wave conserves volume exactly and carries none on average. Its error of energy is of the third order:
   halved height at the same elliptic parameter (period * sqrt(2)) divides it by 8. */
static void cnoidal_waves(void **state)
{
    (void)state;
    const violation high = violation_of_height(SB_WAVE_CNOIDAL, 0.1, 25);
    const violation low = violation_of_height(SB_WAVE_CNOIDAL, 0.05, 25 * sqrt(2));
    assert_true(high.volume < 1e-7 && high.through < 1e-7 && high.rates < 1e-7);
    assert_near(high.level, 0, 1e-9); /* the 64 phases integrate a narrow crest to this */
    assert_near(high.flux, 0, 1e-6);
    assert_near(high.energy / low.energy, 8, 1.6);
    assert_near(high.rotation / low.rotation, 8, 1.6); /* likewise of the third order */
    sb_regular_wave wave;
    assert_int_equal(sb_regular_wave_create(SB_WAVE_AUTO, 0.042, 3.33, 0.36, g, &wave, NULL), SB_OK);
    sb_wave_motion crest, trough, later;
    sb_regular_wave_at(&wave, 0, 0, 0, &crest);
    sb_regular_wave_at(&wave, wave.length / 2, 0, 0, &trough);
    sb_regular_wave_at(&wave, 17 * wave.length, -1000 * wave.period, 0, &later);
    assert_near(crest.elevation - trough.elevation, 0.042, 1e-15);
    assert_near(later.elevation, crest.elevation, 1e-13);
    assert_near(wave.length, wave.celerity * wave.period, 1e-12);
    assert_near(sb_regular_wave_crest(&wave), crest.elevation, 1e-15);
}

/* sn, cn and dn against their defining integral, and K and E against series and closed forms. */
static void elliptic_functions(void **state)
{
    (void)state;
    const sb_elliptic half = sb_elliptic_of(0);
    assert_near(half.k, 1.8540746773013719, 1e-15);                            /* Gamma(1/4)^2/(4 sqrt(pi)) */
    assert_near((1 - 0.25 - half.excess) * half.k, 1.3506438810476755, 1e-15); /* E(1/2) */
    const double logits[] = {-8, 0, 3, 20};
    for (size_t i = 0; i < 4; i++) {
        const sb_elliptic e = sb_elliptic_of(logits[i]);
        for (double part = 0.1; part < 1; part += 0.2) {
            /* u = integral of 1/sqrt(1 - m sin^2) to the amplitude, by Simpson's rule in 20000 intervals */
            double sn, cn, dn, sum = 0;
            sb_elliptic_at(&e, part * fmin(e.k, 6), &sn, &cn, &dn);
            const double amplitude = atan2(sn, cn);
            for (int j = 0; j <= 20000; j++) {
                const double s = sin(amplitude * j / 20000);
                sum += (j == 0 || j == 20000 ? 1 : j % 2 ? 4 : 2) / sqrt(1 - e.m * s * s);
            }
            assert_near(sum * amplitude / 60000, part * fmin(e.k, 6), 1e-9);
            assert_near(dn * dn, 1 - e.m * sn * sn, 1e-14);
        }
    }
    /* m -> 1: K -> ln(4/sqrt(m1)), cn -> sech; m1 = exp(-600) is still exact */
    const sb_elliptic near = sb_elliptic_of(600);
    assert_near(near.k, log(4) + 300, 1e-10);
    double sn, cn, dn;
    sb_elliptic_at(&near, 2, &sn, &cn, &dn);
    assert_near(cn, 1 / cosh(2), 1e-14);
    assert_near((1 - near.m / 2 - near.excess) * near.k, 1, 1e-10); /* E(1) */
}

/* As the period grows, the wave about its crest becomes Boussinesq's solitary wave on the water at the trough. */
static void cnoidal_waves_become_solitary(void **state)
{
    (void)state;
    sb_cnoidal wave;
    assert_int_equal(sb_cnoidal_of_period(0.3, 400, 1, 1, &wave, NULL), SB_OK);
    const sb_solitary solitary = {.height = 0.3, .depth = 1, .gravity = 1, .theory = SB_SOLITARY_BOUSSINESQ};
    /* The level of the trough and the celerity differ by the mean of the crest, 2 H/(kappa L). */
    assert_near(wave.trough, -4 * 0.3 / sqrt(0.9) / wave.length, 1e-3 * -wave.trough);
    assert_near(wave.celerity, sb_solitary_celerity(&solitary), 3 * -wave.trough);
    for (double x = -6; x < 6; x += 0.7) {
        sb_wave_motion motion;
        sb_cnoidal_at(&wave, x / wave.length, 0, &motion);
        assert_near(motion.elevation - wave.trough, sb_solitary_elevation(&solitary, x), 1e-14);
    }
}

/* As the height tends to 0, the wave becomes linear with the dispersion of Korteweg and de Vries, c^2 = g d (1 - k^2
   d^2 /3), which differs from the exact one by O((kd)^4). */
static void low_cnoidal_waves_become_linear(void **state)
{
    (void)state;
    sb_cnoidal wave;
    assert_int_equal(sb_cnoidal_of_period(1e-7, 50, 1, 1, &wave, NULL), SB_OK);
    const double k = 2 * M_PI / wave.length, exact = sb_wave_number(50, 1, 1);
    assert_near(wave.celerity * wave.celerity, 1 - k * k / 3, 1e-8);
    assert_near(k / exact, 1, pow(k, 4));
    assert_near(wave.trough, -0.5e-7, 1e-12);
    sb_regular_wave linear;
    assert_int_equal(sb_regular_wave_create(SB_WAVE_LINEAR, 1e-7, 50, 1, 1, &linear, NULL), SB_OK);
    for (double phase = -0.5; phase < 0.5; phase += 0.1) {
        sb_wave_motion a, b;
        sb_cnoidal_at(&wave, phase, 0.6, &a);
        sb_regular_wave_at(&linear, phase * linear.length, 0, 0.6, &b);
        assert_near(a.elevation / 1e-7, b.elevation / 1e-7, 1e-5);
        assert_near(a.u / 1e-7, b.u / 1e-7, 1e-3); /* O((kd)^4) */
        assert_near(a.w / 1e-7, b.w / 1e-7, 1e-3);
        assert_near(a.u_rate / 1e-7, b.u_rate / 1e-7, 1e-3);
    }
}

/* One component is a linear wave in its direction; more are their sum, at any period of time. */
static void components_add(void **state)
{
    (void)state;
    const double turn = 0.4;
    sb_wave_component waves[] = {{.amplitude = 0.01, .period = 2, .direction = turn, .phase = 0.3},
                                 {.amplitude = 0.02, .period = 5, .direction = -1}};
    for (int i = 0; i < 2; i++) sb_wave_component_prepare(&waves[i], 0.7, g);
    sb_regular_wave linear;
    assert_int_equal(sb_regular_wave_create(SB_WAVE_LINEAR, 0.02, 2, 0.7, g, &linear, NULL), SB_OK);
    sb_wave_sum sum, other, both;
    sb_wave_motion motion;
    sb_wave_sum_at(waves, 1, 0.7, 1.1, 0.5, 0.9, 0.4, &sum);
    const double s = 0.5 * cos(turn) + 0.9 * sin(turn) + 0.3 / linear.number;
    sb_regular_wave_at(&linear, s, 1.1, 0.4, &motion);
    assert_near(sum.elevation, motion.elevation, 1e-15);
    assert_near(sum.velocity[0], motion.u * cos(turn), 1e-15);
    assert_near(sum.velocity[1], motion.u * sin(turn), 1e-15);
    assert_near(sum.velocity[2], motion.w, 1e-15);
    assert_near(sum.velocity_rate[0], motion.u_rate * cos(turn), 1e-14);
    assert_near(sum.velocity_rate[2], motion.w_rate, 1e-14);
    sb_wave_sum_at(waves + 1, 1, 0.7, 1.1, 0.5, 0.9, 0.4, &other);
    sb_wave_sum_at(waves, 2, 0.7, 1.1 + 1e4, 0.5, 0.9, 0.4, &both);      /* 1e4 s: a multiple of both periods */
    assert_near(both.elevation, sum.elevation + other.elevation, 1e-13); /* 10001.1 s is rounded by 1e-12 s */
    assert_near(both.velocity[1], sum.velocity[1] + other.velocity[1], 1e-13);
    /* On the still level the water moves with the surface. */
    sb_wave_sum ahead, behind;
    sb_wave_sum_at(waves, 2, 0.7, 3 + 1e-4, 1, 2, 9, &ahead);
    sb_wave_sum_at(waves, 2, 0.7, 3 - 1e-4, 1, 2, 9, &behind);
    sb_wave_sum_at(waves, 2, 0.7, 3, 1, 2, 9, &both);
    assert_near(both.velocity[2], (ahead.elevation - behind.elevation) / 2e-4, 1e-9);
    assert_true(fabs(both.elevation) <= sb_wave_sum_crest(waves, 2));
    assert_true(hypot(both.velocity[0], both.velocity[1]) <= sb_wave_sum_speed(waves, 2, 0.7));
}

static void solitary_accelerations(void **state)
{
    (void)state;
    const sb_solitary wave = {.height = 0.3, .depth = 2, .gravity = 9.81};
    const double c = sb_solitary_celerity(&wave), dt = 1e-4;
    sb_wave_motion at;
    double u[2], w[2];
    sb_solitary_motion(&wave, 1.3, 0.8, &at);
    sb_solitary_velocity(&wave, 1.3 - c * dt, 0.8, &u[1], &w[1]);
    sb_solitary_velocity(&wave, 1.3 + c * dt, 0.8, &u[0], &w[0]);
    assert_near(at.u_rate, (u[1] - u[0]) / (2 * dt), 1e-7);
    assert_near(at.w_rate, (w[1] - w[0]) / (2 * dt), 1e-7);
    assert_near(at.elevation, sb_solitary_elevation(&wave, 1.3), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tabulated_waves),
        cmocka_unit_test(the_dispersion_relation_holds_to_rounding),
        cmocka_unit_test(ratios_in_deep_and_shallow_water),
        cmocka_unit_test(the_ursell_number_chooses),
        cmocka_unit_test(linear_and_second_order_waves),
        cmocka_unit_test(cnoidal_waves),
        cmocka_unit_test(elliptic_functions),
        cmocka_unit_test(cnoidal_waves_become_solitary),
        cmocka_unit_test(low_cnoidal_waves_become_linear),
        cmocka_unit_test(components_add),
        cmocka_unit_test(solitary_accelerations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
