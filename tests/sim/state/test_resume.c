/* A simulation that loads a saved state continues bit for bit like the saved one; an impossible state is refused. */
#include "base/memory.h"
#include "sim/presets.h"
#include "sim/pressure/pressure.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

enum { BEFORE = 25, AFTER = 25 };

/* Compares an uninterrupted run on one thread with runs that are resumed after some steps on several numbers of
 * threads.
 */
static void check_from(const tank *t, int steps, const char *name)
{
    static const int threads[] = {1, 2, 3, 8};
    const int before = omp_get_max_threads();
    sb_archive_out out = {0};
    sb_error error = {0};
    omp_set_num_threads(1);
    sb_sim *sim = tank_settled(t);
    assert_int_equal(tank_steps(sim, steps), 0);
    const uint64_t half = sb_sim_hash(sim);
    tank_save(sim, &out);
    assert_true(sb_sim_hash(sim) == half);
    assert_int_equal(tank_steps(sim, AFTER), 0);
    const uint64_t end = sb_sim_hash(sim);
    const sb_step_report last = *sb_sim_report(sim);
    sb_sim_destroy(sim);
    for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
        omp_set_num_threads(threads[k]);
        sim = tank_sim(t);
        assert_non_null(sim);
        if (tank_load(sim, &out, &error) != SB_OK) fail_msg("%s: %s", name, error.text);
        assert_true(sb_sim_hash(sim) == half);
        assert_int_equal(tank_steps(sim, AFTER), 0);
        if (sb_sim_hash(sim) != end) fail_msg("%s: %d threads end with another state", name, threads[k]);
        const sb_step_report *report = sb_sim_report(sim);
        assert_int_equal(report->step, steps + AFTER);
        assert_int_equal(report->iterations, last.iterations);
        assert_true(report->time_step == last.time_step && report->error_mean == last.error_mean);
        assert_int_equal(report->left_domain, last.left_domain);
        sb_sim_destroy(sim);
    }
    omp_set_num_threads(before);
    sb_archive_out_free(&out);
}

static void check(const tank *t, const char *name)
{
    check_from(t, BEFORE, name);
}

/* The first step differs from the others: means over time begin at the state of settled water. */
static void settled_water_before_its_first_step(void **state)
{
    (void)state;
    tank t;
    tank_make(&t, 2, 1.0 / 40, sb_vec(2, 0, 1.5), 1, 1.1, 0.1);
    assert_true(t.scene.numerics.stress_memory > 0);
    check_from(&t, 0, "before the first step");
    tank_free(&t);
}

/* Each solver with the default preset, and `paper` with its own. */
static void a_dam_break_with_each_solver(void **state)
{
    const sb_solver last = preset_of(state) == SB_PRESET_PAPER ? SB_SOLVER_JACOBI : SB_SOLVER_CG;
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= last; solver++) {
        tank t;
        tank_make(&t, 2, 1.0 / 40, sb_vec(2, 0, 1.5), 1, 1.1, 0.1);
        tank_use(&t, preset_of(state));
        t.scene.numerics.solver = solver;
        tank_add_terms(&t);
        check(&t, sb_pressure_solvers[solver]->name);
        tank_free(&t);
    }
}

/* The paddle is saved while it moves, and long after it has stopped at another place. */
static void a_paddle_in_motion_and_at_rest(void **state)
{
    static const double speeds[] = {0.5, 20};
    for (int k = 0; k < 2; k++) {
        const sb_wavemaker_parameters law = {.kind = sb_wavemaker_find("gate"),
                                             .stroke = 0.1,
                                             .speed = speeds[k],
                                             .gravity = 9.81,
                                             .after = SB_AFTER_STAY};
        tank t;
        tank_of_particles(&t, 3, 1.0 / 12, sb_vec(2, 1, 1), 2, 0.75, 0.1);
        tank_use(&t, preset_of(state));
        tank_add_plate(&t, "paddle", -1.0 / 24, 0, 0.8, sb_vec(1, 0, 0), &law);
        tank_add_terms(&t);
        check(&t, "paddle");
        tank_free(&t);
    }
}

static void a_periodic_slab(void **state)
{
    tank t;
    tank_make(&t, 3, 0.1, sb_vec(2, 0.5, 1.2), 1, 0.8, 0.1);
    tank_use(&t, preset_of(state));
    tank_repeat(&t, 1);
    tank_add_terms(&t);
    check(&t, "slab");
    tank_free(&t);
}

