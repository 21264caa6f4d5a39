#include "table.h"

#include "text.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#define STALE_SECONDS 5

enum { BAR_BYTES = 4 * 256 + 1, NAME_COLUMNS = 20, HALF_BAR = 4 };

#define BOLD "\x1b[1m"
#define DIM "\x1b[2m"
#define RED "\x1b[1;31m"
#define GREEN "\x1b[32m"
#define CYAN "\x1b[36m"

typedef struct canvas {
    FILE *out;
    const sb_table_style *style;
    int rows;
} canvas;

static const char *paint(const canvas *to, const char *colour)
{
    return to->style->colour ? colour : "";
}

static const char *plain(const canvas *to)
{
    return paint(to, "\x1b[0m");
}

static void end_row(canvas *to)
{
    fprintf(to->out, "%s\n", to->style->line_end);
    to->rows++;
}

static double progress(const sb_status_message *status)
{
    double share = status->duration > 0 ? status->time / status->duration : 0;
    return share > 1 ? 1 : share > 0 ? share : 0;
}

static void draw_title(canvas *to, const sb_monitor_state *state, double now)
{
    double silent = now - state->last_data;
    fprintf(to->out, "%sshorebreak%s  %s%s%s  ", paint(to, BOLD), plain(to), paint(to, CYAN),
            state->has_status ? state->status.run : "-", plain(to));
    if (state->has_status && progress(&state->status) >= 1)
        fprintf(to->out, "%scomplete%s", paint(to, GREEN), plain(to));
    else if (silent >= STALE_SECONDS)
        fprintf(to->out, "%sno data for %.0f s%s%s", paint(to, RED), floor(silent), plain(to),
                state->has_status ? "" : ": is a run streaming to this URL and prefix?");
    else if (!state->has_status)
        fprintf(to->out, "waiting for a run");
    else if (state->status.state == SB_RUN_PAUSED)
        fprintf(to->out, "%spaused%s", paint(to, CYAN), plain(to));
    else if (state->status.state == SB_RUN_DONE)
        fprintf(to->out, "%sended before its duration%s", paint(to, RED), plain(to));
    else
        fprintf(to->out, "%slive%s", paint(to, GREEN), plain(to));
    if (state->count.restarts > 0)
        fprintf(to->out, "  restarted %llu times", (unsigned long long)state->count.restarts);
    end_row(to);
}

static void draw_status(canvas *to, const sb_status_message *status)
{
    char bar[BAR_BYTES], eta[40], wall[40], time[40], end[40];
    int cells = to->style->width / 3;
    sb_text_bar(bar, cells > 60 ? 60 : cells < 10 ? 10 : cells, progress(status), -1, to->style->utf8);
    sb_text_duration(eta, sizeof eta, status->eta_seconds);
    sb_text_duration(wall, sizeof wall, status->wall_seconds);
    sb_text_number(time, sizeof time, status->time, false);
    sb_text_number(end, sizeof end, status->duration, false);
    fprintf(to->out, "%s%s%s %5.1f %%  %s of %s s  ETA %s", paint(to, CYAN), bar, plain(to), 100 * progress(status),
            time, end, eta);
    end_row(to);
    fprintf(to->out, "step %lld  dt %.4g ms  iterations %d  density error %.3g %%  run time %s",
            (long long)status->step, 1e3 * status->time_step, (int)status->iterations, 100 * status->density_error,
            wall);
    end_row(to);
    fprintf(to->out, "max speed %.4g m/s  particles %lld  %slost %lld%s", status->max_speed,
            (long long)status->fluid_particles, status->lost_particles ? paint(to, RED) : "",
            (long long)status->lost_particles, plain(to));
    end_row(to);
}

static void draw_stream(canvas *to, const sb_monitor_state *state)
{
    const sb_live_counts *count = &state->count;
    fprintf(to->out, "stream  %.1f messages/s  %.2f MB/s  ", state->message_rate, 1e-6 * state->byte_rate);
    fprintf(to->out, "%slost %llu%s  ", count->lost ? paint(to, RED) : "", (unsigned long long)count->lost, plain(to));
    fprintf(to->out, "%srefused %llu%s", count->refused ? paint(to, RED) : "", (unsigned long long)count->refused,
            plain(to));
    if (count->foreign > 0) fprintf(to->out, "  of another run %llu", (unsigned long long)count->foreign);
    end_row(to);
    if (count->parts == 0) {
        fprintf(to->out, "frames  none yet");
        end_row(to);
        return;
    }
    fprintf(to->out, "frames  %llu complete  %llu partial  %sparts lost %llu%s",
            (unsigned long long)count->frames_complete, (unsigned long long)count->frames_partial,
            count->parts_lost ? paint(to, RED) : "", (unsigned long long)count->parts_lost, plain(to));
    if (count->frames_complete > 0)
        fprintf(to->out, "  t %.4g s  %lld particles", state->frame_time, (long long)state->frame_particles);
    end_row(to);
}

