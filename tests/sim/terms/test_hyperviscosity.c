/* Hyperviscosity: compared with a direct evaluation, conservation of momentum, loss of energy, how little it takes from
   long waves, and no cost when off. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/step/stages.h"
#include "sim/tank.h"
#include "sim/terms/hyperviscosity.h"
#include "sim/twin.h"

#include <stdio.h>
#include <string.h>

static const double STEP = 0.5, KAPPA = 0.1;

/* Prepared for a step, with v* = v. */
static sb_sim *prepare(tank *t)
{
    t->scene.numerics.hyperviscosity = KAPPA;
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, STEP), 0);
    memcpy(sim->work.predicted, sim->state.velocity, sim->state.n * sizeof *sim->work.predicted);
    return sim;
}

/* (L f)_i without the lattice's sum. */
static sb_vec3 differences(const sb_reference *r, const sb_vec3 *field, size_t i)
{
    sb_vec3 sum = {0};
    for (size_t k = r->fluid_start[i]; k < r->fluid_start[i + 1]; k++) {
        const sb_reference_pair *p = &r->fluid[k];
        sum = sb_madd(sum, r->mass * sb_norm(p->gradient) / sb_norm(p->offset), sb_sub(field[i], field[p->other]));
    }
    return sum;
}

static void a_random_cloud_is_the_reference(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        twin copy;
        const sb_vec3 size = dimensions == 2 ? sb_vec(3, 0, 2) : sb_vec(1.2, 1.2, 1);
        tank_of_particles(&t, dimensions, 0.1, size, size.x, 0.9 * size.z, 0);
        tank_scatter(&t, 5, 1);
        for (size_t i = 0; i < t.model.fluid_count; i++)
            t.model.fluid_velocity[i] =
                sb_vec(sb_random(3, 3 * i), dimensions == 2 ? 0 : sb_random(3, 3 * i + 1), sb_random(3, 3 * i + 2));
        sb_sim *sim = prepare(&t);
        assert_int_equal(twin_make(sim, &copy), 0);
        const size_t n = sim->state.n;
        const double whole = (double)sim->constant.lattice_slopes;
        const double rate = KAPPA * (double)sim->constant.wave_speed / (double)sim->constant.spacing;
        sb_vec3 *once = sb_alloc(n, sizeof *once);
        assert_non_null(once);
        for (size_t i = 0; i < n; i++) once[i] = sb_scale(differences(&copy.reference, copy.velocity, i), 1 / whole);
        sb_error error = {0};
        assert_int_equal(sb_stage_hyperviscosity(sim, &error), SB_OK);
        twin_gap gap = {0};
        sb_vec3 push = {0};
        double all = 0, loss = 0, squares = 0;
        for (size_t i = 0; i < n; i++) {
            const sb_vec3 expected = sb_scale(differences(&copy.reference, once, i), -rate * STEP / whole);
            const sb_f4 change = sim->work.predicted[i] - sim->state.velocity[i];
            const double c[3] = {(double)change[0], (double)change[1], (double)change[2]};
            twin_compare(&gap, i, c[0], expected.x);
            twin_compare(&gap, i, c[1], expected.y);
            twin_compare(&gap, i, c[2], expected.z);
            push = sb_add(push, sb_vec(c[0], c[1], c[2]));
            all += sb_norm(sb_vec(c[0], c[1], c[2]));
            loss -= sb_dot(copy.velocity[i], expected);
            squares += rate * STEP * sb_dot(once[i], once[i]);
            assert_true(change[3] == 0);
        }
        printf("%dD: %.2g of %.3g m/s, momentum %.2g of all changes, power %.6g, by squares %.6g\n", dimensions,
               twin_relative(&gap), gap.scale, sb_norm(push) / all, loss, squares);
        assert_true(gap.scale > 0.1 && twin_relative(&gap) < 1e-5 && sb_norm(push) < 1e-6 * all);
        assert_true(loss > 0);
        assert_near(loss, squares, 1e-9 * squares);
        sb_free(once);
        twin_free(&copy);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* Share that a step takes from u = sin(kx), at the crest nearest to the middle of a periodic lattice. */
static double taken(int spacings)
{
    tank t;
    tank_make(&t, 2, 0.1, sb_vec(16, 0, 4), 16, 4, 0);
    tank_repeat(&t, 0);
    for (size_t i = 0; i < t.model.fluid_count; i++)
        t.model.fluid_velocity[i] = sb_vec(sin(2 * M_PI * t.model.fluid_position[i].x / (0.1 * spacings)), 0, 0);
    sb_sim *sim = prepare(&t);
    sb_error error = {0};
    assert_int_equal(sb_stage_hyperviscosity(sim, &error), SB_OK);
    double change = 0, squares = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        const double z = sb_space_position(&sim->space, sim->state.position[i]).z;
        if (fabs(z - 2) > 1) continue; /* far from floor and surface */
        change -= (double)(sim->work.predicted[i][0] - sim->state.velocity[i][0]) * (double)sim->state.velocity[i][0];
        squares += (double)sim->state.velocity[i][0] * (double)sim->state.velocity[i][0];
    }
    sb_sim_destroy(sim);
    tank_free(&t);
    return change / squares;
}

