/* Gravity, viscosity and wall friction of one step compared with the reference, and the decay of a shear flow. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/step/stages.h"
#include "sim/tank.h"
#include "sim/twin.h"

#include <stdio.h>

typedef struct setup {
    tank tank;
    sb_sim *sim;
    twin twin; /* with the velocities at the step's start */
    sb_vec3 *expected;
    double *rho;
} setup;

/* A jittered dam break with random velocities between walls, one of which moves. The step is 1 s, so that the floats
   resolve the accelerations and not only the velocities. */
static void begin(setup *s, int dimensions, double alpha, double sigma, double nu)
{
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 0.9, .gravity = 9.81};
    bool flat = dimensions == 2;
    tank_of_particles(&s->tank, dimensions, 0.1, sb_vec(2, flat ? 0 : 0.7, 1.5), 1.2, 0.9, 0.2);
    tank_add_plate(&s->tank, "paddle", -0.05, 0, 1.2, sb_vec(1, 0, 0), &law);
    s->tank.scene.numerics.artificial_viscosity = alpha;
    s->tank.scene.numerics.wall_friction = sigma;
    s->tank.scene.fluid.viscosity = nu;
    sb_model *m = &s->tank.model;
    /* The reference has no contact resolution; without normals there is no wall shear, which test_wall_shear.c
       compares. */
    tank_stop_contact(&s->tank);
    sb_free(m->wall_normal);
    m->wall_normal = NULL;
    for (size_t i = 0; i < m->fluid_count; i++)
        m->fluid_velocity[i] = sb_vec(2 * sb_random(3, 3 * i) - 1, flat ? 0 : 2 * sb_random(3, 3 * i + 1) - 1,
                                      2 * sb_random(3, 3 * i + 2) - 1);
    s->sim = tank_sim(&s->tank);
    assert_non_null(s->sim);
    assert_int_equal(tank_prepare(s->sim, 1), 0);
    assert_true(s->sim->walls.moving[0].velocity.x > 0.3);
    assert_int_equal(twin_make(s->sim, &s->twin), 0);
    s->expected = sb_alloc(s->sim->state.n, sizeof *s->expected);
    s->rho = sb_alloc(s->sim->state.n, sizeof *s->rho);
    assert_true(s->expected && s->rho);
    sb_reference_density(&s->twin.reference, s->rho);
}

static void end(setup *s)
{
    sb_free(s->expected);
    sb_free(s->rho);
    twin_free(&s->twin);
    sb_sim_destroy(s->sim);
    tank_free(&s->tank);
}

static void check(int dimensions, double alpha, double sigma, double nu)
{
    setup s;
    begin(&s, dimensions, alpha, sigma, nu);
    const sb_sim *sim = s.sim;
    sb_reference_viscosity(&s.twin.reference, s.rho, s.expected);
    sb_reference_friction(&s.twin.reference, s.rho, s.expected, NULL, NULL, NULL);
    sb_reference_unswitched(&s.twin.reference, s.rho, nu, NULL, s.expected);
    sb_error error = {0};
    assert_int_equal(sb_stage_forces(s.sim, &error), SB_OK);
    twin_gap gap = {0};
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_f4 v = sim->work.predicted[i];
        sb_vec3 start = s.twin.velocity[i], a = s.expected[i];
        twin_compare(&gap, i, (double)v[0] - start.x, a.x);
        twin_compare(&gap, i, (double)v[1] - start.y, a.y);
        twin_compare(&gap, i, (double)v[2] - start.z, a.z - 9.81);
        assert_true(v[3] == (float)s.tank.model.fluid_pressure[sim->state.id[i]]);
    }
    printf("%dD alpha %g, sigma %g, nu %g: worst %.2g of the largest, %.3g m/s^2\n", dimensions, alpha, sigma, nu,
           twin_relative(&gap), gap.scale);
    assert_true(gap.scale > 9 && twin_relative(&gap) < 1e-6);
    end(&s);
}

static void each_term_and_all_together(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        check(dimensions, 0, 0, 0);
        check(dimensions, 1, 0, 0);
        check(dimensions, 0, 3, 0);
        check(dimensions, 0, 0, 0.1);
        check(dimensions, 0.5, 1, 0.05);
    }
}