static void draw_body(canvas *to, const sb_monitor_state *state, const sb_monitor_body *body, int cells,
                      bool components)
{
    char bar[BAR_BYTES], signed_bar[BAR_BYTES], number[40], peak[40];
    sb_text_unit unit = sb_text_force_unit(fmax(state->peak, state->peak_component));
    double scale = state->peak > 0 ? 1 / state->peak : 0;
    double component_scale = state->peak_component > 0 ? 1 / state->peak_component : 0;
    sb_text_bar(bar, cells, scale * body->horizontal, body->peak > 0 ? scale * body->peak : -1, to->style->utf8);
    sb_text_number(number, sizeof number, body->horizontal / unit.size, false);
    sb_text_number(peak, sizeof peak, body->peak / unit.size, false);
    fprintf(to->out, "%-*.*s %s%s%s %9s %9s", NAME_COLUMNS, NAME_COLUMNS, body->name, paint(to, CYAN), bar, plain(to),
            number, peak);
    for (int k = 0; k < 3; k++) {
        sb_text_number(number, sizeof number, body->force[k] / unit.size, true);
        if (components) {
            sb_text_signed_bar(signed_bar, HALF_BAR, component_scale * body->force[k], to->style->utf8);
            fprintf(to->out, " %s%s%s", paint(to, DIM), signed_bar, plain(to));
        }
        fprintf(to->out, " %9s", number);
    }
    end_row(to);
}

static void draw_forces(canvas *to, const sb_monitor_state *state)
{
    /* Columns: 20 for the name, 2 x 10 for magnitude and peak, 3 x 10 for components, 2 blanks; bars take the rest. */
    int room = to->style->width - NAME_COLUMNS - 2 - 50;
    int component_columns = 3 * (2 * HALF_BAR + 2);
    bool components = room >= component_columns + 12;
    int cells = components ? room - component_columns : room;
    cells = cells > 40 ? 40 : cells < 6 ? 6 : cells;
    sb_text_unit unit = sb_text_force_unit(fmax(state->peak, state->peak_component));
    char header[16];
    snprintf(header, sizeof header, "|Fxy| %s", unit.name);
    fprintf(to->out, "%s%-*s %-*s %9s %9s", paint(to, BOLD), NAME_COLUMNS, "body", cells, "horizontal", header, "peak");
    for (int k = 0; k < 3; k++) fprintf(to->out, " %*s%c", components ? 2 * HALF_BAR + 10 : 8, "F", "xyz"[k]);
    fprintf(to->out, "%s", plain(to));
    end_row(to);

    size_t hidden = state->bodies_total > state->body_count ? state->bodies_total - state->body_count : 0;
    for (size_t i = 0; i < state->body_count; i++) {
        if (to->style->height > 0 && to->rows + 2 >= to->style->height)
            hidden++;
        else
            draw_body(to, state, &state->bodies[i], cells, components);
    }
    if (hidden > 0) {
        fprintf(to->out, "and %zu more", hidden);
        end_row(to);
    }
}

void sb_table_draw(FILE *out, const sb_monitor_state *state, const sb_table_style *style, double now)
{
    canvas to = {out, style, 0};
    draw_title(&to, state, now);
    if (state->has_status) draw_status(&to, &state->status);
    draw_stream(&to, state);
    if (state->body_count > 0) {
        end_row(&to);
        draw_forces(&to, state);
    }
}

void sb_table_line(FILE *out, const sb_monitor_state *state)
{
    const sb_status_message *status = &state->status;
    char eta[40];
    sb_text_duration(eta, sizeof eta, status->eta_seconds);
    fprintf(out,
            "%s  %5.1f %%  t %.6g of %.6g s  step %lld  dt %.4g ms  iterations %d  "
            "density error %.3g %%  max speed %.4g m/s  ETA %s  messages lost %llu\n",
            status->run, 100 * progress(status), status->time, status->duration, (long long)status->step,
            1e3 * status->time_step, (int)status->iterations, 100 * status->density_error, status->max_speed, eta,
            (unsigned long long)state->count.lost);
}
