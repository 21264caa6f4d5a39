/* What the monitor remembers of a run: peaks with their times, courses, stage times, and what a restart clears. */
#include "monitor_fixture.h"

#include <math.h>

static void keeps_peaks_and_their_times(void **unused)
{
    (void)unused;
    fixture_run(2);
    assert_int_equal(state.body_count, 2);
    assert_true(state.bodies[1].horizontal == 5 * 2 * 4e5);
    assert_true(state.bodies[1].peak == 5 * 2 * 8e5 && state.bodies[1].peak_time == 44);
    assert_true(state.forces_since == 42);
    fixture_forces(2, 46, 8e5); /* as large as the peak: the first time stays */
    assert_true(state.bodies[1].peak_time == 44);
    sb_monitor_on_restart(&state, 1);
    fixture_forces(2, 3, 1);
    assert_true(state.bodies[1].peak == 10 && state.bodies[1].peak_time == 3 && state.forces_since == 3);
    assert_int_equal(state.bodies[1].course.count, 1);
    assert_false(state.has_status);
}

static void keeps_the_elevations_of_wet_gauges(void **unused)
{
    (void)unused;
    fixture_run(1);
    assert_int_equal(state.gauge_count, 2);
    assert_true(state.gauges[0].eta_low == 0 && state.gauges[0].eta_high == 2 && state.gauges[0].eta == 1);
    assert_false(state.gauges[1].seen);
    assert_int_equal(state.gauges[1].course.count, 0);
}

static void rows_of_a_lost_message_stay_empty(void **unused)
{
    (void)unused;
    static sb_forces_message m = {.time = 1, .total = 9, .first = 4, .count = 1};
    sb_monitor_state_start(&state, sb_clock());
    snprintf(m.names[0], sizeof m.names[0], "fourth");
    m.force[0] = 7;
    sb_monitor_on_forces(&state, &m);
    assert_int_equal(state.body_count, 5);
    assert_int_equal(state.bodies_total, 9);
    assert_string_equal(state.bodies[4].name, "fourth");
    assert_string_equal(state.bodies[0].name, "");
    view = (sb_view){0};
    fixture_draw(80, 24);
    fixture_shows("fourth");
    sb_cells_free(&cells);
}

static void joins_intervals_of_a_long_course(void **unused)
{
    (void)unused;
    sb_history course = {0};
    for (int i = 0; i < SB_HISTORY; i++) sb_history_add(&course, i);
    assert_int_equal(course.count, SB_HISTORY);
    assert_true(course.value[SB_HISTORY - 1] == SB_HISTORY - 1);
    course = (sb_history){0};
    for (int i = 0; i < 1000; i++) sb_history_add(&course, i == 611 ? -5 : i % 3 == 0 ? 1 : 0.5);
    assert_int_equal(course.stride, 16);
    assert_int_equal(course.count, 63); /* 62 intervals of 16 samples, one of 8 */
    for (int i = 0; i < course.count; i++) assert_true(course.value[i] == (i == 611 / 16 ? -5 : 1));
}

static void knows_the_time_that_a_step_takes(void **unused)
{
    (void)unused;
    fixture_run(1);
    assert_true(fabs(state.stage_step[1] - 0.003) < 1e-12);
    sb_status_message m = fixture_status(1500); /* repeated: the value stays */
    sb_monitor_on_status(&state, &m);
    assert_true(fabs(state.stage_step[1] - 0.003) < 1e-12);
    m = fixture_status(1510);
    snprintf(m.stages[1], sizeof m.stages[1], "other");
    sb_monitor_on_status(&state, &m);
    assert_true(state.stage_step[1] < 0 && fabs(state.stage_step[0] - 0.001) < 1e-12);
}

/* A paused run repeats its status: the course does not grow, and the highest value is never below the present one. */
static void a_pause_adds_nothing_to_courses(void **unused)
{
    (void)unused;
    fixture_run(1);
    const int before = state.course[SB_QUANTITY_SPEED].count;
    sb_status_message m = fixture_status(1501);
    m.state = SB_RUN_PAUSED;
    m.max_speed = 30;
    for (int i = 0; i < 5; i++) sb_monitor_on_status(&state, &m);
    assert_int_equal(state.course[SB_QUANTITY_SPEED].count, before);
    assert_true(state.highest[SB_QUANTITY_SPEED] == 30 && state.value[SB_QUANTITY_SPEED] == 30);
}

static void knows_the_share_of_lost_messages(void **unused)
{
    (void)unused;
    fixture_run(1);
    state.count = (sb_live_counts){.messages = 100, .refused = 5, .foreign = 5, .lost = 10};
    assert_true(fabs(sb_monitor_state_lost(&state) - 0.1) < 1e-12);
    state.count = (sb_live_counts){0};
    assert_true(sb_monitor_state_lost(&state) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keeps_peaks_and_their_times),       cmocka_unit_test(keeps_the_elevations_of_wet_gauges),
        cmocka_unit_test(rows_of_a_lost_message_stay_empty), cmocka_unit_test(joins_intervals_of_a_long_course),
        cmocka_unit_test(knows_the_time_that_a_step_takes),  cmocka_unit_test(a_pause_adds_nothing_to_courses),
        cmocka_unit_test(knows_the_share_of_lost_messages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
