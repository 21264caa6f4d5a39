/* Solitary waves by the full equations: laws that any wave of permanent form obeys, none of which is used to compute
 * it. */
#include "../check.h"
#include "physics/waves/solitary_exact.h"
#include "physics/waves/wave_theory.h"

#include <stdio.h>
#include <string.h>

static sb_solitary_exact *wave_of(double height, double depth, double gravity)
{
    sb_solitary_exact *wave = NULL;
    sb_error error = {0};
    if (sb_solitary_exact_create(height, depth, gravity, &wave, &error) != SB_OK) fail_msg("%s", error.text);
    return wave;
}

/* Largest violations: of volume and of irrotational flow within the water, of the flux through the surface, of energy
   on it; largest error of the accelerations, and of w on the bed. Depth and gravity are 1. */
typedef struct violation {
    double volume, rotation, through, energy, rate, bed;
} violation;

static void examine_place(const sb_solitary_exact *wave, double xi, double z, violation *v)
{
    const double d = 1e-4, c = sb_solitary_exact_celerity(wave);
    sb_wave_motion ahead, behind, above, below, at;
    sb_solitary_exact_motion(wave, xi + d, z, &ahead);
    sb_solitary_exact_motion(wave, xi - d, z, &behind);
    sb_solitary_exact_motion(wave, xi, z + d, &above);
    sb_solitary_exact_motion(wave, xi, z - d, &below);
    sb_solitary_exact_motion(wave, xi, z, &at);
    v->volume = fmax(v->volume, fabs(ahead.u - behind.u + above.w - below.w) / (2 * d));
    v->rotation = fmax(v->rotation, fabs(ahead.w - behind.w - above.u + below.u) / (2 * d));
    v->rate = fmax(v->rate, fabs(at.u_rate + c * (ahead.u - behind.u) / (2 * d)));
    v->rate = fmax(v->rate, fabs(at.w_rate + c * (ahead.w - behind.w) / (2 * d)));
}

static violation violation_of(const sb_solitary_exact *wave)
{
    const double d = 1e-4, c = sb_solitary_exact_celerity(wave);
    const double reach = fmax(8, 8 / sqrt(3 * sb_solitary_exact_elevation(wave, 0)));
    violation v = {0};
    for (double xi = -reach; xi <= reach; xi += reach * 0.11 / 8) {
        sb_wave_motion top, bed;
        const double eta = sb_solitary_exact_elevation(wave, xi);
        const double slope =
            (sb_solitary_exact_elevation(wave, xi + d) - sb_solitary_exact_elevation(wave, xi - d)) / (2 * d);
        for (double share = 0.05; share < 0.99; share += 0.07) examine_place(wave, xi, share * (1 + eta), &v);
        sb_solitary_exact_motion(wave, xi, 1 + eta, &top);
        sb_solitary_exact_motion(wave, xi, 0, &bed);
        assert_near(top.elevation, eta, 1e-15);
        v.through = fmax(v.through, fabs(top.w - (top.u - c) * slope));
        v.energy = fmax(v.energy, fabs(eta + ((top.u - c) * (top.u - c) + top.w * top.w - c * c) / 2));
        v.bed = fmax(v.bed, fabs(bed.w));
    }
    return v;
}

static void the_laws_hold(void **state)
{
    (void)state;
    static const double heights[] = {0.001, 0.003, 0.01, 0.1, 0.3, 0.5, 0.6, 0.7};
    for (size_t k = 0; k < sizeof heights / sizeof *heights; k++) {
        sb_solitary_exact *wave = wave_of(heights[k], 1, 1);
        const violation v = violation_of(wave);
        printf("H/h %g: volume %.1e, rotation %.1e, through %.1e, energy %.1e, rates %.1e, bed %.1e\n", heights[k],
               v.volume, v.rotation, v.through, v.energy, v.rate, v.bed);
        const double most = heights[k] > 0.6 ? 1e-4 : 1e-5 * fmin(1, 10 * heights[k]);
        assert_true(v.volume < most && v.rotation < most && v.through < most && v.energy < most);
        assert_true(v.rate < most && v.bed < most);
        sb_solitary_exact_destroy(wave);
    }
}

