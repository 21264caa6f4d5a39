/* Closed-form waves compared with the laws that they are derived from. */
#include "../check.h"
#include "physics/waves/wave_theory.h"

static sb_solitary wave_of(double height)
{
    return (sb_solitary){.height = height, .depth = 1, .gravity = 9.81};
}

static void solitary_celerity(void **state)
{
    (void)state;
    const sb_solitary high = wave_of(0.3), low = wave_of(1e-4), deep = {.height = 3, .depth = 10, .gravity = 9.81};
    assert_near(sb_solitary_celerity(&high) / sqrt(9.81), 1.1377, 5e-5);
    assert_near(sb_solitary_celerity(&low), sqrt(9.81 * 1.0001), 1e-6);
    assert_near(sb_solitary_celerity(&deep), sqrt(10) * sb_solitary_celerity(&high), 1e-12);
}

static void solitary_profile(void **state)
{
    (void)state;
    const sb_solitary high = wave_of(0.3), low = wave_of(1e-4);
    assert_near(sb_solitary_elevation(&high, 0), 0.3, 1e-15);
    assert_near(sb_solitary_elevation(&high, 1), sb_solitary_elevation(&high, -1), 1e-15);
    assert_true(sb_solitary_elevation(&high, 1e6) == 0);
    /* The half width of a low wave is Boussinesq's [S16, eq. 43]. */
    const double half = acosh(sqrt(2)) / sqrt(0.75e-4);
    assert_near(sb_solitary_elevation(&low, half) / 0.5e-4, 1, 1e-3);
}

/* The volume of water above the still-water level per metre of crest is (16 e/3)^(1/2) (1 + 3 e/8) [Longuet-Higgins &
   Fenton 1974, first terms of the series]; the actual volume is 2 % larger at e = 0.3. */
static void solitary_volume(void **state)
{
    (void)state;
    const sb_solitary wave = wave_of(0.1);
    double sum = 0;
    for (int i = -10000; i <= 10000; i++) sum += sb_solitary_elevation(&wave, i * 0.01) * 0.01;
    assert_near(sum, sqrt(1.6 / 3) * (1 + 0.3 / 8), 0.005);
}

/* The largest violation of the conservation laws by a wave of constant form in inviscid water, in units of sqrt(gh) and
   h: of volume within the water, of the flux through its surface, and of energy on its surface. */
typedef struct violation {
    double volume, through, energy;
} violation;

static violation violation_of(double height, sb_solitary_theory theory)
{
    const double d = 1e-4;
    const sb_solitary wave = {.height = height, .depth = 1, .gravity = 1, .theory = theory};
    const double celerity = sb_solitary_celerity(&wave);
    violation b = {0};
    for (double xi = -8; xi <= 8; xi += 0.11) {
        double ahead, behind, above, below, u, w, unused;
        for (double z = 0.05; z < 1; z += 0.19) {
            sb_solitary_velocity(&wave, xi + d, z, &ahead, &unused);
            sb_solitary_velocity(&wave, xi - d, z, &behind, &unused);
            sb_solitary_velocity(&wave, xi, z + d, &unused, &above);
            sb_solitary_velocity(&wave, xi, z - d, &unused, &below);
            b.volume = fmax(b.volume, fabs(ahead - behind + above - below) / (2 * d));
        }
        const double eta = sb_solitary_elevation(&wave, xi);
        const double slope = (sb_solitary_elevation(&wave, xi + d) - sb_solitary_elevation(&wave, xi - d)) / (2 * d);
        sb_solitary_velocity(&wave, xi, 1 + eta, &u, &w);
        b.through = fmax(b.through, fabs(w - (u - celerity) * slope));
        b.energy =
            fmax(b.energy, fabs(eta + (u - celerity) * (u - celerity) / 2 + w * w / 2 - celerity * celerity / 2));
    }
    return b;
}

/* Boussinesq's wave [S16, eqs. 42 to 44] conserves volume, and has no flux through its surface, up to rounding errors.
   It does not conserve energy. */
static void boussinesqs_wave(void **state)
{
    (void)state;
    const sb_solitary wave = {.height = 0.3, .depth = 1, .gravity = 9.81, .theory = SB_SOLITARY_BOUSSINESQ};
    assert_near(sb_solitary_celerity(&wave), 3.57113, 5e-6);
    assert_near(sb_solitary_elevation(&wave, 0), 0.3, 1e-15);
    assert_near(sb_solitary_elevation(&wave, acosh(sqrt(2)) / 0.474341649), 0.15, 1e-9);
    double u, w;
    sb_solitary_velocity(&wave, 0, 0.5, &u, &w);
    assert_near(u, 3.57113 * 0.3 / 1.3, 1e-5);
    const violation b = violation_of(0.3, SB_SOLITARY_BOUSSINESQ), third = violation_of(0.3, SB_SOLITARY_THIRD_ORDER);
    assert_true(b.volume < 1e-7 && b.through < 1e-7 && b.energy > 2 * third.energy);
}

/* Serre's wave [Serre 1953]: the same celerity, wider by sqrt(1 + e); it conserves volume. */
static void serres_wave(void **state)
{
    (void)state;
    const sb_solitary wave = {.height = 0.5, .depth = 1, .gravity = 9.81, .theory = SB_SOLITARY_SERRE};
    assert_near(sb_solitary_celerity(&wave), sqrt(9.81 * 1.5), 1e-12);
    assert_near(sb_solitary_elevation(&wave, acosh(sqrt(2)) / 0.5), 0.25, 1e-12); /* k^2 = 3 e / (4 (1 + e)) */
    const violation b = violation_of(0.5, SB_SOLITARY_SERRE);
    assert_true(b.volume < 1e-7 && b.through < 1e-7);
}

/* The energy error of a first-order wave is proportional to the square of its height. All errors of the third-order
   wave are proportional to the fourth power. */
static void solitary_wave_conserves_volume_and_energy_to_third_order(void **state)
{
    (void)state;
    const violation high = violation_of(0.2, SB_SOLITARY_THIRD_ORDER), low = violation_of(0.1, SB_SOLITARY_THIRD_ORDER);
    assert_true(high.volume < 1.4e-3 && high.through < 1.7e-3 && high.energy < 3.5e-3);
    assert_true(low.volume < high.volume / 14 && low.through < high.through / 14 && low.energy < high.energy / 14);
}

static void solitary_bed_and_crest(void **state)
{
    (void)state;
    const sb_solitary wave = wave_of(0.3);
    double u, w;
    sb_solitary_velocity(&wave, 0, 0.5, &u, &w);
    assert_true(u > 0 && w == 0);
    sb_solitary_velocity(&wave, 1, 0.5, &u, &w);
    assert_true(w > 0);
    sb_solitary_velocity(&wave, 1, 0, &u, &w);
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
        cmocka_unit_test(solitary_celerity),
        cmocka_unit_test(solitary_profile),
        cmocka_unit_test(solitary_volume),
        cmocka_unit_test(solitary_wave_conserves_volume_and_energy_to_third_order),
        cmocka_unit_test(boussinesqs_wave),
        cmocka_unit_test(serres_wave),
        cmocka_unit_test(solitary_bed_and_crest),
        cmocka_unit_test(standing_wave),
        cmocka_unit_test(keulegan_damping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
