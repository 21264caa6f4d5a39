/* Eddy viscosity of the sub-particle-scale model: compared with the reference, on linear fields, at walls; the effect
   of its stress; and no cost when off. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/step/stages.h"
#include "sim/tank.h"
#include "sim/terms/turbulence.h"
#include "sim/twin.h"

#include <stdio.h>
#include <string.h>

/* Without other viscosities, and so without the walls' shear, the forces are those of the eddy viscosity alone. */
static void turn_on(tank *t)
{
    t->scene.fluid.viscosity = 0;
    t->scene.numerics.turbulence = SB_TURBULENCE_SPS;
    t->scene.numerics.smagorinsky = 0.1;
    t->scene.numerics.artificial_viscosity = 0;
    t->scene.fluid.gravity = 0;
}

static sb_sim *prepared(const tank *t)
{
    sb_sim *sim = tank_sim(t);
    sb_error error = {0};
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 1), 0);
    assert_int_equal(sb_stage_turbulence(sim, &error), SB_OK);
    return sim;
}

/* Water scattered at random beside walls, one of which moves: viscosities and stresses. The step is 1 s, so that the
   floats resolve the accelerations and not only the velocities. */
static void a_random_cloud_is_the_reference(void **state)
{
    (void)state;
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 0.9, .gravity = 9.81};
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        twin copy;
        sb_vec3 size = dimensions == 2 ? sb_vec(2, 0, 2) : sb_vec(1.2, 0.8, 0.8);
        tank_of_particles(&t, dimensions, 0.1, size, size.x, 0.5 * size.z, 0);
        tank_scatter(&t, 5, 1);
        tank_add_plate(&t, "paddle", 0.5, 0, 0.6, sb_vec(1, 0, 0), &law);
        turn_on(&t);
        t.scene.numerics.smagorinsky = 0.5; /* so that walls limit many lengths */
        sb_sim *sim = prepared(&t);
        assert_int_equal(twin_make(sim, &copy), 0);
        double *rho = sb_alloc(sim->state.n, sizeof *rho), *eddy = sb_alloc(sim->state.n, sizeof *eddy);
        sb_vec3 *expected = sb_alloc(sim->state.n, sizeof *expected);
        assert_true(rho && eddy && expected);
        sb_reference_density(&copy.reference, rho);
        sb_reference_eddy(&copy.reference, rho, 0.5, t.scene.numerics.wall_offset * t.scene.resolution, 0.1, eddy);
        sb_reference_unswitched(&copy.reference, rho, 0, eddy, expected);
        twin_gap gap = {0}, stress = {0};
        for (size_t i = 0; i < sim->state.n; i++) twin_compare(&gap, i, (double)sim->work.eddy[i], eddy[i]);
        sb_error error = {0};
        assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
        for (size_t i = 0; i < sim->state.n; i++) {
            sb_f4 v = sim->work.predicted[i];
            twin_compare(&stress, i, (double)v[0] - copy.velocity[i].x, expected[i].x);
            twin_compare(&stress, i, (double)v[1] - copy.velocity[i].y, expected[i].y);
            twin_compare(&stress, i, (double)v[2] - copy.velocity[i].z, expected[i].z);
        }
        printf("%dD, %zu particles: viscosity %.2g of %.3g m^2/s, stress %.2g of %.3g m/s^2\n", dimensions,
               sim->state.n, twin_relative(&gap), gap.scale, twin_relative(&stress), stress.scale);
        assert_true(gap.scale > 1e-3 && twin_relative(&gap) < 1e-5);
        assert_true(stress.scale > 1 && twin_relative(&stress) < 1e-5);
        sb_free(rho);
        sb_free(eddy);
        sb_free(expected);
        twin_free(&copy);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* A full tank in a linear flow, at rest at the origin. */
