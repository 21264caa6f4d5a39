/* The steady part of the stress correction: forgotten by its law, in proportion to the pressure, unknown to new
   particles, and no cost when off. */
#include "base/memory.h"
#include "check.h"
#include "sim/tank.h"
#include "sim/terms/steady_stress.h"
#include "sim/terms/stress_correction.h"

#include <stdio.h>

/* s. A third of the memory of the tank below, about 11 s. */
static const double STEP = 3;
static const double PRESSURE = 1e4; /* Pa, of all particles */

/* Water stretched along z by 10 %, under equal pressure. */
static sb_sim *stretched(tank *t, double memory)
{
    tank_make(t, 2, 0.1, sb_vec(3, 0, 3), 3, 3, 0);
    for (size_t i = 0; i < t->model.fluid_count; i++) {
        sb_vec3 *at = &t->model.fluid_position[i];
        at->x = 1.5 + (at->x - 1.5) / 1.1;
        at->z = 1.5 + (at->z - 1.5) * 1.1;
    }
    t->scene.numerics.stress_memory = memory;
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

/* Prepares a step of water that does not move, under a pressure that increases along x, and returns the sum of |dv| by
   the correction. */
static double correction(sb_sim *sim, double pressure)
{
    for (size_t i = 0; i < sim->state.n; i++) {
        const double x = sb_space_position(&sim->space, sim->state.position[i]).x;
        sim->state.velocity[i] = (sb_f4){0, 0, 0, (float)(pressure * (1 + x))};
    }
    sb_error error = {0};
    assert_int_equal(tank_prepare(sim, STEP), 0);
    assert_int_equal(sb_stage_stress_correction(sim, &error), SB_OK);
    double sum = 0;
    for (size_t i = 0; i < sim->state.n; i++)
        sum += sqrt((double)sb_sum3(sim->state.velocity[i] * sim->state.velocity[i]));
    return sum;
}

/* Of a stress that stays, exp(-t/T) is corrected at t: of one that comes later, all. */
static void a_steady_stress_is_forgotten(void **state)
{
    (void)state;
    tank t, other;
    sb_sim *sim = stretched(&t, 20), *whole = stretched(&other, 0);
    const double all = correction(whole, PRESSURE);
    const double memory = 20 * sqrt(t.model.max.z > 0 ? 3 / t.scene.fluid.gravity : 0);
    assert_true(all > 1);
    for (int k = 1; k <= 12; k++) {
        const double part = correction(sim, PRESSURE) / all;
        assert_near(part, exp(-k * STEP / memory), 2e-4);
        if (k % 4 == 0) printf("after %g of the memory: %.4f of the stress is corrected\n", k * STEP / memory, part);
    }
    const double now = exp(-12 * STEP / memory), next = exp(-STEP / memory);
    const double twice = correction(sim, 2 * PRESSURE) / all;
    assert_near(twice, next * (now + 1), 1e-3);
    sb_sim_destroy(sim);
    sb_sim_destroy(whole);
    tank_free(&t);
    tank_free(&other);
}

/* Settling takes a third of the time. The run begins with the mean that the stress then has: nothing is corrected. */
static void a_run_begins_with_the_stress_of_settled_water(void **state)
{
    (void)state;
    tank t, other;
    sb_sim *sim = stretched(&t, 60), *whole = stretched(&other, 0);
    const double all = correction(whole, PRESSURE), memory = 60 * sqrt(3 / t.scene.fluid.gravity);
    sim->state.settle.under_way = true;
    for (int k = 1; k <= 4; k++) {
        const double part = correction(sim, PRESSURE) / all;
        assert_near(part, exp(-3 * k * STEP / memory), 2e-4);
        sim->state.settle.done++;
    }
    sim->state.settle.under_way = false;
    assert_true(correction(sim, PRESSURE) < 1e-6 * all);
    sim->state.time = STEP;
    assert_near(correction(sim, 2 * PRESSURE) / all, exp(-STEP / memory), 1e-3);
    sb_sim_destroy(sim);
    sb_sim_destroy(whole);
    tank_free(&t);
    tank_free(&other);
}

/* Water that has run out under a tenth of its pressure does not carry the stress of the former pressure. */
static void a_stress_falls_with_the_pressure(void **state)
{
    (void)state;
    tank t, other;
    sb_sim *sim = stretched(&t, 0.1), *whole = stretched(&other, 0); /* all stress is steady after one step */
    const double all = correction(whole, PRESSURE);
    const double first = correction(sim, PRESSURE);
    t.scene.numerics.stress_memory = 1e6; /* the means stay */
    const double fallen = correction(sim, 0.1 * PRESSURE);
    printf("correction of a steady stress %.2g m/s, at a tenth of the pressure %.2g m/s, of all %.2g m/s\n", first,
           fallen, all);
    assert_true(first < 1e-6 * all && fallen < 1e-6 * all);
    assert_true(sb_steady_part(1, 4) == 0.25f && sb_steady_part(4, 1) == 1 && sb_steady_part(0, 1) == 0);
    assert_true(sb_steady_part(0, 0) == 1); /* of a mean that is 0 */
    sb_sim_destroy(sim);
    sb_sim_destroy(whole);
    tank_free(&t);
    tank_free(&other);
}

static void new_particles_have_no_past(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = stretched(&t, 20);
    correction(sim, PRESSURE);
    const size_t i = sim->state.n / 2;
    assert_true(sim->state.steady_unknown[i] > 0 && sim->state.steady_stress_xx[i] != 0);
    sb_steady_stress_clear(&sim->state, i);
    assert_true(sim->state.steady_unknown[i] == 0 && sim->state.steady_stress_xx[i] == 0 &&
                sb_sum3(sim->state.steady_stress[i] * sim->state.steady_stress[i]) == 0);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void it_costs_nothing_when_off(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = stretched(&t, 0);
    assert_true(!sim->needs.steady_stress && !sim->state.steady_stress && !sim->state.steady_stress_xx &&
                !sim->state.steady_unknown);
    sb_steady_stress_clear(&sim->state, 0);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_steady_stress_is_forgotten),
        cmocka_unit_test(a_run_begins_with_the_stress_of_settled_water),
        cmocka_unit_test(a_stress_falls_with_the_pressure),
        cmocka_unit_test(new_particles_have_no_past),
        cmocka_unit_test(it_costs_nothing_when_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
