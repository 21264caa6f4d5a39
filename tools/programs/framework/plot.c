#include "plot.h"

#include "base/memory.h"
#include "markdown.h"
#include "output/plots/tool.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { COLORS = 8, GREYS = 2, SHAPES = 4, TEXT = 160 };

/* A band, or one of sb_plot_style. */
enum { BAND = SB_PLOT_CHAIN + 1 };

typedef struct layer {
    int kind;
    char label[TEXT];
    sb_curve curve, high; /* a band's lower and upper edge */
} layer;

typedef struct panel {
    char title[TEXT], x_label[TEXT], y_label[TEXT];
    double range[4];
    bool logarithmic;
    size_t layer_count, layer_capacity;
    layer *layers;
} panel;

struct sb_plot {
    bool incomplete; /* memory was exhausted */
    panel spare;     /* for all when it was */
    size_t panel_count, panel_capacity;
    panel *panels;
    const char *name;
    char picture[SB_PATH_MAX];
};

static void free_layers(panel *p)
{
    for (size_t k = 0; k < p->layer_count; k++) {
        sb_curve_free(&p->layers[k].curve);
        sb_curve_free(&p->layers[k].high);
    }
    sb_free(p->layers);
}

static void free_plot(sb_plot *plot)
{
    for (size_t p = 0; p < plot->panel_count; p++) free_layers(&plot->panels[p]);
    free_layers(&plot->spare);
    sb_free(plot->panels);
}

static panel *last(sb_plot *plot)
{
    return plot->panel_count ? &plot->panels[plot->panel_count - 1] : &plot->spare;
}

void sb_plot_panel(sb_plot *plot, const char *title, const char *x_label, const char *y_label)
{
    plot->incomplete |=
        sb_grow((void **)&plot->panels, &plot->panel_capacity, plot->panel_count + 1, sizeof *plot->panels) != 0;
    if (plot->incomplete) return;
    panel *made = &plot->panels[plot->panel_count++];
    *made = (panel){.range = {(double)NAN, (double)NAN, (double)NAN, (double)NAN}};
    snprintf(made->title, sizeof made->title, "%s", title);
    snprintf(made->x_label, sizeof made->x_label, "%s", x_label);
    snprintf(made->y_label, sizeof made->y_label, "%s", y_label);
}

void sb_plot_range(sb_plot *plot, double x_min, double x_max, double y_min, double y_max)
{
    const double range[] = {x_min, x_max, y_min, y_max};
    memcpy(last(plot)->range, range, sizeof range);
}

void sb_plot_logarithmic(sb_plot *plot)
{
    last(plot)->logarithmic = true;
}

static void add(sb_plot *plot, int what, const char *label, const sb_curve *curve, const sb_curve *high)
{
    panel *p = last(plot);
    plot->incomplete |= sb_grow((void **)&p->layers, &p->layer_capacity, p->layer_count + 1, sizeof *p->layers) != 0;
    if (plot->incomplete) return;
    layer *made = &p->layers[p->layer_count++];
    *made = (layer){.kind = what};
    snprintf(made->label, sizeof made->label, "%s", label);
    sb_curve_sum(&made->curve, curve);
    if (high) sb_curve_sum(&made->high, high);
    plot->incomplete |= curve->incomplete || made->curve.incomplete || made->high.incomplete;
}

void sb_plot_curve(sb_plot *plot, sb_plot_style style, const char *label, const sb_curve *curve)
{
    add(plot, (int)style, label, curve, NULL);
}

void sb_plot_band(sb_plot *plot, const char *label, const sb_curve *low, const sb_curve *high)
{
    add(plot, BAND, label, low, high);
}

/* Writes a single-quoted gnuplot string. */
static void put_quoted(FILE *out, const char *text)
{
    fputc('\'', out);
    for (; *text; text++) {
        if (*text == '\'') fputc('\'', out);
        fputc((unsigned char)*text < 0x20 ? ' ' : *text, out);
    }
    fputc('\'', out);
}

static void put_number(FILE *out, double value)
{
    if (isnan(value))
        fputs("NaN", out);
    else
        fprintf(out, "%.9g", value);
}

