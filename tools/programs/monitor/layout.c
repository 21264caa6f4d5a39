#include "layout.h"

#include "panel.h"
#include "summary.h"
#include "text.h"

#include <string.h>

/* Screens of at least these rows and columns have a full summary, all tabs, two columns of panels. */
enum { TALL = 20, TABS = 60, TWO_COLUMNS = 150, BLOCK_MIN = 4 };

/* A part of the screen for panels, one below the other. */
typedef struct area {
    sb_cells *cells;
    int top, left, width, height;
} area;

/* Limits the scroll position. Returns the rows that are drawn. */
static size_t visible(size_t *scroll, size_t count, int room)
{
    const size_t most = room > 0 ? (size_t)room : 0;
    const size_t shown = count < most ? count : most;
    if (*scroll > count - shown) *scroll = count - shown;
    return shown;
}

/* The tabs, of which the chosen one is in brackets; where they do not fit or the panel is not the chosen one, its name.
   At the right end a remark, of the first of these texts that fits. */
static void draw_name(const area *in, sb_panel_kind kind, bool chosen, const char *const remarks[2])
{
    sb_strip strip = {in->cells, in->top, in->left, in->width};
    for (int i = 0; i < SB_PANELS; i++) {
        const bool own = i == (int)kind;
        if (!own && (!chosen || in->width < TABS)) continue;
        char text[40];
        snprintf(text, sizeof text, !chosen ? "%s" : own ? "[%s]" : " %s ", sb_panel_find((sb_panel_kind)i)->name);
        const sb_style style = !own ? SB_STYLE_PLAIN : chosen ? SB_STYLE_INVERSE : SB_STYLE_BOLD;
        sb_strip_left(&strip, style, sb_cells_columns(text), 0, text);
    }
    for (int i = 0; i < 2; i++) {
        if (sb_cells_columns(remarks[i]) + 2 > strip.width) continue;
        sb_strip_right(&strip, SB_STYLE_DIM, strip.width, 0, remarks[i]);
        break;
    }
}

/* Draws the panel's name with a remark: which rows are shown if not all are, and what the panel adds. */
static void draw_title(const area *in, const sb_monitor_state *state, sb_panel_kind kind, bool chosen, size_t first,
                       size_t shown)
{
    const sb_panel *panel = sb_panel_find(kind);
    const size_t count = panel->count(state);
    size_t total = count;
    if (kind == SB_PANEL_FORCES && state->bodies_total > total) total = state->bodies_total;
    if (kind == SB_PANEL_GAUGES && state->gauges_total > total) total = state->gauges_total;
    char own[120] = "", rows[80] = "", both[204];
    if (panel->remark && count > 0) panel->remark(own, sizeof own, state);
    if (shown < total)
        snprintf(rows, sizeof rows, "rows %zu to %zu of %zu", shown > 0 ? first + 1 : 0, first + shown, total);
    snprintf(both, sizeof both, "%s%s%s", own, *own && *rows ? ", " : "", rows);
    const char *const remarks[2] = {both, *rows ? rows : own};
    draw_name(in, kind, chosen, remarks);
}

/* Draws a panel at the top of the area and takes its rows from it. */
static void draw_panel(area *in, const sb_monitor_state *state, sb_panel_kind kind, size_t *scroll, bool chosen,
                       size_t *page)
{
    const sb_panel *panel = sb_panel_find(kind);
    const size_t count = panel->count(state), shown = visible(scroll, count, in->height - 2);
    draw_title(in, state, kind, chosen, *scroll, shown);
    sb_strip strip = {in->cells, in->top + 1, in->left, in->width};
    if (in->height >= 2) {
        if (count > 0)
            panel->header(strip, state);
        else
            sb_strip_left(&strip, SB_STYLE_DIM, strip.width, 0, panel->empty);
    }
    for (size_t i = 0; i < shown; i++) {
        strip = (sb_strip){in->cells, in->top + 2 + (int)i, in->left, in->width};
        panel->row(strip, state, *scroll + i);
    }
    if (page) *page = shown;
    const int used = 2 + (int)shown + 1; /* and a blank row */
    in->top += used;
    in->height -= used;
}

/* Draws the chosen panel, and below or beside it those of the following ones that fit. */
static void draw_panels(area in, const sb_monitor_state *state, sb_view *view)
{
    enum { GAP = 3 };
    area beside = in;
    const bool two = in.width >= TWO_COLUMNS;
    if (two) {
        in.width = (in.width - GAP) / 2;
        beside.left += in.width + GAP;
        beside.width = in.width;
    }
    draw_panel(&in, state, view->panel, &view->scroll[view->panel], true, &view->page);
    for (int i = 1; i < SB_PANELS; i++) {
        const sb_panel_kind kind = (sb_panel_kind)(((int)view->panel + i) % SB_PANELS);
        size_t none = 0;
        if (sb_panel_find(kind)->count(state) == 0) continue;
        area *at = two && beside.height >= BLOCK_MIN ? &beside : &in;
        if (at->height >= BLOCK_MIN) draw_panel(at, state, kind, &none, false, NULL);
    }
}

