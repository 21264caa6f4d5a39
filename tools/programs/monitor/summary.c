#include "summary.h"

#include "text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BAR_MAX = 60, BAR_MIN = 10, SPARK = 16 };

sb_style sb_summary_state(char *out, size_t size, const sb_monitor_state *state, double now)
{
    const double silent = now - state->last_data;
    const bool done = state->has_status && state->status.state == SB_RUN_DONE;
    if (done || (state->has_status && sb_monitor_state_progress(state) >= 1)) {
        const bool complete = sb_monitor_state_progress(state) >= 1;
        snprintf(out, size, "%s", complete ? "done" : "done: ended before its duration");
        return complete ? SB_STYLE_GOOD : SB_STYLE_BAD;
    }
    if (silent >= SB_MONITOR_SILENCE) {
        snprintf(out, size, "no data for %.0f s%s", floor(silent),
                 state->has_status ? "" : ": is a run streaming to this URL and prefix?");
        return SB_STYLE_BAD;
    }
    if (!state->has_status) {
        snprintf(out, size, "waiting for a run");
        return SB_STYLE_PLAIN;
    }
    snprintf(out, size, "%s", sb_run_state_name(state->status.state));
    return state->status.state == SB_RUN_PAUSED ? SB_STYLE_ACCENT : SB_STYLE_GOOD;
}

/* A long name is cut: the state must be seen. */
static void draw_title(sb_cells *cells, const sb_monitor_state *state, double now)
{
    char text[120];
    const sb_style style = sb_summary_state(text, sizeof text, state, now);
    const bool wide = cells->width >= 60;
    const int width = cells->width, columns = sb_cells_columns(text);
    int column = wide ? sb_cells_put(cells, 0, 0, SB_STYLE_BOLD, "shorebreak") + 2 : 0;
    if (state->has_status) {
        const int room = width - column - columns - 2;
        if (room > 0) column = sb_cells_print(cells, 0, column, SB_STYLE_ACCENT, "%.*s", room, state->status.run) + 2;
    }
    sb_cells_put(cells, 0, column, style, text);
}

static int draw_progress(sb_cells *cells, const sb_monitor_state *state)
{
    const sb_status_message *status = &state->status;
    char bar[4 * BAR_MAX + 1], eta[40], wall[40], time[40], end[40];
    const int third = cells->width / 3;
    sb_line line = sb_line_begin(cells, 1, 2);
    sb_text_bar(bar,
                third > BAR_MAX   ? BAR_MAX
                : third < BAR_MIN ? BAR_MIN
                                  : third,
                sb_monitor_state_progress(state), -1, cells->utf8);
    sb_text_duration(eta, sizeof eta, status->eta_seconds);
    sb_text_duration(wall, sizeof wall, status->wall_seconds);
    sb_text_number(time, sizeof time, status->time, false);
    sb_text_number(end, sizeof end, status->duration, false);
    sb_line_add(&line, SB_STYLE_ACCENT, "%s", bar);
    line.column -= 2; /* the number has blanks of its own */
    sb_line_add(&line, SB_STYLE_BOLD, "%6.1f %%", 100 * sb_monitor_state_progress(state));
    sb_line_add(&line, SB_STYLE_PLAIN, "%s of %s s", time, end);
    sb_line_add(&line, SB_STYLE_BOLD, "ETA %s", eta);
    if (line.rows == 2) sb_line_break(&line);
    sb_line_add(&line, SB_STYLE_PLAIN, "step %" PRId64, status->step);
    sb_line_add(&line, SB_STYLE_PLAIN, "dt %.4g ms", 1e3 * status->time_step);
    sb_line_add(&line, SB_STYLE_PLAIN, "particles %" PRId64, status->fluid_particles);
    sb_line_add(&line, status->lost_particles > 0 ? SB_STYLE_BAD : SB_STYLE_PLAIN, "lost particles %" PRId64,
                status->lost_particles);
    sb_line_add(&line, SB_STYLE_PLAIN, "run time %s", wall);
    return 3;
}

static void add_spark(sb_line *line, const sb_monitor_state *state, sb_monitor_quantity quantity)
{
    char text[3 * SPARK + 1];
    const sb_history *course = &state->course[quantity];
    sb_text_spark(text, SPARK, course->value, course->count, 0, state->highest[quantity], line->cells->utf8);
    line->column--; /* one blank between the number and its course */
    if (*text && !sb_line_add(line, SB_STYLE_ACCENT, "%s", text)) line->column++;
}

static void draw_convergence(sb_cells *cells, int row, const sb_monitor_state *state)
{
    const sb_status_message *status = &state->status;
    const bool sparks = cells->width >= 78;
    sb_line line = sb_line_begin(cells, row, 1);
    sb_line_add(&line, SB_STYLE_PLAIN, "iterations %d", (int)status->iterations);
    if (sparks) add_spark(&line, state, SB_QUANTITY_ITERATIONS);
    sb_line_add(&line, SB_STYLE_PLAIN, "density error %.3g of %.3g %%", 100 * status->density_error,
                100 * status->tolerance);
    if (sparks) add_spark(&line, state, SB_QUANTITY_ERROR);
    sb_line_add(&line, SB_STYLE_PLAIN, "max speed %.4g m/s", status->max_speed);
    sb_line_add(&line, SB_STYLE_PLAIN, "largest error %.3g %%", 100 * status->density_error_max);
    sb_line_add(&line, SB_STYLE_PLAIN, "capped steps %" PRId64, status->capped_steps);
}

static void draw_stream(sb_cells *cells, int row, const sb_monitor_state *state)
{
    const sb_live_counts *count = &state->count;
    sb_line line = sb_line_begin(cells, row, 1);
    sb_line_add(&line, SB_STYLE_PLAIN, "messages lost %" PRIu64, count->lost);
    sb_line_add(&line, count->refused > 0 ? SB_STYLE_BAD : SB_STYLE_PLAIN, "refused %" PRIu64, count->refused);
    if (count->restarts > 0) sb_line_add(&line, SB_STYLE_PLAIN, "run restarts %" PRIu64, count->restarts);
    if (state->receiver_restarts > 0)
        sb_line_add(&line, SB_STYLE_BAD, "receiver restarts %u", state->receiver_restarts);
    sb_line_add(&line, SB_STYLE_PLAIN, "frames %" PRIu64 " complete, %" PRIu64 " partial", count->frames_complete,
                count->frames_partial);
    sb_line_add(&line, SB_STYLE_PLAIN, "repaired %" PRIu64, count->parts_repaired);
    sb_line_add(&line, SB_STYLE_PLAIN, "%.1f messages/s", state->message_rate);
    sb_line_add(&line, SB_STYLE_PLAIN, "%.2f MB/s", 1e-6 * state->byte_rate);
}

int sb_summary_draw(sb_cells *cells, const sb_monitor_state *state, double now, bool brief)
{
    draw_title(cells, state, now);
    int rows = 1;
    if (state->has_status) rows = draw_progress(cells, state);
    if (brief) return rows;
    if (state->has_status) draw_convergence(cells, rows++, state);
    draw_stream(cells, rows++, state);
    return rows;
}
