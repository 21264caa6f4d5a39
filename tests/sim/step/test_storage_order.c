/* The state after a step does not depend on the order in which the particles were stored before it: neither forces nor
   sums know in which order, or on which processor, particles were kept. */
#include "sim/presets.h"

enum { BEFORE = 5, AFTER = 20 };

/* Steps one run as it is, and others shuffled before each step. */
static void check(const tank *t)
{
    sb_sim *plain = tank_settled(t);
    assert_int_equal(tank_steps(plain, BEFORE + AFTER), 0);
    for (uint64_t seed = 1; seed < 3; seed++) {
        sb_sim *sim = tank_settled(t);
        assert_int_equal(tank_steps(sim, BEFORE), 0);
        for (int step = 0; step < AFTER; step++) {
            tank_shuffle(sim, seed << 40 | (uint64_t)step << 32);
            assert_int_equal(tank_steps(sim, 1), 0);
        }
        assert_true(sb_sim_hash(sim) == sb_sim_hash(plain));
        assert_int_equal(sb_sim_report(sim)->iterations, sb_sim_report(plain)->iterations);
        assert_near(sb_sim_energy(sim).kinetic, sb_sim_energy(plain).kinetic, 0);
        sb_sim_destroy(sim);
    }
    sb_sim_destroy(plain);
}

static void water_that_collapses(void **state)
{
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(2, 0.6, 1.2), 0.8, 0.8, 0.1);
        tank_use(&t, preset_of(state));
        tank_add_terms(&t);
        check(&t);
        tank_free(&t);
    }
}

static void water_between_periodic_sides(void **state)
{
    tank t;
    tank_make(&t, 3, 0.1, sb_vec(2, 0.6, 1.2), 1, 0.8, 0.1);
    tank_use(&t, preset_of(state));
    tank_repeat(&t, 1);
    check(&t);
    tank_free(&t);
}

static void each_solver(void **state)
{
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++) {
        tank t;
        tank_make(&t, 2, 0.05, sb_vec(1.5, 0, 1), 0.6, 0.6, 0.1);
        tank_use(&t, preset_of(state));
        t.scene.numerics.solver = solver;
        check(&t);
        tank_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_both_presets(water_that_collapses),
        in_both_presets(water_between_periodic_sides),
        in_both_presets(each_solver),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