/* Forces on bodies compared with the reference, for the same velocities and q. */
static void forces_on_bodies_are_the_reference(void **state)
{
    (void)state;
    setup s;
    begin(&s, 3, 0.5, 2, 0);
    sb_sim *sim = s.sim;
    sb_error error = {0};
    double *q = sb_alloc(sim->state.n, sizeof *q);
    assert_non_null(q);
    assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
    for (size_t i = 0; i < sim->state.n; i++) {
        sim->work.unknown[i] = (float)(0.01 * sb_random(8, i));
        q[i] = (double)sim->work.unknown[i];
    }
    assert_int_equal(sb_stage_impulse(sim, &error), SB_OK);
    const sb_vec3 center[2] = {sim->model->bodies[0].moment_point, sim->model->bodies[1].moment_point};
    sb_vec3 force[2] = {0}, torque[2] = {0}, drag[2] = {0};
    sb_reference_pressure_forces(&s.twin.reference, q, center, force, torque);
    sb_reference_friction(&s.twin.reference, s.rho, s.expected, center, drag, torque);
    for (size_t b = 0; b < 2; b++) {
        const sb_body_impulse *i = sb_sim_impulse(sim, b);
        double gap = sb_norm(sb_sub(i->pressure, force[b])) / sb_norm(force[b]);
        double friction = sb_norm(sb_sub(i->friction, drag[b])) / sb_norm(drag[b]);
        double turn = sb_norm(sb_sub(i->moment, torque[b])) / sb_norm(torque[b]);
        printf("body %zu: pressure %.2g, friction %.2g, moment %.2g of each\n", b, gap, friction, turn);
        assert_true(sb_norm(force[b]) > 1 && sb_norm(drag[b]) > 1);
        assert_true(gap < 1e-6 && friction < 1e-6 && turn < 1e-6);
    }
    sb_free(q);
    end(&s);
}

/* u = z^2 has u'' = 2, and so the physical term gives 2 nu on a lattice, times a fraction that depends on the kernel.
 */
static void check_shear(int dimensions, sb_preset preset)
{
    const double nu = 0.01;
    tank t;
    tank_make(&t, dimensions, 0.1, sb_vec(1.1, 1.1, 1.1), 1.1, 1.1, 0);
    tank_use(&t, preset);
    sb_model *m = &t.model;
    t.scene.numerics.artificial_viscosity = 0;
    t.scene.fluid.viscosity = nu;
    t.scene.fluid.gravity = 0;
    for (size_t i = 0; i < m->fluid_count; i++) {
        double z = m->fluid_position[i].z;
        m->fluid_velocity[i] = sb_vec(100 * z * z, 0, 0);
    }
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 1), 0);
    sb_error error = {0};
    assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
    const double share = twin_lattice_shear(sim);
    static const double documented[][2] = {{0.875, 0.87}, {0.65, 0.70}}; /* docs/method.md, section 6 */
    assert_near(share, documented[preset][dimensions - 2], 0.005);
    sb_vec3 half = sb_vec(0.55, dimensions == 2 ? 0 : 0.55, 0.55);
    size_t count = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_fluid_sample p = sb_sim_particle(sim, i);
        if (sb_norm(sb_sub(p.position, half)) > 0.12) continue;
        double z = p.position.z, after = (double)sim->work.predicted[i][0];
        double decay = (after - 100 * z * z) / (200 * nu);
        assert_near(decay, share, 2e-4); /* the roots of slopes have 15 bits: 1.4e-4 at most */
        count++;
    }
    printf("%dD, support %g: %zu particles inside decay with the fraction %.4f\n", dimensions, t.scene.numerics.support,
           count, share);
    assert_true(count >= 5);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void shear_decays_as_documented(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        check_shear(dimensions, SB_PRESET_DEFAULT);
        check_shear(dimensions, SB_PRESET_PAPER);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_term_and_all_together),
        cmocka_unit_test(forces_on_bodies_are_the_reference),
        cmocka_unit_test(shear_decays_as_documented),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