static void stir(tank *t, double g[3][3])
{
    sb_model *m = &t->model;
    for (size_t i = 0; i < m->fluid_count; i++) {
        const double x[3] = {m->fluid_position[i].x, m->fluid_position[i].y, m->fluid_position[i].z};
        double v[3] = {0};
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) v[a] += g[a][b] * x[b];
        m->fluid_velocity[i] = sb_vec(v[0], t->scene.dimensions == 2 ? 0 : v[1], v[2]);
    }
}

/* Shear, strain and rotation: nu_t = (C_s dr)^2 |S| everywhere on a jittered lattice, also in corners and at the
   surface, and nu_t = 0 for rigid rotation. */
static void linear_flows_are_exact(void **state)
{
    (void)state;
    static double flows[][3][3] = {{{0, 0, 3}, {0, 0, 0}, {0, 0, 0}},
                                   {{0, 0, 0}, {0, 0, 0}, {-2, 0, 0}},
                                   {{1, 0, 0}, {0, 0, 0}, {0, 0, -1}},
                                   {{0, 0, 2}, {0, 0, 0}, {-2, 0, 0}},
                                   {{1, 2, 3}, {4, -3, 5}, {-1, 0.5, 2}}};
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (size_t f = 0; f < sizeof flows / sizeof *flows; f++) {
            tank t;
            tank_make(&t, dimensions, 0.1, sb_vec(1, 0.8, 1), 0.8, 0.8, 0.1);
            turn_on(&t);
            stir(&t, flows[f]);
            sb_sim *sim = prepared(&t);
            double strain = 0, worst = 0;
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    if (dimensions == 3 || (a != 1 && b != 1)) strain += pow(flows[f][a][b] + flows[f][b][a], 2) / 2;
            double expected = 1e-4 * sqrt(strain);
            for (size_t i = 0; i < sim->state.n; i++) worst = fmax(worst, fabs((double)sim->work.eddy[i] - expected));
            printf("%dD flow %zu: |S| = %.4g 1/s, worst %.2g m^2/s of %.3g\n", dimensions, f, sqrt(strain), worst,
                   expected);
            assert_true(worst < 3e-6 * fmax(expected, 1e-4));
            sb_sim_destroy(sim);
            tank_free(&t);
        }
}

