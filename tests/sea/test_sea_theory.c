/* Given water from wave theory: places, directions, growth, bounds. */
#include "physics/waves/solitary_exact.h"
#include "physics/waves/wave_theory.h"
#include "sea_scene.h"

static const double g = 9.81;

static void still_water_without_a_block(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_FLAT, "source: none", NULL);
    const sb_sea_point at = sea_at(&c, 5, 0, 0, 0.5);
    assert_near(at.surface, 1, 0);
    assert_true(at.velocity[0] == 0 && at.acceleration[2] == 0);
    assert_near(sb_sea_greatest_surface(c.sea), 1, 0);
    assert_near(sb_sea_greatest_speed(c.sea), 0, 0);
    assert_null(sb_sea_warning(c.sea));
    sea_free(&c);
}

/* The front of the wave is at the side at the start; all of it passes with the theory's shape. */
static void a_solitary_wave_enters(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_FLAT, "source: theory, wave: solitary, height: 0.3, depth: 1, theory: third-order, start: 2",
             NULL);
    const sb_solitary wave = {.height = 0.3, .depth = 1, .gravity = g};
    const double speed = sb_solitary_celerity(&wave);
    assert_near(sea_at(&c, 2, 0, 0, 0.5).surface - 1, 0.3e-4, 1e-9);
    for (double t = 0; t < 2; t += 0.1) { /* it has no ramp: its front comes before */
        const sb_sea_point before = sea_at(&c, t, 0, 0, 0.5);
        assert_true(before.surface >= 1 && before.surface < 1 + 0.3e-4);
        assert_true(fabs(before.velocity[0]) < 1e-3 && fabs(before.acceleration[0]) < 1e-3);
    }
    double highest = 0, when = 0, volume = 0;
    for (double t = 2; t < 12; t += 0.001) {
        const sb_sea_point at = sea_at(&c, t, 0, 0, 0.5);
        if (at.surface > highest) {
            highest = at.surface;
            when = t;
        }
        volume += (at.surface - 1) * speed * 0.001;
    }
    assert_near(highest, 1.3, 1e-5);
    double whole = 0;
    for (int i = -20000; i <= 20000; i++) whole += sb_solitary_elevation(&wave, i * 1e-3) * 1e-3;
    assert_near(volume / whole, 1, 1e-4);
    double u, w;
    sb_solitary_velocity(&wave, -0.7, 0.4, &u, &w);
    const sb_sea_point at = sea_at(&c, when + 0.7 / speed, 0, 0, 0.4);
    assert_near(at.velocity[0], u, 2e-3);
    assert_near(at.velocity[2], w, 2e-3);
    const sb_sea_point later = sea_at(&c, when + 3 / speed, 3, 0, 0.4), crest = sea_at(&c, when, 0, 0, 0.4);
    assert_near(later.surface, crest.surface, 1e-12);
    assert_true(sb_sea_greatest_speed(c.sea) >= sea_at(&c, when, 0, 0, 9).velocity[0] - 1e-12);
    assert_near(sb_sea_greatest_surface(c.sea), 1.3, 1e-12);
    assert_non_null(strstr(sb_sea_about(c.sea), "solitary"));
    sea_free(&c);
}

static void accelerations_are_rates(const sea_case *c, double x, double y, double tolerance)
{
    for (double t = 0.3; t < 9; t += 0.37)
        for (double z = 0.05; z < 0.95; z += 0.3) {
            const double d = 1e-4;
            const sb_sea_point at = sea_at(c, t, x, y, z), before = sea_at(c, t - d, x, y, z),
                               after = sea_at(c, t + d, x, y, z);
            for (int axis = 0; axis < 3; axis++)
                assert_near((after.velocity[axis] - before.velocity[axis]) / (2 * d), at.acceleration[axis], tolerance);
        }
}

/* The exact wave passes the side with its celerity and volume. The flux through it is that of a wave of permanent form,
   which that of third order misses by 12 % at this height. */