static void water_that_leaves(void **state)
{
    tank t;
    tank_make(&t, 2, 0.05, sb_vec(1, 0, 1), 1, 0.9, 0.1);
    tank_use(&t, preset_of(state));
    tank_repeat(&t, 0); /* no walls there */
    t.scene.domain.side[SB_X_MIN] = t.scene.domain.side[SB_X_MAX] = SB_SIDE_OPEN;
    tank_scatter(&t, 3, 3);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_steps(sim, BEFORE), 0);
    assert_true(sb_sim_report(sim)->left_domain > 0);
    sb_sim_destroy(sim);
    check(&t, "leaving");
    tank_free(&t);
}

/* A flume at rest with a paddle, body 1, at x = 0 that moves for 0.9 s at up to 0.5 m/s. */
static void flume_make(tank *t, int dimensions, double dr, sb_vec3 size)
{
    static const sb_wavemaker_parameters law = {.stroke = 0.4, .speed = 0.5, .gravity = 9.81, .after = SB_AFTER_STAY};
    sb_wavemaker_parameters stroke = law;
    stroke.kind = sb_wavemaker_find("stroke");
    tank_of_particles(t, dimensions, dr, size, size.x, 1, 0.02);
    tank_add_plate(t, "paddle", -dr / 2, 0, size.z, sb_vec(1, 0, 0), &stroke);
    t->scene.sea = (sb_sea){.present = true, .level = 1};
    t->scene.numerics.settle_steps = 200;
}

/* Saves the simulation at one settling step. */
typedef struct listener {
    const sb_sim *sim;
    int at;
    sb_archive_out out;
    bool saved;
} listener;

static void save_at(void *context, int done, int most, double speed)
{
    listener *l = context;
    (void)most;
    (void)speed;
    if (done != l->at) return;
    tank_save(l->sim, &l->out);
    l->saved = true;
}

/* Settling that is resumed from one of its steps ends like uninterrupted settling, and so do the steps after it. */
static void check_settling(const tank *t, int at, const char *name)
{
    sb_error error = {0};
    sb_sim *sim = tank_sim(t), *again = tank_sim(t);
    int done;
    assert_true(sim && again);
    listener l = {.sim = sim, .at = at};
    assert_int_equal(sb_sim_settle_watched(sim, save_at, &l, &error), SB_OK);
    if (!l.saved) fail_msg("%s: no step %d", name, at);
    assert_false(sb_sim_settling(sim, &done));
    if (tank_load(again, &l.out, &error) != SB_OK) fail_msg("%s: %s", name, error.text);
    assert_true(sb_sim_settling(again, &done));
    assert_int_equal(done, at);
    assert_int_equal(sb_sim_settle(again, &error), SB_OK);
    if (sb_sim_hash(sim) != sb_sim_hash(again))
        fail_msg("%s: settling resumed from step %d ends with another state", name, at);
    assert_int_equal(tank_steps(sim, AFTER), 0);
    assert_int_equal(tank_steps(again, AFTER), 0);
    if (sb_sim_hash(sim) != sb_sim_hash(again)) fail_msg("%s: the run after settling differs", name);
    sb_sim_destroy(sim);
    sb_sim_destroy(again);
    sb_archive_out_free(&l.out);
}

/* The state after the last settling step is never saved, and such a state is refused. */
static void settling_is_not_saved_at_its_end(void **state)
{
    (void)state;
    tank t;
    sb_error error = {0};
    sb_archive_out late = {0};
    flume_make(&t, 3, 0.2, sb_vec(8, 0.8, 1.6));
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(sb_sim_settle(sim, &error), SB_OK);
    const int steps = sb_sim_rest(sim).steps;
    sb_sim_destroy(sim);
    check_settling(&t, steps - 1, "flume, all but one step");

    sim = tank_sim(&t);
    listener l = {.sim = sim, .at = steps};
    assert_int_equal(sb_sim_settle_watched(sim, save_at, &l, &error), SB_OK);
    assert_false(l.saved);
    sim->state.settle.under_way = true; /* as an earlier version of the program saved it */
    tank_save(sim, &late);
    sb_sim *again = tank_sim(&t);
    assert_int_equal(tank_load(again, &late, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "settling has ended"));
    sb_sim_destroy(sim);
    sb_sim_destroy(again);
    sb_archive_out_free(&late);
    tank_free(&t);
}

