/* Stage times and convergence. */
#include "panel.h"
#include "text.h"

#include <math.h>
#include <stdio.h>

enum { NAME = 20, NUMBER = 9, BAR_MAX = 40, BAR_BYTES = 4 * BAR_MAX + 1 };

static int at_most(int value, int most)
{
    return value > most ? most : value < 0 ? 0 : value;
}

static void put_number(sb_strip *strip, const char *format, double value) __attribute__((format(printf, 2, 0)));
static void put_number(sb_strip *strip, const char *format, double value)
{
    char text[400];
    snprintf(text, sizeof text, format, value);
    sb_strip_right(strip, SB_STYLE_PLAIN, NUMBER, 1, text);
}

/* ---- stages ---- */

static int bar_cells(int width)
{
    return at_most(width - (NAME + 1) - 3 * (NUMBER + 1), BAR_MAX);
}

static size_t count_stages(const sb_monitor_state *state)
{
    return state->has_status ? (size_t)state->status.stage_count : 0;
}

static void head_stages(sb_strip strip, const sb_monitor_state *state)
{
    (void)state;
    const int cells = bar_cells(strip.width);
    sb_strip_left(&strip, SB_STYLE_BOLD, strip.width < 50 ? 12 : NAME, 1, "stage");
    sb_strip_right(&strip, SB_STYLE_BOLD, NUMBER, 1, "share %");
    sb_strip_right(&strip, SB_STYLE_BOLD, NUMBER, 1, "time [s]");
    sb_strip_right(&strip, SB_STYLE_BOLD, NUMBER, 1, "ms/step");
    if (cells > 5) sb_strip_left(&strip, SB_STYLE_BOLD, cells, 0, "share");
}

static void row_stages(sb_strip strip, const sb_monitor_state *state, size_t index)
{
    const sb_status_message *status = &state->status;
    const int cells = bar_cells(strip.width);
    double sum = 0;
    for (int i = 0; i < status->stage_count; i++) sum += status->stage_seconds[i];
    const double seconds = status->stage_seconds[index], share = sum > 0 ? seconds / sum : 0;
    sb_strip_left(&strip, SB_STYLE_PLAIN, strip.width < 50 ? 12 : NAME, 1, status->stages[index]);
    put_number(&strip, "%.1f", 100 * share);
    put_number(&strip, "%.4g", seconds);
    if (state->stage_step[index] >= 0)
        put_number(&strip, "%.4g", 1e3 * state->stage_step[index]);
    else
        sb_strip_right(&strip, SB_STYLE_DIM, NUMBER, 1, "-");
    if (cells <= 5) return;
    char bar[BAR_BYTES];
    sb_text_bar(bar, cells, share, -1, strip.cells->utf8);
    sb_strip_left(&strip, SB_STYLE_ACCENT, cells, 0, bar);
}

const sb_panel sb_panel_stages = {
    "Stages", count_stages, head_stages, row_stages, NULL, "no stage times yet",
};

/* ---- convergence ---- */

static const struct {
    const char *name, *unit;
    double scale;
} quantities[SB_QUANTITIES] = {
    [SB_QUANTITY_ITERATIONS] = {"iterations", "", 1},      [SB_QUANTITY_ERROR] = {"density error", "%", 100},
    [SB_QUANTITY_ERROR_MAX] = {"largest error", "%", 100}, [SB_QUANTITY_TIME_STEP] = {"time step", "ms", 1e3},
    [SB_QUANTITY_SPEED] = {"max speed", "m/s", 1},
};

static size_t count_solver(const sb_monitor_state *state)
{
    return state->has_status ? SB_QUANTITIES : 0;
}

static void head_solver(sb_strip strip, const sb_monitor_state *state)
{
    (void)state;
    sb_strip_left(&strip, SB_STYLE_BOLD, 18, 1, "quantity");
    sb_strip_right(&strip, SB_STYLE_BOLD, NUMBER, 1, "now");
    sb_strip_right(&strip, SB_STYLE_BOLD, NUMBER, 1, "highest");
    sb_strip_left(&strip, SB_STYLE_BOLD, strip.width, 0, strip.width >= 7 ? "so far" : "");
}

static void row_solver(sb_strip strip, const sb_monitor_state *state, size_t index)
{
    char name[40];
    snprintf(name, sizeof name, "%s %s", quantities[index].name, quantities[index].unit);
    sb_strip_left(&strip, SB_STYLE_PLAIN, 18, 1, name);
    put_number(&strip, "%.4g", quantities[index].scale * state->value[index]);
    put_number(&strip, "%.4g", quantities[index].scale * state->highest[index]);
    if (strip.width >= 6)
        sb_strip_spark(&strip, at_most(strip.width, SB_HISTORY), 0, &state->course[index], 0, state->highest[index]);
}

static void remark_solver(char *out, size_t size, const sb_monitor_state *state)
{
    if (state->has_status)
        snprintf(out, size, "tolerance %.3g %%, %lld steps capped", 100 * state->status.tolerance,
                 (long long)state->status.capped_steps);
}

const sb_panel sb_panel_solver = {
    "Solver", count_solver, head_solver, row_solver, remark_solver, "no status yet",
};
