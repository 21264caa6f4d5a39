/* Functions that the monitor's tests share: a state as after some messages of a run, and the text of a screen. */
#ifndef SB_TESTS_MONITOR_FIXTURE_H
#define SB_TESTS_MONITOR_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/clock.h"
#include "layout.h"

#include <stdio.h>
#include <string.h>

static sb_monitor_state state;
static sb_view view;
static sb_cells cells;

static inline sb_status_message fixture_status(int64_t step)
{
    sb_status_message m = {.state = SB_RUN_RUNNING,
                           .step = step,
                           .time = 0.03 * (double)step,
                           .duration = 90,
                           .time_step = 0.0031,
                           .iterations = 17,
                           .capped_steps = 5,
                           .density_error = 4e-4,
                           .density_error_max = 0.0125,
                           .tolerance = 1e-3,
                           .max_speed = 21.25,
                           .wall_seconds = 60.5,
                           .eta_seconds = 33.25,
                           .lost_particles = 3,
                           .fluid_particles = 5000,
                           .decimation = 1,
                           .stage_count = 2,
                           .stages = {"neighbours", "pressure"},
                           .stage_seconds = {0.001 * (double)step, 0.003 * (double)step}};
    snprintf(m.run, sizeof m.run, "a run");
    return m;
}

/* The forces of `count` bodies: that of body i is (3, 4, i) scale (i + 1) N. */
static inline void fixture_forces(int32_t count, double time, double scale)
{
    static sb_forces_message m;
    m = (sb_forces_message){.time = time, .total = count};
    for (int32_t first = 0; first < count; first += m.count) {
        m.first = first;
        m.count = count - first < SB_STREAM_ROWS ? count - first : SB_STREAM_ROWS;
        for (int32_t i = 0; i < m.count; i++) {
            const double size = scale * (first + i + 1);
            snprintf(m.names[i], sizeof m.names[i], "building-%d", (int)(first + i));
            m.force[3 * i] = 3 * size;
            m.force[3 * i + 1] = 4 * size;
            m.force[3 * i + 2] = (first + i) * size;
        }
        sb_monitor_on_forces(&state, &m);
    }
}

static inline void fixture_gauges(double time, double eta)
{
    static sb_gauges_message m;
    m = (sb_gauges_message){.time = time, .total = 2, .count = 2};
    snprintf(m.names[0], sizeof m.names[0], "offshore");
    snprintf(m.names[1], sizeof m.names[1], "quay");
    m.wet[0] = 1;
    m.eta[0] = eta;
    m.z[0] = 10 + eta;
    sb_monitor_on_gauges(&state, &m);
}

/* A run at t = 45 s of 90 s after some forces, the largest of them at t = 44 s. */
static inline void fixture_run(int32_t bodies)
{
    sb_monitor_state_start(&state, sb_clock());
    view = (sb_view){0};
    for (int64_t step = 1498; step <= 1500; step++) {
        const sb_status_message m = fixture_status(step);
        sb_monitor_on_status(&state, &m);
    }
    static const double scales[] = {0, 2, 8, 4};
    for (int i = 0; i < 4; i++) {
        fixture_forces(bodies, 42 + i, 1e5 * scales[i]);
        fixture_gauges(42 + i, 0.25 * scales[i]);
    }
    sb_live_counts counts = {.messages = 95, .bytes = 95000, .lost = 5, .refused = 1, .frames_complete = 7};
    counts.parts_repaired = 2;
    state.count = counts;
}

static inline void fixture_draw(int width, int height)
{
    assert_int_equal(sb_cells_resize(&cells, width, height), SB_OK);
    sb_layout_draw(&cells, &state, &view, state.last_data + 0.1);
}

static inline const char *fixture_row(int row)
{
    static char text[4 * SB_CELLS_WIDTH_MAX + 1];
    sb_cells_row(&cells, row, text, sizeof text);
    return text;
}

/* The row that contains the text, or -1. */
static inline int fixture_find(const char *text)
{
    for (int row = 0; row < cells.height; row++)
        if (strstr(fixture_row(row), text)) return row;
    return -1;
}

/* Fails unless the screen shows the text. */
static inline void fixture_shows(const char *text)
{
    if (fixture_find(text) >= 0) return;
    for (int row = 0; row < cells.height; row++) print_message("%s\n", fixture_row(row));
    fail_msg("\"%s\" is not on the screen", text);
}

static inline void fixture_same(const char *const *rows, int count)
{
    assert_int_equal(cells.height, count);
    for (int row = 0; row < count; row++) assert_string_equal(fixture_row(row), rows[row]);
}

#endif
