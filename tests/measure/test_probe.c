/* Probes are exact for fields that vary linearly, also at walls and surfaces. */
#include "fake_sim.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static sb_vec3 flow(sb_vec3 p)
{
    return sb_vec(1 + 0.3 * p.x - 0.2 * p.z, 0.5 * p.y, -0.1 + 0.25 * p.z + 0.05 * p.x);
}

static void set_flow(sb_sim *sim)
{
    for (size_t i = 0; i < sim->report.fluid_count; i++)
        sim->samples[i].velocity = flow(sim->samples[i].position);
}

static void read_probe(fake_world *world, sb_vec3 at, double radius, sb_vec3 *velocity, double *p)
{
    sb_sight sight = fake_sight(world);
    sb_probe probe = {"p", at, radius};
    sb_error error = {0};
    assert_int_equal(sb_probe_read(&sight, &probe, velocity, p, &error), SB_OK);
}

static void check_linear(int dimensions, double jitter)
{
    fake_world world;
    fake_world_make(&world, dimensions, 0.5, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(8, 8, 6), 0, 0, jitter, 7);
    set_flow(&world.sim);
    double y = dimensions == 2 ? 0 : 4.03;
    const sb_vec3 places[] = {{4.1, y, 3.3}, {0, y, 3}, {3.1, y, 0}, {5, y, 5.9}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        sb_vec3 v, expected = flow(places[i]);
        double p;
        read_probe(&world, places[i], i == 0 ? 1.3 : 0, &v, &p);
        assert_true(sb_norm(sb_sub(v, expected)) < 1e-9);
        double depth = 6 - places[i].z;
        /* The surface cuts pressure off at 0, so that only below it is the field linear. */
        assert_true(fabs(p - 9810 * depth) < (i == 3 ? 0.1 * 9810 : 1e-6 * 9810));
    }
    fake_world_free(&world);
}

static void linear_fields_are_exact(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        check_linear(dimensions, 0);
        check_linear(dimensions, 0.1);
    }
}

static void one_layer_falls_back_to_the_mean(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, 0), sb_vec(8, 8, 8));
    for (double x = 0.5; x < 8; x++)
        for (double y = 0.5; y < 8; y++)
            fake_add(&world.sim, sb_vec(x, y, 0.5), sb_vec(2, 0, 0), 0.5 * 9810);
    sb_vec3 v;
    double p;
    read_probe(&world, sb_vec(4, 4, 0), 0, &v, &p);
    assert_true(fabs(v.x - 2) < 1e-12 && fabs(v.y) < 1e-12);
    assert_true(fabs(p - 9810) < 1e-6); /* carried down half a spacing by rho g */
    fake_world_free(&world);
}

static void dry_is_nan(void **state)
{
    (void)state;
    fake_world world;
    fake_world_make(&world, 3, 1, sb_vec(0, 0, 0), sb_vec(12, 12, 12));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(12, 12, 6), 0, 0, 0, 1);
    sb_vec3 v;
    double p;
    read_probe(&world, sb_vec(6, 6, 7.7), 0, &v, &p);
    assert_true(isnan(p) && isnan(v.x) && isnan(v.y) && isnan(v.z));
    fake_add(&world.sim, sb_vec(6, 6, 10), sb_vec(1, 1, 1), 0);
    read_probe(&world, sb_vec(6, 6, 10), 0, &v, &p); /* one drop */
    assert_true(isnan(p));
    fake_world_free(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_fields_are_exact),
        cmocka_unit_test(one_layer_falls_back_to_the_mean),
        cmocka_unit_test(dry_is_nan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