static void put_data(FILE *out, const layer *l)
{
    size_t count = l->kind == BAND && l->high.count < l->curve.count ? l->high.count : l->curve.count;
    for (size_t i = 0; i < count; i++) {
        put_number(out, l->curve.x[i]);
        fputc(' ', out);
        put_number(out, l->curve.y[i]);
        if (l->kind == BAND) {
            fputc(' ', out);
            put_number(out, l->high.y[i]);
        }
        fputc('\n', out);
    }
    fputs("\n\n", out);
}

static void put_range(FILE *out, char axis, double low, double high)
{
    fprintf(out, "set %crange [", axis);
    if (isnan(low))
        fputc('*', out);
    else
        fprintf(out, "%.9g", low);
    fputc(':', out);
    if (isnan(high))
        fputc('*', out);
    else
        fprintf(out, "%.9g", high);
    fputs("]\n", out);
}

static void put_layer(FILE *out, const layer *l, const char *data, size_t index, int turn, bool aside)
{
    static const char *const colors[COLORS] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                               "#56b4e9", "#d55e00", "#7f3c8d", "#80ba5a"};
    static const char *const greys[GREYS] = {"#333333", "#999999"};
    static const int shapes[SHAPES] = {7, 5, 9, 6}; /* disc, square, triangle, circle */
    const char *color = colors[turn % COLORS];
    const int shape = shapes[turn / COLORS % SHAPES];
    fprintf(out, "'%s' index %zu using 1:2", data, index);
    switch (l->kind) {
    case BAND:
        fputs(":3 with filledcurves lc rgb '#d0d0d0'", out);
        break;
    case SB_PLOT_POINTS:
        fprintf(out, " with points pt %d ps 0.4 lc rgb '%s'", shapes[turn % SHAPES], greys[turn % GREYS]);
        break;
    case SB_PLOT_MARKS:
        fprintf(out, " with points pt %d ps 1.3 lw 1.5 lc rgb '%s'", shape, color);
        break;
    case SB_PLOT_CHAIN:
        fprintf(out, " with linespoints pt %d ps 1.3 lw 0.7 dt 3 lc rgb '%s'", shape, color);
        break;
    case SB_PLOT_REFERENCE:
        fputs(" with lines lw 2 lc rgb '#000000'", out);
        break;
    case SB_PLOT_JUDGED:
        fputs(" with lines lw 2.5 lc rgb '#c00000'", out);
        break;
    case SB_PLOT_SEED:
        fputs(" with lines lw 1 lc rgb '#e7a3a3'", out);
        break;
    case SB_PLOT_ASIDE:
        fprintf(out, " with lines lw 1 dt 2 lc rgb '%s'%s", color, aside ? " noautoscale" : "");
        break;
    default:
        fprintf(out, " with lines lw 1.5 lc rgb '%s'", color);
        break;
    }
    fputs(" title ", out);
    put_quoted(out, l->label);
}

/* Drawing order: simulated curves are over measured ones, and the judged curve is on top. */
static const int order[] = {BAND,         SB_PLOT_POINTS, SB_PLOT_REFERENCE, SB_PLOT_ASIDE, SB_PLOT_LINE,
                            SB_PLOT_SEED, SB_PLOT_MARKS,  SB_PLOT_CHAIN,     SB_PLOT_JUDGED};

/* Whether the panel has data for the ranges of the axes other than the layers of style `aside`. */
static bool has_scale(const panel *p)
{
    for (size_t k = 0; k < p->layer_count; k++)
        for (size_t i = 0; p->layers[k].kind != SB_PLOT_ASIDE && i < p->layers[k].curve.count; i++)
            if (isfinite(p->layers[k].curve.y[i])) return true;
    return false;
}

