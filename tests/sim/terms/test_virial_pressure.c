/* The virial pressure: compared with a direct evaluation, in water at rest, and without effect on the state. */
#include "base/random.h"
#include "check.h"
#include "sim/tank.h"
#include "sim/twin.h"

#include <stdio.h>

/* The virial pressure by its definition (docs/method.md, M17a). */
static double virial(const sb_sim *sim, const twin *copy, size_t i)
{
    const sb_reference *r = &copy->reference;
    const double q = (double)sim->work.unknown[i];
    double sum = 0;
    for (size_t k = r->fluid_start[i]; k < r->fluid_start[i + 1]; k++)
        sum += r->mass * (q + (double)sim->work.unknown[r->fluid[k].other]) *
               sb_dot(r->fluid[k].offset, r->fluid[k].gradient);
    for (size_t k = r->wall_start[i]; k < r->wall_start[i + 1]; k++)
        sum += q * copy->psi[r->wall[k].other] * sb_dot(r->wall[k].offset, r->wall[k].gradient);
    return -0.5 * r->cloud.rest_density * sum / r->cloud.dimension;
}

/* Scattered water beside walls and across periodic sides that has moved since the lists were made. */
static void a_random_cloud_is_the_reference(void **state)
{
    (void)state;
    for (int form = 0; form < 4; form++) {
        const int dimensions = form % 2 ? 3 : 2;
        tank t;
        twin copy;
        twin_gap gap = {0};
        const sb_vec3 size = dimensions == 2 ? sb_vec(3, 0, 2) : sb_vec(1.2, 1.2, 1);
        tank_of_particles(&t, dimensions, 0.1, size, size.x, 0.9 * size.z, 0);
        if (form > 1) tank_repeat(&t, 0);
        tank_scatter(&t, 5, 1);
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        assert_int_equal(tank_prepare(sim, 1e-3), 0);
        for (size_t i = 0; i < sim->state.n; i++) sim->work.unknown[i] = (float)sb_random(7, i);
        assert_int_equal(twin_make(sim, &copy), 0);
        for (size_t i = 0; i < sim->state.n; i++)
            for (int axis = 0; axis < 3; axis++)
                sim->state.position[i][axis] +=
                    (uint32_t)(int32_t)lrint((double)sim->state.velocity[i][axis] * 1e-3 / sim->space.quantum);
        sim->work.lists_current = true;
        sb_sim_find_virial_pressures(sim);
        size_t beside = 0;
        for (size_t i = 0; i < sim->state.n; i++) {
            beside += copy.reference.wall_start[i] < copy.reference.wall_start[i + 1];
            twin_compare(&gap, i, sb_sim_particle(sim, i).pressure, virial(sim, &copy, i));
        }
        printf("%dD, %zu particles, %zu beside walls: %.2g of %.3g Pa\n", dimensions, sim->state.n, beside,
               twin_relative(&gap), gap.scale);
        assert_true(beside > 30 && gap.scale > 1e5 && twin_relative(&gap) < 2e-5);
        twin_free(&copy);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* Mean of the deviation from hydrostatic pressure, and of its square, in metres of water, over the particles farther
   from walls and surface than the support radius. */
static void deviation(const sb_sim *sim, double depth, double width, double *mean, double *square)
{
    const double weight = 1000 * 9.81, support = (double)sim->constant.support;
    size_t count = 0;
    *mean = *square = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_fluid_sample p = sb_sim_particle(sim, i);
        if (p.position.z < support || p.position.z > depth - support || p.position.x < support ||
            p.position.x > width - support)
            continue;
        const double off = p.pressure / weight - (depth - p.position.z);
        *mean += off;
        *square += off * off;
        count++;
    }
    assert_true(count > 100);
    *mean /= (double)count;
    *square /= (double)count;
}

/* Settled water is not a lattice: the solver pressure is too high on average, and has more scatter. The state hash does
   not change. */
static void water_at_rest_has_hydrostatic_pressure(void **state)
{
    (void)state;
    tank t;
    tank_make(&t, 2, 0.05, sb_vec(1.2, 0, 1.5), 1.2, 1, 0.05);
    t.scene.numerics.kernel = sb_kernel_find("wendland-c2");
    t.scene.numerics.support = 2.75;
    t.scene.numerics.density = SB_DENSITY_COMPLETED;
    t.scene.numerics.settle_steps = 300;
    sb_sim *sim = tank_settled(&t);
    double before[2] = {0}, virial_sums[2] = {0};
    enum { STEPS = 200 };
    for (int s = 0; s < STEPS; s++) {
        double mean, square;
        assert_int_equal(tank_steps(sim, 1), 0);
        deviation(sim, 1, 1.2, &mean, &square);
        before[0] += mean / STEPS;
        before[1] += square / STEPS;
        const uint64_t hash = sb_sim_hash(sim);
        sb_sim_find_virial_pressures(sim);
        assert_true(sb_sim_hash(sim) == hash);
        deviation(sim, 1, 1.2, &mean, &square);
        virial_sums[0] += mean / STEPS;
        virial_sums[1] += square / STEPS;
    }
    printf("solver pressure %+.4f m, rms %.4f; virial pressure %+.4f m, rms %.4f\n", before[0], sqrt(before[1]),
           virial_sums[0], sqrt(virial_sums[1]));
    assert_true(fabs(virial_sums[0]) < 0.6 * before[0]);
    assert_true(virial_sums[1] < 0.5 * before[1]);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Velocities set at t = 0 have moved nothing yet, so that they do not change the pressures. */
static void initial_velocities_do_not_change_pressures(void **state)
{
    (void)state;
    sb_sim *sim[2];
    tank t[2];
    for (int k = 0; k < 2; k++) {
        tank_make(&t[k], 2, 0.1, sb_vec(2, 0, 1.5), 2, 0.8, 0.05);
        t[k].scene.numerics.settle_steps = 60;
        for (size_t i = 0; i < t[k].model.fluid_count; i++) t[k].model.fluid_velocity[i].x = k ? 2 : 0;
        sim[k] = tank_settled(&t[k]);
        sb_sim_find_virial_pressures(sim[k]);
    }
    assert_int_equal(sim[0]->state.n, sim[1]->state.n);
    for (size_t i = 0; i < sim[0]->state.n; i++) {
        const sb_fluid_sample rest = sb_sim_particle(sim[0], i), moves = sb_sim_particle(sim[1], i);
        assert_true(rest.velocity.x == 0 && moves.velocity.x == 2);
        assert_true(moves.pressure == rest.pressure);
    }
    for (int k = 0; k < 2; k++) {
        sb_sim_destroy(sim[k]);
        tank_free(&t[k]);
    }
}

/* Virial pressures are computed once per step, and only from current lists: a state that was just loaded has solver
   pressures. */
static void only_current_lists_are_used(void **state)
{
    (void)state;
    tank t;
    tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 1, 0.8, 0.1);
    sb_sim *sim = tank_sim(&t), *again = tank_sim(&t);
    assert_non_null(sim);
    assert_non_null(again);
    sb_sim_find_virial_pressures(sim); /* no step was done yet */
    assert_int_equal(tank_steps(sim, 30), 0);
    const float solved = sim->state.velocity[0][3];
    assert_true(sb_sim_particle(sim, 0).pressure == (double)solved);
    sb_sim_find_virial_pressures(sim);
    const double virial_sums = sb_sim_particle(sim, 0).pressure;
    assert_true(virial_sums != (double)solved);
    sim->work.unknown[0] *= 2;
    sb_sim_find_virial_pressures(sim);
    assert_true(sb_sim_particle(sim, 0).pressure == virial_sums);
    sb_archive_out out = {0};
    sb_error error = {0};
    tank_save(sim, &out);
    assert_int_equal(tank_load(again, &out, &error), SB_OK);
    sb_sim_find_virial_pressures(again);
    assert_true(sb_sim_particle(again, 0).pressure == (double)again->state.velocity[0][3]);
    sb_archive_out_free(&out);
    sb_sim_destroy(sim);
    sb_sim_destroy(again);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_random_cloud_is_the_reference),
        cmocka_unit_test(water_at_rest_has_hydrostatic_pressure),
        cmocka_unit_test(initial_velocities_do_not_change_pressures),
        cmocka_unit_test(only_current_lists_are_used),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