static void an_exact_solitary_wave_enters(void **state)
{
    (void)state;
    sea_case c;
    sb_error error = {0};
    sb_solitary_exact *wave = NULL;
    sea_make(&c, SEA_FLAT, "source: theory, wave: solitary, height: 0.5, depth: 1", NULL);
    assert_int_equal(sb_solitary_exact_create(0.5, 1, g, &wave, &error), SB_OK);
    assert_null(sb_sea_warning(c.sea));
    assert_near(sea_at(&c, 0, 0, 0, 0.5).surface - 1, 0.5e-4, 1e-9);
    const double speed = sb_solitary_exact_celerity(wave);
    double inflow = 0, off = 0;
    for (double t = 0; t < 12; t += 0.01) {
        const double surface = sea_at(&c, t, 0, 0, 0).surface;
        double flux = 0;
        for (int k = 0; k < 40; k++) flux += sea_at(&c, t, 0, 0, (k + 0.5) / 40 * surface).velocity[0] * surface / 40;
        off = fmax(off, fabs(flux - speed * (surface - 1)));
        inflow += flux * 0.01;
    }
    assert_true(off < 1e-3);
    assert_near(inflow, sb_solitary_exact_volume(wave), 1e-3);
    accelerations_are_rates(&c, 1, 0, 1e-4);
    sb_solitary_exact_destroy(wave);
    sea_free(&c);
}

/* Regular waves grow in two periods, and then repeat. Towards -x they start at the other side. */
static void regular_waves_grow_and_repeat(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_FLAT, "source: theory, wave: regular, height: 0.1, period: 2, depth: 1, direction: 180, start: 1",
             NULL);
    assert_near(sea_at(&c, 1, 10, 0, 0.5).surface, 1, 0);
    assert_near(sea_at(&c, 0.5, 10, 0, 0.5).velocity[0], 0, 0);
    const sb_sea_point crest = sea_at(&c, 7, 10, 0, 1.2), again = sea_at(&c, 1 + 200, 10, 0, 1.2);
    assert_near(crest.surface, sb_sea_greatest_surface(c.sea), 1e-12);
    assert_near(again.surface, crest.surface, 1e-12);
    assert_true(crest.velocity[0] < 0);
    assert_true(sb_sea_greatest_speed(c.sea) >= -crest.velocity[0] - 1e-12);
    /* The surface moves with the water while the wave grows, up to a quarter of ka, because the second
       harmonic grows as the first does: f(1 - f) <= 1/4. */
    for (double t = 1.2; t < 6; t += 0.21) {
        const double d = 1e-4,
                     rise = (sea_at(&c, t + d, 9, 0, 0).surface - sea_at(&c, t - d, 9, 0, 0).surface) / (2 * d);
        const double slope = (sea_at(&c, t, 9 + d, 0, 0).surface - sea_at(&c, t, 9 - d, 0, 0).surface) / (2 * d);
        const sb_sea_point at = sea_at(&c, t, 9, 0, 9);
        assert_near(rise + at.velocity[0] * slope, at.velocity[2], 0.25 * (2 * M_PI / 5.2 * 0.05) * 0.05 * M_PI);
    }
    sea_free(&c);
}

static void directions_and_components(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_SPACE,
             "source: theory, wave: components, depth: 1, ramp: 0, origin: [1, 2], components: [{amplitude: 0.02, "
             "period: 3, "
             "direction: 30, phase: 90}, {amplitude: 0.01, period: 1.7, direction: -60}]",
             NULL);
    /* The phase of 90 degrees is a node, which rises when the wave comes from behind: cos(kx - wt + 90) = sin(wt - kx).
     */
    assert_near(sea_at(&c, 0, 1, 2, 0).surface, 1.01, 1e-12);
    accelerations_are_rates(&c, 3, 4, 1e-6);
    assert_near(sb_sea_greatest_surface(c.sea), 1.03, 1e-12);
    sea_free(&c);
    sea_make(&c, SEA_SPACE, "source: theory, wave: solitary, height: 0.2, depth: 1, theory: third-order, direction: 30",
             NULL);
    const sb_sea_point at = sea_at(&c, 3, 1, 2, 0.5);
    assert_near(at.velocity[1] / at.velocity[0], tan(M_PI / 6), 1e-12);
    /* Along a crest the water is the same. */
    const sb_sea_point beside = sea_at(&c, 3, 1 - sin(M_PI / 6), 2 + cos(M_PI / 6), 0.5);
    assert_near(beside.surface, at.surface, 1e-12);
    accelerations_are_rates(&c, 1, 2, 1e-5);
    sea_free(&c);
    /* A cnoidal wave over a bed that is higher than the theory's: no water crosses the bed. */
    sea_make(&c, SEA_FLAT, "source: theory, wave: regular, height: 0.2, period: 9, depth: 1, ramp: 0", NULL);
    accelerations_are_rates(&c, 1, 0, 1e-5);
    sb_sea_point shallow;
    sb_sea_at(c.sea, 4.1, 0, 0, 0.4, 0.4, &shallow);
    assert_near(shallow.velocity[2], 0, 1e-12);
    sb_sea_at(c.sea, 4.1, 0, 0, 1.5, 1.4, &shallow); /* land */
    assert_true(shallow.surface < 1.4 && isfinite(shallow.velocity[0]) && shallow.velocity[2] == 0);
    sea_free(&c);
}

