/* What the monitor draws on screens of different sizes, compared row by row without a terminal. */
#include "monitor_fixture.h"

#include <stdlib.h>

static int end(void **unused)
{
    (void)unused;
    sb_cells_free(&cells);
    cells.utf8 = false;
    return 0;
}

static void fills_80_columns_and_24_rows(void **unused)
{
    (void)unused;
    fixture_run(30);
    fixture_draw(80, 24);
    static const char *const rows[] = {
        "shorebreak  a run  running",
        "#############.............  50.0 %  45.00 of 90.00 s  ETA 33 s",
        "step 1500  dt 3.1 ms  particles 5000  lost particles 3  run time 1 min 01 s",
        "iterations 17 @@@  density error 0.04 of 0.1 % @@@  max speed 21.25 m/s",
        "messages lost 5  refused 1  frames 7 complete, 0 partial  repaired 2  0.00 MB/s",
        "",
        "[Forces] Gauges  Stages  Solver  Stream     peaks since 42 s, rows 1 to 14 of 30",
        "body                 so far                       |Fxy| MN       peak   at t [s]",
        "building-0           _-@+                             2.00       4.00      44.00",
        "building-1           _-@+                             4.00       8.00      44.00",
        "building-2           _-@+                             6.00      12.00      44.00",
        "building-3           _-@+                             8.00      16.00      44.00",
        "building-4           _-@+                            10.00      20.00      44.00",
        "building-5           _-@+                            12.00      24.00      44.00",
        "building-6           _-@+                            14.00      28.00      44.00",
        "building-7           _-@+                            16.00      32.00      44.00",
        "building-8           _-@+                            18.00      36.00      44.00",
        "building-9           _-@+                            20.00      40.00      44.00",
        "building-10          _-@+                            22.00      44.00      44.00",
        "building-11          _-@+                            24.00      48.00      44.00",
        "building-12          _-@+                            26.00      52.00      44.00",
        "building-13          _-@+                            28.00      56.00      44.00",
        "",
        "q quit  ? help  Tab panel  p pause  r resume  s step  Up/Down/PgUp/PgDn scroll",
    };
    fixture_same(rows, sizeof rows / sizeof *rows);
}

static void leaves_out_columns_on_a_small_screen(void **unused)
{
    (void)unused;
    fixture_run(30);
    fixture_draw(40, 12);
    static const char *const rows[] = {
        "a run  running",
        "#######......  50.0 %  45.00 of 90.00 s",
        "ETA 33 s  step 1500  dt 3.1 ms",
        "[Forces]               rows 1 to 6 of 30",
        "body        so far   |Fxy| MN       peak",
        "building-0  _-@+         2.00       4.00",
        "building-1  _-@+         4.00       8.00",
        "building-2  _-@+         6.00      12.00",
        "building-3  _-@+         8.00      16.00",
        "building-4  _-@+        10.00      20.00",
        "building-5  _-@+        12.00      24.00",
        "q quit  ? help  Tab panel  p pause",
    };
    fixture_same(rows, sizeof rows / sizeof *rows);
}

static void shows_all_panels_on_a_large_screen(void **unused)
{
    (void)unused;
    fixture_run(30);
    fixture_draw(200, 60);
    fixture_shows(
        "iterations 17 @@@  density error 0.04 of 0.1 % @@@  max speed 21.25 m/s  largest error 1.25 %  capped");
    fixture_shows(
        "building-29          _-@+             60.00     120.00      44.00     +36.00     +48.00    +348.00   ");
    fixture_shows(
        "   offshore             _-@+                                   +1.00      11.00      +0.00      +2.00");
    fixture_shows(
        "   quay                                                          dry          -          -          -");
    fixture_shows("   pressure                  75.0       4.5         3 ##############################..........");
    fixture_shows("   density error %         0.04      0.04 @@@");
    fixture_shows(
        "   Solver                                                             tolerance 0.1 %, 5 steps capped");
    fixture_shows("   messages lost      5, 5.1 %");
    fixture_shows("   receiver restarts  0");
}

