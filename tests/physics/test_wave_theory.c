/* Closed-form waves against the laws they come from. */
#include "../check.h"
#include "physics/wave_theory.h"

static const sb_solitary boussinesq = {.height = 0.3, .depth = 1, .gravity = 9.81};
static const sb_solitary rayleigh = {.height = 0.3, .depth = 1, .gravity = 9.81, .rayleigh = 1};

static void solitary_constants(void **state)
{
    (void)state;
    assert_near(sb_solitary_wavenumber(&boussinesq), 0.47434, 5e-6);
    assert_near(sb_solitary_celerity(&boussinesq), 3.57113, 5e-6);
    assert_near(sb_solitary_wavenumber(&rayleigh), 0.47434 / sqrt(1.3), 5e-6);
    assert_near(sb_solitary_celerity(&rayleigh), 3.57113, 5e-6);
}

static void solitary_profile(void **state)
{
    (void)state;
    assert_near(sb_solitary_elevation(&boussinesq, 0), 0.3, 1e-15);
    double half = acosh(sqrt(2)) / sb_solitary_wavenumber(&boussinesq);
    assert_near(sb_solitary_elevation(&boussinesq, half), 0.15, 1e-12);
    assert_near(sb_solitary_elevation(&boussinesq, -half), 0.15, 1e-12);
    assert_true(sb_solitary_elevation(&boussinesq, 1e6) == 0);
}

/* The water above the still level: 2H/kappa per metre of crest. */
static void solitary_volume(void **state)
{
    (void)state;
    double sum = 0, step = 0.01;
    for (int i = -10000; i <= 10000; i++) sum += sb_solitary_elevation(&rayleigh, i * step) * step;
    assert_near(sum, 2 * 0.3 / sb_solitary_wavenumber(&rayleigh), 1e-9);
}

static void check_continuity(const sb_solitary *wave)
{
    const double d = 1e-5;
    for (double xi = -6; xi <= 6; xi += 0.37) {
        double top = wave->depth + sb_solitary_elevation(wave, xi);
        for (double z = 0.05; z < top; z += 0.2) {
            double u_ahead, u_behind, w_above, w_below, unused;
            sb_solitary_velocity(wave, xi + d, z, &u_ahead, &unused);
            sb_solitary_velocity(wave, xi - d, z, &u_behind, &unused);
            sb_solitary_velocity(wave, xi, z + d, &unused, &w_above);
            sb_solitary_velocity(wave, xi, z - d, &unused, &w_below);
            assert_near((u_ahead - u_behind + w_above - w_below) / (2 * d), 0, 1e-8);
        }
    }
}

static void solitary_flow_keeps_its_volume(void **state)
{
    (void)state;
    check_continuity(&boussinesq);
    check_continuity(&rayleigh);
}

/* On the surface of a wave of constant form, w = (u - C) d eta/d xi. */
static void solitary_surface_moves_with_the_water(void **state)
{
    (void)state;
    const double d = 1e-5, celerity = sb_solitary_celerity(&boussinesq);
    for (double xi = -5; xi <= 5; xi += 0.41) {
        double u, w;
        double slope = (sb_solitary_elevation(&boussinesq, xi + d) -
                        sb_solitary_elevation(&boussinesq, xi - d)) /
                       (2 * d);
        sb_solitary_velocity(&boussinesq, xi, 1 + sb_solitary_elevation(&boussinesq, xi), &u, &w);
        assert_near(w, (u - celerity) * slope, 1e-8);
    }
}

static void solitary_crest_speed(void **state)
{
    (void)state;
    double u, w;
    sb_solitary_velocity(&boussinesq, 0, 0.5, &u, &w);
    assert_near(u, 3.57113 * 0.3 / 1.3, 1e-5);
    assert_true(w == 0);
    sb_solitary_velocity(&boussinesq, 1, 0.5, &u, &w);
    assert_true(w > 0);
    sb_solitary_velocity(&boussinesq, 1, 0, &u, &w);
    assert_true(w == 0);
}

static void standing_wave(void **state)
{
    (void)state;
    assert_near(sb_standing_elevation(0.1, 4, 0), 0.1, 1e-15);
    assert_near(sb_standing_elevation(0.1, 4, 2), -0.1, 1e-15);
    assert_near(sb_standing_elevation(0.1, 4, 1), 0, 1e-15);
    /* Deep water: T = sqrt(2 pi L/g); shallow: T = L/sqrt(g h). */
    assert_near(sb_standing_period(2, 10, 9.81), sqrt(2 * M_PI * 2 / 9.81), 1e-9);
    assert_near(sb_standing_period(1000, 1, 9.81), 1000 / sqrt(9.81), 5e-3);
    /* L = 2 m on h = 1 m: omega^2 = pi g tanh(pi). */
    assert_near(sb_standing_period(2, 1, 9.81), 1.13392, 5e-6);
}

static void keulegan_damping(void **state)
{
    (void)state;
    assert_near(sb_keulegan_height(0.3, 1, 1e-6, 9.81, 0), 0.3, 1e-15);
    assert_near(sb_keulegan_height(0.3, 1, 0, 9.81, 100), 0.3, 1e-15);
    double damped = sb_keulegan_height(0.02, 0.2, 1e-6, 9.81, 30);
    double expected = pow(0.1, -0.25) + 0.0836 * sqrt(1e-6 / (sqrt(9.81) * sqrt(0.008))) * 150;
    assert_near(pow(damped / 0.2, -0.25), expected, 1e-12);
    assert_true(damped < 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solitary_constants),
        cmocka_unit_test(solitary_profile),
        cmocka_unit_test(solitary_volume),
        cmocka_unit_test(solitary_flow_keeps_its_volume),
        cmocka_unit_test(solitary_surface_moves_with_the_water),
        cmocka_unit_test(solitary_crest_speed),
        cmocka_unit_test(standing_wave),
        cmocka_unit_test(keulegan_damping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