static void refusals(void **state)
{
    (void)state;
    sea_refused(SEA_FLAT, "source: theory, wave: solitary, height: 0.9, depth: 1", NULL, "sea.height: 0.9 m");
    sea_refused(SEA_FLAT, "source: theory, wave: solitary, height: 0.75, depth: 1", NULL,
                "expected metres from 0.001 to 0.7");
    sea_refused(SEA_FLAT, "source: theory, wave: regular, height: 0.9, period: 2, depth: 1", NULL, "breaks");
    sea_refused(SEA_FLAT, "source: theory, wave: regular, height: 0.3, period: 9, depth: 1, order: second-order", NULL,
                "cnoidal");
    sea_refused(SEA_FLAT, "source: theory, wave: solitary, height: 0.3, depth: 1, direction: 20", NULL, "0 or 180");
    sea_refused(SEA_FLAT, "source: theory, wave: components, depth: 1", NULL, "at least one");
    sea_refused(
        SEA_FLAT,
        "source: theory, wave: components, depth: 1, components: [{amplitude: 0.1, period: 3}, {amplitude: 0.3, "
        "period: 1}]",
        NULL,
        "sea.components: item 1 with an amplitude of 0.3 m and a period of 1 s on 1 m breaks, expected an "
        "amplitude of at most 0.11 m");
    sea_refused(
        SEA_FLAT,
        "source: theory, wave: components, depth: 1, components: [{amplitude: 0.2, period: 2}, {amplitude: 0.19, "
        "period: 1.9}]",
        NULL, "sea.components: the waves together have a significant height of 0.78 m and break");
    sea_refused(SEA_FLAT, "source: theory, wave: components, depth: 1, components: [{amplitude: 1.01, period: 44700}]",
                NULL, "uncovers the bed, expected an amplitude of at most 1 m");
    sea_refused(SEA_FLAT, "source: theory, wave: solitary, height: 1.3, depth: 2", NULL, "above the domain");
    sea_refused(SEA_FLAT, "source: theory, wave: solitary, height: 0.3, depth: 1, level: 3", NULL, "sea.level: 3 m");
    sea_refused(SEA_FLAT, "source: theory, wave: solitary, height: 0.3, depth: 1, period: 3", NULL, "does not apply");
}

/* A tide is a slow change of the level, which may be higher than any wave of constant form. */
static void tides_may_be_high(void **state)
{
    (void)state;
    sea_case c;
    sea_make(
        &c, SEA_FLAT,
        "source: theory, wave: components, depth: 1, components: [{amplitude: 0.6, period: 44700}, {amplitude: 0.1, "
        "period: 3}]",
        NULL);
    sea_free(&c);
}

static void long_linear_waves_give_a_warning(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_FLAT, "source: theory, wave: regular, order: linear, height: 0.6, period: 20, depth: 1", NULL);
    assert_non_null(sb_sea_warning(c.sea));
    if (!strstr(sb_sea_warning(c.sea), "expected order: auto, which gives cnoidal waves"))
        fail_msg("%s", sb_sea_warning(c.sea));
    sea_free(&c);
    sea_make(&c, SEA_FLAT, "source: theory, wave: regular, order: linear, height: 0.01, period: 4, depth: 1", NULL);
    assert_null(sb_sea_warning(c.sea));
    sea_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(still_water_without_a_block),
        cmocka_unit_test(a_solitary_wave_enters),
        cmocka_unit_test(an_exact_solitary_wave_enters),
        cmocka_unit_test(regular_waves_grow_and_repeat),
        cmocka_unit_test(directions_and_components),
        cmocka_unit_test(refusals),
        cmocka_unit_test(tides_may_be_high),
        cmocka_unit_test(long_linear_waves_give_a_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