static void draw_help(const area *in)
{
    static const char *const lines[] = {
        "q           quit",
        "p r s       pause the run, resume it, do one step",
        "Tab         the next panel; Shift-Tab: the one before",
        "Up Down     scroll by a row",
        "PgUp PgDn   scroll by a page; Home and End: to the first and the last row",
        "?           this text; any key closes it",
        "",
        "p, r and s need the token of the run: start the run with --control,",
        "and the monitor with --run RUN_DIR.",
    };
    for (int i = 0; i < (int)(sizeof lines / sizeof *lines) && i < in->height; i++)
        sb_cells_put(in->cells, in->top + i, in->left, SB_STYLE_PLAIN, lines[i]);
}

/* Draws the message in as many rows as it needs, the last of which is the last one of the screen. */
static void draw_note(sb_cells *cells, const char *note)
{
    enum { ROWS_MAX = 5 };
    int begin[ROWS_MAX], length[ROWS_MAX], rows = 0;
    for (int at = 0; note[at] && rows < ROWS_MAX; rows++) {
        int end = at, width = 0;
        while (note[at + width] && width < cells->width) {
            width++;
            if (note[at + width] == ' ' || !note[at + width]) end = at + width;
        }
        if (end == at) end = at + width; /* a word that is longer than a row */
        begin[rows] = at;
        length[rows] = end - at;
        for (at = end; note[at] == ' '; at++) {
        }
    }
    const int top = cells->height - rows;
    for (int i = 0; i < rows; i++) {
        for (int column = 0; column < cells->width; column++) sb_cells_put(cells, top + i, column, SB_STYLE_PLAIN, " ");
        sb_cells_print(cells, top + i, 0, SB_STYLE_BOLD, "%.*s", length[i], note + begin[i]);
    }
}

static void draw_keys(sb_cells *cells, const sb_view *view, double now)
{
    const int row = cells->height - 1;
    if (*view->note && now < view->note_until) {
        draw_note(cells, view->note);
        return;
    }
    sb_line line = sb_line_begin(cells, row, 1);
    static const char *const keys[] = {
        "q quit", "? help", "Tab panel", "p pause", "r resume", "s step", "Up/Down/PgUp/PgDn scroll"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) sb_line_add(&line, SB_STYLE_DIM, "%s", keys[i]);
}

void sb_layout_draw(sb_cells *cells, const sb_monitor_state *state, sb_view *view, double now)
{
    sb_cells_clear(cells);
    const bool tall = cells->height >= TALL;
    const int top = sb_summary_draw(cells, state, now, !tall) + tall;
    const area panels = {cells, top, 0, cells->width, cells->height - top - 1 - tall};
    if (panels.height > 0) {
        if (view->help)
            draw_help(&panels);
        else
            draw_panels(panels, state, view);
    }
    if (cells->height > 1) draw_keys(cells, view, now);
}

sb_status sb_layout_print(FILE *out, const sb_monitor_state *state, int width, bool utf8, double now)
{
    enum { OTHERS = 64 }; /* rows of summary, names and heads */
    static const sb_panel_kind order[] = {SB_PANEL_FORCES, SB_PANEL_GAUGES};
    sb_cells cells = {.utf8 = utf8};
    const int rows = (int)(state->body_count + state->gauge_count) + OTHERS;
    if (sb_cells_resize(&cells, width, rows) != SB_OK) return SB_FAILED;
    int end = sb_summary_draw(&cells, state, now, false);
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        area in = {&cells, end + 1, 0, cells.width, cells.height - end - 1};
        size_t none = 0;
        if (sb_panel_find(order[i])->count(state) == 0) continue;
        draw_panel(&in, state, order[i], &none, false, NULL);
        end = in.top - 1;
    }
    char text[4 * SB_CELLS_WIDTH_MAX + 1];
    for (int row = 0; row < end; row++) {
        sb_cells_row(&cells, row, text, sizeof text);
        fprintf(out, "%s\n", text);
    }
    sb_cells_free(&cells);
    return SB_OK;
}

void sb_layout_line(FILE *out, const sb_monitor_state *state)
{
    const sb_status_message *status = &state->status;
    char eta[40];
    sb_text_duration(eta, sizeof eta, status->eta_seconds);
    fprintf(out,
            "%s  %s  %5.1f %%  t %.6g of %.6g s  step %lld  dt %.4g ms  iterations %d  "
            "density error %.3g %%  max speed %.4g m/s  ETA %s  messages lost %llu\n",
            status->run, sb_run_state_name(status->state), 100 * sb_monitor_state_progress(state), status->time,
            status->duration, (long long)status->step, 1e3 * status->time_step, (int)status->iterations,
            100 * status->density_error, status->max_speed, eta, (unsigned long long)state->count.lost);
}