/* 3 V = (c^2 - 1) M, with the potential energy V and the volume M of a solitary wave [Starr 1947]. */
static void potential_energy_follows_from_volume(void **state)
{
    (void)state;
    static const double heights[] = {0.001, 0.003, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    for (size_t h = 0; h < sizeof heights / sizeof *heights; h++) {
        const double height = heights[h];
        sb_solitary_exact *wave = wave_of(height, 1, 1);
        const double c = sb_solitary_exact_celerity(wave), d = 0.01 * fmax(1, sqrt(0.1 / height));
        double volume = 0, potential = 0;
        for (int k = -5000; k <= 5000; k++) {
            const double eta = sb_solitary_exact_elevation(wave, k * d);
            volume += d * eta;
            potential += 0.5 * d * eta * eta;
        }
        printf("H/h %g: c %.6f, volume %.6f, 3 V/((c^2 - 1) M) - 1 = %.1e\n", height, c, volume,
               3 * potential / ((c * c - 1) * volume) - 1);
        assert_near(volume, sb_solitary_exact_volume(wave), 1e-6 * volume);
        assert_near(3 * potential, (c * c - 1) * volume, 1e-6 * volume);
        sb_solitary_exact_destroy(wave);
    }
}

/* Series in the height agree with it the better, the lower the wave: errors of the fourth order. */
static void a_low_wave_is_that_of_third_order(void **state)
{
    (void)state;
    double error[2];
    for (int k = 0; k < 2; k++) {
        const double height = k ? 0.05 : 0.1;
        const sb_solitary series = {.height = height, .depth = 1, .gravity = 1};
        sb_solitary_exact *wave = wave_of(height, 1, 1);
        error[k] = 0;
        for (double xi = 0; xi < 10; xi += 0.1) {
            double u, w;
            sb_wave_motion at;
            const double z = 0.7;
            sb_solitary_velocity(&series, xi, z, &u, &w);
            sb_solitary_exact_motion(wave, xi, z, &at);
            error[k] = fmax(error[k],
                            fmax(hypot(u - at.u, w - at.w), fabs(at.elevation - sb_solitary_elevation(&series, xi))));
        }
        sb_solitary_exact_destroy(wave);
    }
    printf("third order: error %.1e at H/h = 0.1, %.1e at 0.05\n", error[0], error[1]);
    assert_true(error[0] < 10 * pow(0.1, 4));
    assert_true(error[1] < error[0] / 12);
}

static void units_scale(void **state)
{
    (void)state;
    sb_solitary_exact *one = wave_of(0.4, 1, 1), *other = wave_of(1.2, 3, 9.81);
    const double speed = sqrt(3 * 9.81);
    sb_wave_motion a, b;
    for (double xi = -2; xi <= 2; xi += 0.5) {
        sb_solitary_exact_motion(one, xi, 0.8, &a);
        sb_solitary_exact_motion(other, 3 * xi, 2.4, &b);
        assert_near(b.elevation, 3 * a.elevation, 1e-9);
        assert_near(b.u, speed * a.u, 1e-9);
        assert_near(b.w, speed * a.w, 1e-9);
        assert_near(b.u_rate, 9.81 * a.u_rate, 1e-9);
        assert_near(b.w_rate, 9.81 * a.w_rate, 1e-9);
    }
    assert_near(sb_solitary_exact_celerity(other), speed * sb_solitary_exact_celerity(one), 1e-9);
    sb_solitary_exact_destroy(one);
    sb_solitary_exact_destroy(other);
}

/* The crest has the height; above the surface, and far away. */
static void crest_and_limits(void **state)
{
    (void)state;
    sb_solitary_exact *wave = wave_of(0.5, 1, 9.81);
    sb_wave_motion top, above;
    assert_near(sb_solitary_exact_elevation(wave, 0), 0.5, 1e-10);
    assert_true(sb_solitary_exact_elevation(wave, 1e6) == 0);
    sb_solitary_exact_motion(wave, 0.3, 1 + sb_solitary_exact_elevation(wave, 0.3), &top);
    sb_solitary_exact_motion(wave, 0.3, 5, &above);
    assert_near(above.u, top.u, 1e-12);
    sb_solitary_exact_motion(wave, -1e6, 0.5, &above);
    assert_true(above.u == 0 && above.w == 0 && above.u_rate == 0);
    sb_solitary_exact_destroy(wave);
}

static void heights_without_a_wave_are_refused(void **state)
{
    (void)state;
    static const double heights[] = {0.75, 1e-4, -1, NAN};
    for (size_t k = 0; k < sizeof heights / sizeof *heights; k++) {
        sb_solitary_exact *wave = NULL;
        sb_error error = {0};
        assert_int_equal(sb_solitary_exact_create(heights[k], 1, 9.81, &wave, &error), SB_BAD_INPUT);
        assert_non_null(strstr(error.text, "expected a height from 0.001 to 0.7 m"));
        assert_null(wave);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_laws_hold),
        cmocka_unit_test(potential_energy_follows_from_volume),
        cmocka_unit_test(a_low_wave_is_that_of_third_order),
        cmocka_unit_test(units_scale),
        cmocka_unit_test(crest_and_limits),
        cmocka_unit_test(heights_without_a_wave_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
