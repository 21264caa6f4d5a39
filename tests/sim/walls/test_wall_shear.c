/* The shear of smooth walls: compared with the reference pair by pair, and as drag on sliding water. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/passes/cpu/drag.h"
#include "sim/step/stages.h"
#include "sim/tank.h"
#include "sim/twin.h"

#include <stdio.h>

static double law(double reynolds)
{
    return (double)sb_wall_laws(sb_splat((float)reynolds))[2];
}

static void the_law_is_that_of_the_smooth_wall(void **state)
{
    (void)state;
    assert_near(law(10), 0.1, 1e-7);
    assert_near(law(1e4), 0.00246, 1e-7);
    /* u+ = y+ = 11.81 where the two laws meet */
    assert_near(law(139.4), 1 / 139.4, 2e-6);
    assert_near(law(139.6), 1 / 139.5, 2e-5);
    /* compared with the logarithmic law u+ = ln(9.8 y+)/0.41 at y+ = 500: u+ 20.7 */
    const double log_law = log(9.8 * 500) / 0.41;
    assert_near(law(500 * log_law) * log_law * log_law, 1, 0.1);
}

/* A jittered dam break with random velocities beside a moving wall, for one long step as in test_explicit_forces.c. */
static void check(int dimensions, double nu)
{
    const sb_wavemaker_parameters motion = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 0.9, .gravity = 9.81};
    const bool flat = dimensions == 2;
    tank t;
    tank_of_particles(&t, dimensions, 0.1, sb_vec(2, flat ? 0 : 0.7, 1.5), 1.2, 0.9, 0.2);
    tank_add_plate(&t, "paddle", -0.05, 0, 1.2, sb_vec(1, 0, 0), &motion);
    /* parallel to the wall and a little behind it, like treads of stairs: each has its own distance */
    tank_add_plate(&t, "lining", -0.09, 0, 1.2, sb_vec(1, 0, 0), NULL);
    t.scene.numerics.artificial_viscosity = 0;
    t.scene.numerics.wall_friction = 0.3;
    t.scene.numerics.wall_shear = SB_SHEAR_SMOOTH;
    t.scene.fluid.viscosity = nu;
    sb_model *m = &t.model;
    for (size_t i = 0; i < m->fluid_count; i++)
        m->fluid_velocity[i] = sb_vec(20 * sb_random(3, 3 * i) - 10, flat ? 0 : 20 * sb_random(3, 3 * i + 1) - 10,
                                      20 * sb_random(3, 3 * i + 2) - 10);
    sb_sim *sim = tank_sim(&t);
    twin other;
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 1), 0);
    assert_int_equal(twin_make(sim, &other), 0);
    sb_vec3 *expected = sb_alloc(sim->state.n, sizeof *expected), *apart = sb_alloc(sim->state.n, sizeof *apart);
    double *rho = sb_alloc(sim->state.n, sizeof *rho);
    assert_true(expected && apart && rho);
    sb_vec3 center[3] = {0}, drag[3] = {0}, torque[3] = {0};
    sb_reference_density(&other.reference, rho);
    sb_reference_friction(&other.reference, rho, expected, center, drag, torque);
    sb_reference_unswitched(&other.reference, rho, nu, NULL, expected);
    sb_reference_shear(&other.reference, nu, t.scene.numerics.wall_offset * t.scene.resolution, apart, center, drag,
                       torque);
    sb_error error = {0};
    assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
    twin_gap gap = {0};
    double sheared = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_f4 v = sim->work.predicted[i];
        const sb_vec3 start = other.velocity[i], a = sb_add(expected[i], apart[i]);
        twin_compare(&gap, i, (double)v[0] - start.x, a.x);
        twin_compare(&gap, i, (double)v[1] - start.y, a.y);
        twin_compare(&gap, i, (double)v[2] - start.z, a.z - 9.81);
        sheared = fmax(sheared, sb_norm(apart[i]));
    }
    assert_int_equal(sb_stage_impulse(sim, &error), SB_OK);
    printf("%dD, nu %g: worst %.2g of the largest, %.3g m/s^2, of which shear %.3g\n", dimensions, nu,
           twin_relative(&gap), gap.scale, sheared);
    assert_true(sheared > 0.5 && twin_relative(&gap) < 2e-6);
    for (size_t b = 0; b < 3; b++)
        assert_true(sb_norm(sb_sub(sb_sim_impulse(sim, b)->friction, drag[b])) < 2e-6 * sb_norm(drag[b]));
    sb_free(expected);
    sb_free(apart);
    sb_free(rho);
    twin_free(&other);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void shear_on_water_and_bodies_is_the_reference(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        check(dimensions, 1e-6);
        check(dimensions, 0.5);
    }
}

/* Water that slides over a floor at 1 m/s loses the momentum rho c u^2 per area, by the law for the first layer's
   distance. */
static void a_floor_slows_sliding_water(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const double spacing = 0.05, length = 1, speed = 1, nu = 1e-6;
        tank t;
        tank_make(&t, dimensions, spacing, sb_vec(length, dimensions == 2 ? 0 : length, 1), length, 0.4, 0);
        tank_repeat(&t, 0);
        if (dimensions == 3) tank_repeat(&t, 1);
        sb_numerics *n = &t.scene.numerics;
        n->kernel = sb_kernel_find("wendland-c2");
        n->support = 3;
        n->wall_shear = SB_SHEAR_SMOOTH;
        n->artificial_viscosity = 0;
        t.scene.fluid.viscosity = nu;
        for (size_t i = 0; i < t.model.fluid_count; i++) t.model.fluid_velocity[i] = sb_vec(speed, 0, 0);
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        assert_int_equal(tank_steps(sim, 1), 0);
        const double law = 0.0246 * pow(speed * 0.5 * spacing / nu, -0.25);
        const double area = dimensions == 2 ? length : length * length;
        const double force = sb_sim_impulse(sim, 0)->friction.x / sb_sim_report(sim)->time;
        printf("%dD: drag %.4f of the law's\n", dimensions, force / (1000 * law * speed * speed * area));
        assert_near(force / (1000 * law * speed * speed * area), 1, 0.1);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* Wall shear is off by the scene key and in water without viscosity. */
static void it_is_off_without_viscosity(void **state)
{
    (void)state;
    const struct {
        enum sb_wall_shear shear;
        double viscosity;
        bool on;
    } cases[] = {{SB_SHEAR_SMOOTH, 0, false}, {SB_SHEAR_SMOOTH, 1e-6, true}, {SB_SHEAR_NONE, 1e-6, false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        tank t;
        tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0);
        t.scene.numerics.wall_shear = cases[k].shear;
        t.scene.fluid.viscosity = cases[k].viscosity;
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        assert_true(sim->needs.wall_shear == cases[k].on && (sim->work.wall_drag != NULL) == cases[k].on);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_law_is_that_of_the_smooth_wall),
        cmocka_unit_test(shear_on_water_and_bodies_is_the_reference),
        cmocka_unit_test(a_floor_slows_sliding_water),
        cmocka_unit_test(it_is_off_without_viscosity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