/* At any size, no row is wider than the screen, the state is shown, and a number is shown as a whole or not at all. */
static void adapts_to_any_size(void **unused)
{
    (void)unused;
    fixture_run(7);
    cells.utf8 = true;
    for (int height = 1; height <= 70; height += 7) {
        for (int width = 1; width <= 230; width++) {
            for (int panel = 0; panel < SB_PANELS; panel++) {
                view.panel = (sb_panel_kind)panel;
                view.help = width % 7 == 0;
                fixture_draw(width, height);
                assert_true(sb_cells_columns(fixture_row(height - 1)) <= width);
                if (width >= 9) assert_int_equal(fixture_find("running"), 0);
                const char *progress = height > 1 ? strstr(fixture_row(1), " of ") : NULL;
                if (progress) assert_memory_equal(progress, " of 90.00 s", strlen(" of 90.00 s"));
            }
        }
    }
}

static void keys(const char *pressed)
{
    for (; *pressed; pressed++) assert_int_equal(sb_view_key(&view, *pressed), SB_ACTION_NONE);
}

static void key(int code, int times)
{
    for (int i = 0; i < times; i++) assert_int_equal(sb_view_key(&view, code), SB_ACTION_NONE);
}

static void scrolls_and_changes_panels(void **unused)
{
    (void)unused;
    fixture_run(600); /* more than the monitor keeps */
    fixture_draw(80, 24);
    fixture_shows("rows 1 to 14 of 600");
    key(SB_KEY_DOWN, 3);
    key(SB_KEY_PAGE_DOWN, 1);
    fixture_draw(80, 24);
    fixture_shows("rows 17 to 30 of 600");
    assert_int_equal(fixture_find("building-16"), 8);
    key(SB_KEY_END, 1);
    fixture_draw(80, 24);
    fixture_shows("rows 499 to 512 of 600");
    key(SB_KEY_UP, 1);
    fixture_draw(80, 60); /* a larger terminal shows more rows, the last ones included */
    fixture_shows("rows 463 to 512 of 600");
    key(SB_KEY_HOME, 1);
    key(SB_KEY_UP, 1);
    fixture_draw(80, 24);
    fixture_shows("rows 1 to 14 of 600");
    keys("\t");
    fixture_draw(80, 24);
    fixture_shows(" Forces [Gauges] Stages ");
    fixture_shows("offshore");
    key(SB_KEY_BACK_TAB, 2);
    fixture_draw(80, 24);
    fixture_shows(" Solver [Stream]");
    keys("\t?");
    fixture_draw(80, 24);
    fixture_shows("PgUp PgDn   scroll by a page");
    key(SB_KEY_RESIZE, 1);
    fixture_draw(81, 24);
    fixture_shows("PgUp PgDn   scroll by a page");
    keys("?");
    fixture_draw(80, 24);
    fixture_shows("[Forces]");
    assert_int_equal(sb_view_key(&view, 'p'), SB_ACTION_PAUSE);
    assert_int_equal(sb_view_key(&view, 'r'), SB_ACTION_RESUME);
    assert_int_equal(sb_view_key(&view, 's'), SB_ACTION_STEP);
    assert_int_equal(sb_view_key(&view, 'q'), SB_ACTION_QUIT);
}

static void says_in_words_what_the_run_does(void **unused)
{
    (void)unused;
    sb_monitor_state_start(&state, sb_clock());
    view = (sb_view){0};
    fixture_draw(80, 24);
    assert_string_equal(fixture_row(0), "shorebreak  waiting for a run");
    state.last_data -= 7;
    fixture_draw(80, 24);
    assert_string_equal(fixture_row(0), "shorebreak  waiting for a run");
    sb_layout_draw(&cells, &state, &view, state.last_data + 7);
    assert_string_equal(fixture_row(0), "shorebreak  no data for 7 s: is a run streaming to this URL and prefix?");
    fixture_run(1);
    state.status.state = SB_RUN_PAUSED;
    fixture_draw(80, 24);
    assert_string_equal(fixture_row(0), "shorebreak  a run  paused");
    sb_layout_draw(&cells, &state, &view, state.last_data + 4);
    assert_string_equal(fixture_row(0), "shorebreak  a run  no data for 4 s");
    state.status.state = SB_RUN_DONE;
    sb_layout_draw(&cells, &state, &view, state.last_data + 100);
    assert_string_equal(fixture_row(0), "shorebreak  a run  done: ended before its duration");
    state.status.time = 90;
    fixture_draw(80, 24);
    assert_string_equal(fixture_row(0), "shorebreak  a run  done");
    memset(state.status.run, 'x', SB_STREAM_NAME - 1); /* a long name does not hide the state */
    fixture_draw(40, 12);
    fixture_shows("xxx  done");
}

