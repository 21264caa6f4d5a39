/* The same bits for any number of threads: the complete state after many steps. */
#include "sim/presets.h"
#include "sim/pressure/pressure.h"

#include <omp.h>
#include <stdio.h>

enum { STEPS = 40 };

static uint64_t run(const tank *t, int threads)
{
    omp_set_num_threads(threads);
    sb_sim *sim = tank_settled(t);
    assert_int_equal(tank_steps(sim, STEPS), 0);
    assert_int_equal(sb_sim_report(sim)->step, STEPS);
    assert_true(sim->state.n > 2 * (size_t)SB_BLOCK);
    uint64_t hash = sb_sim_hash(sim);
    sb_sim_destroy(sim);
    return hash;
}

static void check(const tank *t, const char *name)
{
    const int counts[] = {2, 3, 8};
    int before = omp_get_max_threads();
    uint64_t alone = run(t, 1);
    printf("%s, %s: %016llx\n", name, sb_pressure_solvers[t->scene.numerics.solver]->name, (unsigned long long)alone);
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        uint64_t hash = run(t, counts[c]);
        if (hash != alone) fail_msg("%s: %d threads give %016llx", name, counts[c], (unsigned long long)hash);
    }
    assert_true(run(t, 1) == alone);
    omp_set_num_threads(before);
}

/* Each solver with the default preset, and `paper` with its own. */
static void a_dam_break(void **state)
{
    const sb_solver last = preset_of(state) == SB_PRESET_PAPER ? SB_SOLVER_JACOBI : SB_SOLVER_CG;
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= last; solver++) {
        tank t;
        tank_make(&t, 2, 1.0 / 48, sb_vec(2, 0, 1.5), 1, 1.1, 0.1);
        tank_use(&t, preset_of(state));
        t.scene.numerics.solver = solver;
        tank_add_terms(&t);
        check(&t, "dam break");
        tank_free(&t);
    }
}

static void a_paddle(void **state)
{
    const sb_wavemaker_parameters law = {.kind = sb_wavemaker_find("stroke"),
                                         .stroke = 0.1,
                                         .speed = 0.8,
                                         .gravity = 9.81,
                                         .after = SB_AFTER_RETURN,
                                         .return_time = 0.3};
    tank t;
    tank_of_particles(&t, 3, 1.0 / 12, sb_vec(2, 1, 1), 2, 0.75, 0.1);
    tank_use(&t, preset_of(state));
    t.scene.numerics.solver = SB_SOLVER_CG;
    tank_add_plate(&t, "paddle", -1.0 / 24, 0, 0.8, sb_vec(1, 0, 0), &law);
    tank_add_terms(&t);
    check(&t, "paddle");
    tank_free(&t);
}

/* The hash depends on every bit of the state. */
static void the_hash_covers_the_state(void **state)
{
    tank t;
    tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0.1);
    tank_use(&t, preset_of(state));
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_steps(sim, 3), 0);
    uint64_t hash = sb_sim_hash(sim);
    size_t last = sim->state.n - 1;
    struct {
        void *at;
        size_t size;
    } parts[] = {{&sim->state.position[last], 12},
                 {&sim->state.velocity[last], 16},
                 {&sim->state.id[0], 4},
                 {&sim->state.impulse[0].moment, sizeof(sb_vec3)},
                 {&sim->state.ledger.left, sizeof(double)},
                 {&sim->state.time, sizeof(double)},
                 {&sim->state.step, sizeof(uint64_t)}};
    for (size_t p = 0; p < sizeof parts / sizeof *parts; p++)
        for (size_t byte = 0; byte < parts[p].size; byte++) {
            unsigned char *at = (unsigned char *)parts[p].at + byte;
            *at ^= 1;
            assert_true(sb_sim_hash(sim) != hash);
            *at ^= 1;
        }
    assert_true(sb_sim_hash(sim) == hash);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_both_presets(a_dam_break),
        in_both_presets(a_paddle),
        in_both_presets(the_hash_covers_the_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