static void put_panel(FILE *out, const panel *p, const char *data, size_t first)
{
    fputs("set title ", out);
    put_quoted(out, p->title);
    fputs("\nset xlabel ", out);
    put_quoted(out, p->x_label);
    fputs("\nset ylabel ", out);
    put_quoted(out, p->y_label);
    fputc('\n', out);
    fputs(p->logarithmic ? "set logscale xy\nset format '%g'\n" : "unset logscale\nset format\n", out);
    put_range(out, 'x', p->range[0], p->range[1]);
    put_range(out, 'y', p->range[2], p->range[3]);
    const char *before = "plot ";
    const bool aside = has_scale(p);
    for (size_t turn = 0; turn < sizeof order / sizeof *order; turn++) {
        int count = 0;
        for (size_t k = 0; k < p->layer_count; k++) {
            if (p->layers[k].kind != order[turn]) continue;
            fputs(before, out);
            put_layer(out, &p->layers[k], data, first + k, count++, aside);
            before = ", ";
        }
    }
    fputc('\n', out);
}

/* Height of a panel that has room for the longest key in one column, px. */
static size_t panel_height(const sb_plot *plot)
{
    size_t entries = 0;
    for (size_t p = 0; p < plot->panel_count; p++)
        if (plot->panels[p].layer_count > entries) entries = plot->panels[p].layer_count;
    const size_t height = 80 + 18 * entries;
    return height > 300 ? height : 300;
}

static void put_script(FILE *out, const void *what)
{
    const sb_plot *plot = what;
    char data[TEXT];
    size_t first = 0;
    snprintf(data, sizeof data, "%s.dat", plot->name);
    fprintf(out, "set terminal pngcairo noenhanced size 900,%zu font 'Sans,10'\nset output ",
            60 + panel_height(plot) * plot->panel_count);
    put_quoted(out, plot->picture);
    fprintf(out,
            "\nset grid lt 1 lw 0.5 lc rgb '#dddddd'\nset border 3 lc rgb '#555555'\n"
            "set tics nomirror\nset key outside right top Left reverse\nset lmargin 12\n"
            "set rmargin 30\nset multiplot layout %zu,1\n",
            plot->panel_count);
    for (size_t p = 0; p < plot->panel_count; p++) {
        if (plot->panels[p].layer_count) put_panel(out, &plot->panels[p], data, first);
        first += plot->panels[p].layer_count;
    }
    fputs("unset multiplot\n", out);
}

static void put_all_data(FILE *out, const void *what)
{
    const sb_plot *plot = what;
    for (size_t p = 0; p < plot->panel_count; p++)
        for (size_t k = 0; k < plot->panels[p].layer_count; k++) put_data(out, &plot->panels[p].layers[k]);
}

static sb_status run_gnuplot(const sb_plot *plot, const char *folder, sb_error *error)
{
    char program[SB_PATH_MAX], data[TEXT], script[TEXT];
    char *const arguments[] = {"gnuplot", script, NULL};
    if (!sb_tool_find("gnuplot", program)) return sb_fail(error, SB_FAILED, "gnuplot is not installed");
    snprintf(data, sizeof data, "%s.dat", plot->name);
    snprintf(script, sizeof script, "%s.gp", plot->name);
    sb_status status = sb_report_write(folder, data, put_all_data, plot, error);
    if (status == SB_OK) status = sb_report_write(folder, script, put_script, plot, error);
    return status == SB_OK ? sb_tool_run(program, arguments, folder, error) : status;
}

sb_status sb_plot_picture(sb_draw *draw, const void *what, const char *out, const char *name, const char *folder,
                          sb_error *error)
{
    char plots[SB_PATH_MAX], real[SB_PATH_MAX], file[TEXT];
    sb_plot plot = {.name = name};
    sb_status status = draw(&plot, what, error);
    if (status == SB_OK && plot.incomplete) status = sb_fail_memory(error, "a plot");
    if (status == SB_OK && !realpath(folder, real))
        status = sb_fail(error, SB_FAILED, "%.400s: no such folder", folder);
    if (status == SB_OK) status = sb_path_join(plots, out, "plots", error);
    snprintf(file, sizeof file, "%s.png", name);
    if (status == SB_OK) status = sb_path_join(plot.picture, real, file, error);
    if (status == SB_OK) status = run_gnuplot(&plot, plots, error);
    free_plot(&plot);
    return status;
}