static void settling_is_resumed(void **state)
{
    (void)state;
    static const int steps[] = {1, 39, 41, 100, 101};
    tank t;
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        flume_make(&t, 3, 0.2, sb_vec(8, 0.8, 1.6));
        t.scene.numerics.wall_friction = 0.05;
        check_settling(&t, steps[k], "flume");
        tank_free(&t);
    }
    tank_make(&t, 3, 0.1, sb_vec(2, 0.5, 1.2), 1, 0.8, 0.1);
    tank_repeat(&t, 1);
    t.scene.numerics.settle_steps = 100;
    check_settling(&t, 20, "slab");
    tank_free(&t);
}

static void another_model_is_refused(void **state)
{
    (void)state;
    tank t, other;
    sb_archive_out out = {0};
    sb_error error = {0};
    tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0.1);
    tank_make(&other, 2, 0.1, sb_vec(1, 0, 1), 0.4, 0.5, 0.1);
    sb_sim *sim = tank_sim(&t), *small = tank_sim(&other);
    assert_true(sim && small && tank_steps(sim, 3) == 0);
    tank_save(sim, &out);
    assert_int_equal(tank_load(small, &out, &error), SB_BAD_INPUT);
    assert_non_null(
        strstr(error.text, "saved: section \"sim\": a list of 25 elements of 16 bytes, expected at most 20"));
    sb_sim_destroy(sim);
    sb_sim_destroy(small);
    sb_archive_out_free(&out);
    tank_free(&t);
    tank_free(&other);
}

/* The message names the error; afterwards a good state can be loaded. */
static void impossible_states_are_refused(void **state)
{
    (void)state;
    const sb_wavemaker_parameters law = {.kind = sb_wavemaker_find("gate"), .stroke = 0.1, .speed = 1, .gravity = 9.81};
    tank t;
    sb_archive_out good = {0}, bad = {0};
    sb_error error = {0};
    tank_of_particles(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0.1);
    tank_add_plate(&t, "paddle", -0.05, 0, 0.8, sb_vec(1, 0, 0), &law);
    sb_sim *sim = tank_sim(&t);
    assert_true(sim && tank_steps(sim, 3) == 0);
    const uint64_t hash = sb_sim_hash(sim);
    tank_save(sim, &good);
    struct {
        void *at, *value;
        size_t size;
        const char *text;
    } cases[] = {
        {&sim->state.time, &(double){(double)NAN}, 8, "expected finite numbers"},
        {&sim->state.max_speed, &(double){-1}, 8, "expected finite numbers"},
        {&sim->state.id[2], &(uint32_t){25}, 4, "particle 25 at"},
        {(uint32_t *)&sim->state.position[7] + 2, &(uint32_t){0x80000000u}, 4, "coordinates below 2147483648"},
        {&sim->walls.moving[0].displacement, &(double){1e300}, 8, "moving body 0 is displaced by 1e+300 m"},
        {&sim->walls.moving[0].displacement, &(double){(double)NAN}, 8, "moving body 0 is displaced by nan m"},
        {&sim->state.settle, &(sb_settle){.under_way = true, .done = 3, .most = 1 << 20}, sizeof(sb_settle),
         "settling step 3 of at most 1048576: expected at most"},
        {&sim->walls.moving_count, &(size_t){0}, 8, "different number of moving bodies, expected 1"},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        unsigned char kept[sizeof(sb_settle)];
        memcpy(kept, cases[c].at, cases[c].size);
        memcpy(cases[c].at, cases[c].value, cases[c].size);
        tank_save(sim, &bad);
        memcpy(cases[c].at, kept, cases[c].size);
        assert_int_equal(tank_load(sim, &bad, &error), SB_BAD_INPUT);
        if (!strstr(error.text, cases[c].text)) fail_msg("%zu: %s", c, error.text);
        if (tank_load(sim, &good, &error) != SB_OK) fail_msg("%s", error.text);
        assert_true(sb_sim_hash(sim) == hash);
    }
    assert_int_equal(tank_steps(sim, 3), 0);
    sb_sim_destroy(sim);
    sb_archive_out_free(&good);
    sb_archive_out_free(&bad);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_both_presets(a_dam_break_with_each_solver),
        in_both_presets(a_paddle_in_motion_and_at_rest),
        in_both_presets(a_periodic_slab),
        in_both_presets(water_that_leaves),
        cmocka_unit_test(settled_water_before_its_first_step),
        cmocka_unit_test(settling_is_resumed),
        cmocka_unit_test(settling_is_not_saved_at_its_end),
        cmocka_unit_test(another_model_is_refused),
        cmocka_unit_test(impossible_states_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