static void draws_bars_in_unicode_only_where_it_is_allowed(void **unused)
{
    (void)unused;
    fixture_run(30);
    cells.utf8 = true;
    fixture_draw(80, 24);
    fixture_shows("█████████████·············  50.0 %");
    fixture_shows("building-0           ▁▃█▅                             2.00");
    cells.utf8 = false;
    for (int panel = 0; panel < SB_PANELS; panel++) {
        view.panel = (sb_panel_kind)panel;
        fixture_draw(200, 60);
        for (int i = 0; i < 200 * 60; i++) assert_in_range(cells.cells[i].glyph, 0x20, 0x7e);
    }
}

/* Names come from a network. The decoder replaces what is not printable ASCII; the screen does not rely on it. */
static void shows_no_control_characters(void **unused)
{
    (void)unused;
    fixture_run(1);
    memcpy(state.status.run, "a\x1b[31m\x9b\xc2\x9b\xff\n\x7f\xc0\x80\xe2\x82", 17);
    snprintf(state.bodies[0].name, sizeof state.bodies[0].name, "b\x1b]0;x\x07\r");
    sb_view_note(&view, state.last_data, "\x1b[2J%s", "note");
    fixture_draw(80, 24);
    assert_string_equal(fixture_row(0), "shorebreak  a?[31m????????  running");
    fixture_shows("b?]0;x??");
    assert_string_equal(fixture_row(23), "?[2Jnote");
    for (int i = 0; i < 80 * 24; i++) assert_false(cells.cells[i].glyph < 0x20 || cells.cells[i].glyph == 0x7f);
}

/* Numbers of a hostile run leave no column. */
static void keeps_columns_with_extreme_numbers(void **unused)
{
    (void)unused;
    static const double extremes[] = {1e308, -1e308, 5e-324, 0};
    fixture_run(1);
    for (size_t i = 0; i < 4; i++) {
        sb_status_message m = fixture_status(INT64_MAX - (int64_t)i);
        m.time = m.duration = m.time_step = m.eta_seconds = m.wall_seconds = extremes[i];
        m.density_error = m.density_error_max = m.tolerance = m.max_speed = extremes[i];
        m.stage_seconds[0] = extremes[i];
        sb_monitor_on_status(&state, &m);
        fixture_forces(1, extremes[i], extremes[i]);
        fixture_gauges(extremes[i], extremes[i]);
        for (int panel = 0; panel < SB_PANELS; panel++) {
            view.panel = (sb_panel_kind)panel;
            fixture_draw(80, 24);
            fixture_draw(200, 60);
            fixture_draw(40, 12);
        }
    }
    view.panel = SB_PANEL_FORCES;
    fixture_draw(80, 24);
    fixture_shows("building-0 ");
}

static void a_long_message_takes_several_rows(void **unused)
{
    (void)unused;
    fixture_run(30);
    sb_view_note(&view, state.last_data, "a command needs the token of the run: start the run with --control");
    fixture_draw(40, 12);
    assert_string_equal(fixture_row(9), "building-4  _-@+        10.00      20.00");
    assert_string_equal(fixture_row(10), "a command needs the token of the run:");
    assert_string_equal(fixture_row(11), "start the run with --control");
    sb_layout_draw(&cells, &state, &view, state.last_data + 60);
    assert_string_equal(fixture_row(11), "q quit  ? help  Tab panel  p pause");
    for (int width = 1; width < 90; width++) fixture_draw(width, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(fills_80_columns_and_24_rows, end),
        cmocka_unit_test_teardown(leaves_out_columns_on_a_small_screen, end),
        cmocka_unit_test_teardown(shows_all_panels_on_a_large_screen, end),
        cmocka_unit_test_teardown(adapts_to_any_size, end),
        cmocka_unit_test_teardown(scrolls_and_changes_panels, end),
        cmocka_unit_test_teardown(says_in_words_what_the_run_does, end),
        cmocka_unit_test_teardown(draws_bars_in_unicode_only_where_it_is_allowed, end),
        cmocka_unit_test_teardown(shows_no_control_characters, end),
        cmocka_unit_test_teardown(a_long_message_takes_several_rows, end),
        cmocka_unit_test_teardown(keeps_columns_with_extreme_numbers, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
