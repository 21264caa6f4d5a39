/* What sleepers do to the water awake and to bodies: momentum, loads, periodic sides, threads; and without memory. */
#include "../check.h"
#include "base/memory.h"
#include "sim/flume.h"
#include "sim/sleep.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

/* The balance is of the water awake: what sleepers do to it is among the forces, by pressure and by viscosity. */
static void check_momentum(tank *t, sb_solver solver)
{
    t->scene.numerics.solver = solver;
    t->scene.numerics.stress_correction = 1;
    t->scene.numerics.artificial_viscosity = 0.05;
    t->scene.fluid.viscosity = 1e-3;
    t->scene.numerics.turbulence = SB_TURBULENCE_SPS;
    t->scene.numerics.smagorinsky = 0.1;
    sb_sim *sim = tank_settled(t);
    double worst = 0, share = 0;
    for (int s = 0; s < 150; s++) {
        assert_int_equal(tank_steps(sim, 1), 0);
        worst = s < 20 ? 0 : fmax(worst, sb_sim_report(sim)->momentum_imbalance);
        share = fmax(share, sb_norm(sim->sleep->support));
    }
    printf("imbalance %.2g, sleepers' push %.3g N, rub %.3g N\n", worst, share, sb_norm(sim->sleep->rub));
    assert_true(sb_sim_sleep(sim).asleep > 0);
    assert_true(worst < 1e-6);
    assert_true(share > 100 && sb_norm(sim->sleep->rub) > 0);
    sb_sim_destroy(sim);
}

static void momentum_balances(void **state)
{
    (void)state;
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++) {
        tank t;
        flume_make(&t, 2, 0.1, sb_vec(14, 0, 1.5), true);
        check_momentum(&t, solver);
        tank_free(&t);
    }
}

/* Sides that repeat across the flume, where sleepers have images, and along it, where the front comes from both. */
static void periodic_sides(void **state)
{
    (void)state;
    for (int axis = 1; axis >= 0; axis--) {
        tank t;
        flume_make(&t, 3, 0.2, sb_vec(axis ? 16 : 32, 0.8, 1.6), true);
        tank_repeat(&t, axis);
        if (axis == 0) { /* without a paddle: it stands at a side that is none */
            t.model.body_count = 1;
            t.scene.wavemaker_count = 0;
            t.model.wall_count = t.model.bodies[0].count;
            for (size_t i = 0; i < t.model.fluid_count; i++)
                t.model.fluid_velocity[i].x = t.model.fluid_position[i].x < 1 ? 0.3 : 0;
        }
        sb_sim *sim = tank_settled(&t);
        if (axis == 0) {
            bool low = false, high = false;
            for (size_t i = 0; i < sim->n; i++) {
                const double x = sb_sim_particle(sim, i).position.x;
                low |= x < 4;
                high |= x > 28;
                assert_true(x < 8 || x > 24);
            }
            assert_true(low && high);
        }
        double worst = 0;
        for (int s = 0; s < 60; s++) {
            assert_int_equal(tank_steps(sim, 1), 0);
            worst = s < 20 ? 0 : fmax(worst, sb_sim_report(sim)->momentum_imbalance);
        }
        printf("periodic along %c: %zu of %zu asleep, imbalance %.2g\n", axis ? 'y' : 'x', sb_sim_sleep(sim).asleep,
               t.model.fluid_count, worst);
        assert_true(sb_sim_sleep(sim).asleep > t.model.fluid_count / 5);
        assert_int_equal(sb_sim_report(sim)->fluid_count, t.model.fluid_count);
        assert_true(worst < 1e-6);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* The same bits for any number of threads; test_resume.c goes on from a state saved while some sleep. */
static void bits_repeat(void **state)
{
    (void)state;
    static const int threads[] = {1, 2, 3};
    const int before = omp_get_max_threads();
    uint64_t hash[3];
    tank t;
    flume_make(&t, 3, 0.2, sb_vec(16, 0.8, 1.6), true);
    t.scene.numerics.wall_friction = 0.05;
    for (int k = 0; k < 3; k++) {
        omp_set_num_threads(threads[k]);
        sb_sim *sim = tank_settled(&t);
        const size_t asleep = sb_sim_sleep(sim).asleep;
        assert_int_equal(tank_steps(sim, 61), 0);
        assert_int_equal(tank_steps(sim, 60), 0);
        assert_true(sb_sim_sleep(sim).asleep > 0 && sb_sim_sleep(sim).asleep < asleep);
        hash[k] = sb_sim_hash(sim);
        sb_sim_destroy(sim);
    }
    assert_true(hash[1] == hash[0] && hash[2] == hash[0]);
    omp_set_num_threads(before);
    tank_free(&t);
}

/* Bodies feel the water asleep as they did: the whole tank the weight of all of it, where pressure bears it and where
   boundary particles are so light that contact has to. */
static void check_load(double wall_gamma, int steps, double within)
{
    tank t;
    flume_make(&t, 2, 0.1, sb_vec(20, 0, 1.5), true);
    t.scene.wavemakers[0].law.start = 100;
    t.scene.numerics.wall_gamma = wall_gamma;
    t.scene.numerics.settle_steps = steps;
    sb_sim *sim = tank_settled(&t);
    const double weight = 9.81 * sb_sim_energy(sim).mass;
    const uint64_t woken = sb_sim_sleep(sim).asleep;
    assert_int_equal(tank_steps(sim, 40), 0);
    const double load = -sb_sim_impulse(sim, 0)->pressure.z / sb_sim_report(sim)->time;
    printf("gamma %g: floor bears %.4f of the weight\n", wall_gamma, load / weight);
    assert_int_equal(sb_sim_sleep(sim).asleep, woken); /* nothing has moved */
    assert_near(load, weight, within * weight);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void bodies_feel_sleepers(void **state)
{
    (void)state;
    check_load(0.7, 200, 0.005);
    check_load(0.1, 400, 0.05); /* pressure alone bears a third; what lies on contacts never comes quite to rest */
}

/* Every allocation of laying down and waking may fail, and is said to have. */
static void no_memory(void **state)
{
    (void)state;
    long failures = 0;
    for (long n = 1;; n++) {
        tank t;
        sb_error error = {0};
        flume_make(&t, 2, 0.2, sb_vec(14, 0, 1.6), true);
        t.scene.numerics.settle_steps = 1;
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        sim->settling = SB_CREEPING; /* at rest at its end, so that there is something to lay down */
        assert_int_equal(tank_steps(sim, 1), 0);
        sim->settling = SB_RUNNING;
        sb_memory_fail_at(n);
        sb_status status = sb_sleep_expect(sim, &error);
        if (status == SB_OK) {
            sb_sleep_listen(sim, 0);
            status = sb_sleep_begin(sim, &error);
        }
        sb_memory_fail_at(0);
        if (status != SB_OK) assert_non_null(strstr(error.text, "memory"));
        if (status == SB_OK) assert_true(sb_sim_sleep(sim).asleep > 0);
        failures += status != SB_OK;
        sb_sim_destroy(sim);
        tank_free(&t);
        if (status == SB_OK) break;
    }
    printf("%ld allocations\n", failures);
    assert_true(failures > 15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momentum_balances),    cmocka_unit_test(periodic_sides), cmocka_unit_test(bits_repeat),
        cmocka_unit_test(bodies_feel_sleepers), cmocka_unit_test(no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
