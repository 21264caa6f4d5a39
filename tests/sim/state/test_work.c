/* The workspace: views that are alive in the same phase of a step have separate memory. */
#include "check.h"
#include "sim/pressure/pressure.h"
#include "sim/simulation.h"
#include "sim/tank.h"

#include <stdio.h>
#include <string.h>

static const char *entries_of(const sb_sim *sim, const sb_work_view *view)
{
    const char *entries;
    memcpy(&entries, (const char *)&sim->work + view->pointer, sizeof entries);
    return entries;
}

static size_t length_of(const sb_sim *sim, const sb_work_view *view)
{
    return view->size * (view->ghosts ? sim->work.capacity : sim->work.owned);
}

static bool alive_together(const sb_work_view *a, const sb_work_view *b)
{
    return a->first <= b->last && b->first <= a->last;
}

static bool takes_over(const sb_work_view *a, const sb_work_view *b)
{
    return a->replaces && strcmp(a->replaces, b->name) == 0;
}

/* Checks all pairs of views. Returns the number of views that the scene has. */
static size_t check_views(const sb_sim *sim)
{
    size_t found = 0;
    const char *block = sim->work.block;
    for (const sb_work_view *a = sb_work_views; a->name; a++) {
        const char *at = entries_of(sim, a);
        assert_true((at != NULL) == sb_needed(&sim->needs, a->needed));
        if (!at) continue;
        found++;
        assert_true(at >= block && at + length_of(sim, a) <= block + sim->work.bytes);
        assert_int_equal((uintptr_t)at % 64, 0);
        for (const sb_work_view *b = sb_work_views; b->name; b++) {
            const char *other = entries_of(sim, b);
            if (b == a || !other || !alive_together(a, b)) continue;
            const bool apart = at + length_of(sim, a) <= other || other + length_of(sim, b) <= at;
            if (takes_over(a, b) || takes_over(b, a))
                assert_ptr_equal(at, other);
            else if (!apart)
                fail_msg("%s and %s share memory", a->name, b->name);
        }
    }
    return found;
}

static void views_alive_together_are_apart(void **state)
{
    (void)state;
    for (int solver = 0; sb_pressure_solvers[solver]; solver++)
        for (int terms = 0; terms < 2; terms++)
            for (int repeats = 0; repeats < 2; repeats++) {
                tank t;
                tank_make(&t, 3, 0.1, sb_vec(0.6, 0.5, 0.8), 0.6, 0.5, 0.1);
                if (repeats) tank_repeat(&t, 0);
                t.scene.numerics.solver = (enum sb_solver)solver;
                t.scene.numerics.density = terms ? SB_DENSITY_COMPLETED : SB_DENSITY_SUMMED;
                if (terms) tank_add_terms(&t);
                if (!terms) t.scene.numerics.stress_correction = 0;
                sb_sim *sim = tank_sim(&t);
                assert_non_null(sim);
                const size_t before = check_views(sim);
                assert_int_equal(tank_steps(sim, 2), 0); /* ghosts enlarge the workspace */
                assert_int_equal(check_views(sim), before);
                assert_true((sim->state.capacity > sim->state.owned) == repeats);
                sb_sim_destroy(sim);
                tank_free(&t);
            }
}

/* Bytes of the workspace per particle in the usual settings. */
static void check_bytes(bool particles, size_t most)
{
    tank t;
    (particles ? tank_of_particles : tank_make)(&t, 3, 0.1, sb_vec(2, 1, 1.5), 2, 1, 0.1);
    t.scene.numerics.density = SB_DENSITY_COMPLETED;
    t.scene.numerics.stress_correction = 1;
    t.scene.numerics.wall_friction = 0.05;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    printf("%.1f bytes per particle\n", (double)sim->work.bytes / (double)sim->state.owned);
    assert_true(sim->work.bytes <= most * (sim->state.owned + 32) + 64);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Walls of boundary particles need at most 100, as before the views were placed by rows. Those that reflect the water
   have no lists and vectors of boundary particles, and need 90. */
static void the_usual_workspace_is_small(void **state)
{
    (void)state;
    check_bytes(true, 100);
    check_bytes(false, 90);
}

/* Names are unique, and each row says its unit. */
static void rows_are_complete(void **state)
{
    (void)state;
    for (const sb_work_view *a = sb_work_views; a->name; a++) {
        assert_non_null(a->unit);
        assert_true(a->first <= a->last && a->last < SB_PHASES);
        for (const sb_work_view *b = sb_work_views; b < a; b++) assert_string_not_equal(a->name, b->name);
    }
    for (const sb_state_field *a = sb_state_fields; a->name; a++) {
        assert_non_null(a->unit);
        assert_true(a->size == 4 || a->size == 16);
        for (const sb_state_field *b = sb_state_fields; b < a; b++) assert_string_not_equal(a->name, b->name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_alive_together_are_apart),
        cmocka_unit_test(the_usual_workspace_is_small),
        cmocka_unit_test(rows_are_complete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