static void it_falls_with_the_fourth_power_of_the_wavelength(void **state)
{
    (void)state;
    const double at20 = taken(20), at40 = taken(40);
    printf("a step takes %.3g, %.3g of waves of 20, 40 spacings: ratio %.2f\n", at20, at40, at20 / at40);
    assert_near(at20 / at40, 16, 0.8);
}

/* Motion of the scale of the spacing, near the limit below which pairs do without the viscosity of the fluid. */
static void a_faint_viscosity_is_left_out(void **state)
{
    (void)state;
    enum { FAINT, ABOVE, STRONG, FORMS };
    double change[FORMS] = {0}, hyper = 0, limit = 0;
    for (int form = 0; form < FORMS; form++) {
        tank t;
        tank_of_particles(&t, 2, 0.1, sb_vec(3, 0, 2), 3, 1.8, 0);
        tank_scatter(&t, 5, 1);
        limit = 0x1p-20 * KAPPA * sqrt(t.scene.fluid.gravity * 2) * 0.1; /* the domain is 2 m high */
        t.scene.fluid.viscosity = form == STRONG ? 0.01 : limit * (form == FAINT ? 0.2 : 2);
        sb_sim *sim = prepare(&t);
        sb_error error = {0};
        assert_true(tank_skips(sim, "viscosity: the fluid's") == (form == FAINT));
        assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
        const float fall = sim->constant.gravity * (float)sim->state.time_step;
        for (size_t i = 0; i < sim->state.n; i++) {
            const sb_f4 by = sim->work.predicted[i] - sim->state.velocity[i] + (sb_f4){0, 0, fall, 0};
            change[form] += (double)sb_sum3(by * by);
        }
        memcpy(sim->work.predicted, sim->state.velocity, sim->state.n * sizeof *sim->work.predicted);
        assert_int_equal(sb_stage_hyperviscosity(sim, &error), SB_OK);
        hyper = 0;
        for (size_t i = 0; i < sim->state.n; i++) {
            const sb_f4 by = sim->work.predicted[i] - sim->state.velocity[i];
            hyper += (double)sb_sum3(by * by);
        }
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    const double part = sqrt(change[STRONG] / hyper) * limit / 0.01;
    printf("at the limit it changes velocities by %.2g of what the hyperviscosity does\n", part);
    assert_true(part < 2e-5 && part > 1e-6);
}

static void it_costs_nothing_when_off(void **state)
{
    (void)state;
    tank t;
    tank_of_particles(&t, 2, 0.1, sb_vec(2, 1.2, 2), 2, 2, 0.2);
    t.scene.numerics.hyperviscosity = 0;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_steps(sim, 1), 0);
    assert_null(sim->work.differences);
    for (size_t s = 0; s < sim->stage_count; s++) assert_string_not_equal(sim->stage[s].name, "hyperviscosity");
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_random_cloud_is_the_reference),
        cmocka_unit_test(it_falls_with_the_fourth_power_of_the_wavelength),
        cmocka_unit_test(a_faint_viscosity_is_left_out),
        cmocka_unit_test(it_costs_nothing_when_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