/* One particle of a sheared tank at decreasing distances d from the floor: nu_t = (kappa d)^2 |S|. */
static void walls_reduce_it(void **state)
{
    (void)state;
    const double dr = 0.1, shear = 3;
    double last = 1;
    for (double d = 0.05; d >= 0; d -= 0.005) { /* from the wall, `wall_offset` in front of the boundary surface */
        tank t;
        tank_make(&t, 3, dr, sb_vec(1, 0.8, 1), 1, 0.8, 0);
        turn_on(&t);
        sb_model *m = &t.model;
        size_t moved = m->fluid_count;
        for (size_t i = 0; i < m->fluid_count && moved == m->fluid_count; i++)
            if (sb_norm(sb_sub(m->fluid_position[i], sb_vec(0.55, 0.45, 0.05))) < 1e-6) moved = i;
        assert_true(moved < m->fluid_count);
        m->fluid_position[moved].z = d;
        stir(&t, (double[3][3]){{0, 0, shear}});
        sb_sim *sim = prepared(&t);
        for (size_t i = 0; i < sim->state.n; i++) {
            double eddy = (double)sim->work.eddy[i], length = fmin(0.1 * dr, 0.4 * d);
            if (sim->state.id[i] != moved) {
                assert_near(eddy, 1e-4 * shear, 1e-8);
                continue;
            }
            assert_near(eddy, length * length * shear, 1e-9);
            assert_true(eddy <= last * (1 + 1e-5));
            last = eddy;
        }
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    assert_true(last < 1e-9 * shear);
}

/* In u = c z^2 the shear is 2 c z and nu_t is (C_s dr)^2 2 |c z|. The stress (C_s dr)^2 (2 c z)^2 gives the
   acceleration (C_s dr)^2 8 c^2 z, times the fraction that physical viscosity has, too (test_explicit_forces.c). */
static void shear_decays_as_documented(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const double c = 1000;
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(1.1, 1.1, 2.1), 1.1, 2.1, 0);
        turn_on(&t);
        sb_model *m = &t.model;
        for (size_t i = 0; i < m->fluid_count; i++)
            m->fluid_velocity[i] = sb_vec(c * pow(m->fluid_position[i].z, 2), 0, 0);
        sb_sim *sim = prepared(&t);
        sb_error error = {0};
        assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
        const double share = twin_lattice_shear(sim);
        sb_vec3 half = sb_vec(0.55, dimensions == 2 ? 0 : 0.55, 1.05);
        size_t count = 0;
        for (size_t i = 0; i < sim->state.n; i++) {
            sb_fluid_sample p = sb_sim_particle(sim, i);
            if (sb_norm(sb_sub(p.position, half)) > 0.12) continue;
            double z = p.position.z, after = (double)sim->work.predicted[i][0];
            assert_near((after - c * z * z) / (1e-4 * 8 * c * c * z), share, 2e-4);
            count++;
        }
        assert_true(count >= 5);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* The stress conserves momentum and angular momentum, and removes energy. */
static void stress_conserves_momentum_and_removes_energy(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(1, 0.8, 1), 1, 1, 0.2);
        tank_scatter(&t, 9, 2);
        turn_on(&t);
        sb_sim *sim = prepared(&t);
        sb_error error = {0};
        assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
        const sb_f4 *start = sim->state.velocity;
        sb_vec3 push = {0}, spin = {0};
        double all = 0, power = 0;
        for (size_t i = 0; i < sim->state.n; i++) {
            sb_f4 v = start[i], d = sim->work.predicted[i] - v;
            sb_vec3 a = sb_vec((double)d[0], (double)d[1], (double)d[2]);
            push = sb_add(push, a);
            spin = sb_add(spin, sb_cross(sb_space_position(&sim->space, sim->state.position[i]), a));
            power += (double)v[0] * a.x + (double)v[1] * a.y + (double)v[2] * a.z;
            all += sb_norm(a);
        }
        printf("%dD: momentum %.2g, spin %.2g of sum |a| (times 1 m), power %.3g m^2/s^3\n", dimensions,
               sb_norm(push) / all, sb_norm(spin) / all, power);
        assert_true(all > 1 && sb_norm(push) < 1e-7 * all && sb_norm(spin) < 2e-7 * all);
        assert_true(power < 0);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

static void it_costs_nothing_when_off(void **state)
{
    (void)state;
    size_t bytes[2];
    for (int on = 0; on < 2; on++) {
        tank t;
        tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0.1);
        t.scene.numerics.stress_memory = 0; /* needs gravity, and memory of its own */
        t.scene.fluid.viscosity = 0;        /* on or off, without the memory for the walls' shear */
        if (on) turn_on(&t);
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        bytes[on] = sb_sim_bytes(sim);
        assert_int_equal(tank_steps(sim, 2), 0);
        assert_true((sim->work.eddy != NULL) == on && tank_has_stage(sim, "turbulence") == on);
        assert_true(tank_has_stage(sim, "forces") && tank_has_stage(sim, "move"));
        assert_true(tank_skips(sim, "turbulence") == !on);
        assert_true(tank_skips(sim, "viscosity: both") == !on);
        if (on) assert_int_equal(bytes[1], bytes[0]); /* they share the memory of the pressure solve */
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_random_cloud_is_the_reference),
        cmocka_unit_test(linear_flows_are_exact),
        cmocka_unit_test(walls_reduce_it),
        cmocka_unit_test(shear_decays_as_documented),
        cmocka_unit_test(stress_conserves_momentum_and_removes_energy),
        cmocka_unit_test(it_costs_nothing_when_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
