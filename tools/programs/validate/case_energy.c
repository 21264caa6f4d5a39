/* Momentum and energy of a collapsing water column in a closed tank. */
#include "cases.h"

#include "base/file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WINDOW = 50 }; /* rows of energy.csv, one per step */

static sb_status read_energy(const sb_case_run *run, sb_sheet *sheet, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_path_join(path, run->folder, "energy.csv", error);
    return status == SB_OK ? sb_sheet_read(path, sheet, error) : status;
}

/* Kinetic plus potential energy over time. Potential energy counts from the floor, z = 0. */
static sb_status mechanical(const sb_sheet *sheet, sb_curve *energy, sb_error *error)
{
    sb_curve potential = {0};
    sb_status status = sb_sheet_curve(sheet, NULL, "time_s", "kinetic_J", energy, error);
    if (status == SB_OK) status = sb_sheet_curve(sheet, NULL, "time_s", "potential_J", &potential, error);
    for (size_t i = 0; i < potential.count; i++) energy->y[i] += potential.y[i];
    sb_curve_free(&potential);
    if (status != SB_OK) sb_curve_free(energy);
    return status;
}

/* An item of the loss: a column in J that is neither kinetic nor potential energy. */
static bool is_item(const char *column)
{
    return strstr(column, "_J") && strncmp(column, "kinetic", 7) != 0 && strncmp(column, "potential", 9) != 0;
}

/* Largest value in a column; NaN: none. */
static double largest(const sb_sheet *sheet, const char *column)
{
    sb_curve curve = {0};
    double most = (double)NAN;
    if (sb_sheet_curve(sheet, NULL, "time_s", column, &curve, NULL) != SB_OK) return most;
    size_t at = sb_curve_highest(&curve, -HUGE_VAL, HUGE_VAL);
    if (at != (size_t)-1) most = curve.y[at];
    sb_curve_free(&curve);
    return most;
}

/* Change of a column from its first to its last row. */
static double change_of(const sb_sheet *sheet, const char *column)
{
    size_t k = sb_sheet_column(sheet, column);
    return sb_sheet_number(sheet, sheet->rows - 1, k) - sb_sheet_number(sheet, 0, k);
}

static sb_status figure_items(const sb_sheet *sheet, double lost, double scale, sb_figures *figures, sb_error *error)
{
    double sum = 0;
    size_t items = 0;
    sb_status status = SB_OK;
    for (size_t k = 0; status == SB_OK && k < sheet->columns; k++) {
        char quantity[SB_FIGURE_TEXT];
        const char *column = sheet->fields[k];
        if (!is_item(column)) continue;
        double change = change_of(sheet, column);
        snprintf(quantity, sizeof quantity, "energy, item %.*s", (int)(strstr(column, "_J") - column), column);
        status = sb_figure_report(figures, quantity, "%", (double)NAN, 100 * change / scale, error,
                                  "relative to the energy at the start; over the whole run");
        sum += change;
        items++;
    }
    if (status != SB_OK) return status;
    return sb_figure_below(figures, "energy, change that no item explains", "",
                           items ? fabs(lost - sum) / scale : (double)NAN, 1e-6, error,
                           "relative to the energy at the start; %zu items in energy.csv", items);
}

static sb_status figure_energy(const sb_sheet *sheet, sb_figures *figures, sb_error *error)
{
    sb_curve energy = {0};
    sb_status status = mechanical(sheet, &energy, error);
    if (status != SB_OK) return status;
    double start = energy.y[0], rise = energy.count > WINDOW ? -HUGE_VAL : (double)NAN, at = 0;
    for (size_t i = 0; i + WINDOW < energy.count; i++) {
        double change = energy.y[i + WINDOW] - energy.y[i];
        if (change <= rise) continue;
        rise = change;
        at = energy.x[i];
    }
    double lost = energy.y[energy.count - 1] - start;
    status = sb_figure_below(
        figures, "energy, largest rise over 50 steps", "", rise / start, 1e-4, error,
        "relative to the mechanical energy at the start, potential energy counted from the floor (%.4g J); the "
        "largest rise begins at t = %.3f s",
        start, at);
    if (status == SB_OK)
        status = sb_figure_report(figures, "energy, change over the whole run", "%", (double)NAN, 100 * lost / start,
                                  error, "relative to the same energy");
    if (status == SB_OK) status = figure_items(sheet, lost, start, figures, error);
    sb_curve_free(&energy);
    return status;
}

static sb_status evaluate(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    sb_sheet sheet = {0};
    sb_status status = read_energy(run, &sheet, error);
    if (status == SB_OK)
        status = sb_figure_below(figures, "momentum balance with bodies, worst step", "",
                                 largest(&sheet, "momentum_imbalance"), 1e-6, error,
                                 "|sum m a + sum F on bodies - M g| divided by sum m |a|");
    if (status == SB_OK) status = figure_energy(&sheet, figures, error);
    sb_sheet_free(&sheet);
    return status;
}

static sb_status plot_one(const sb_case_run *run, sb_plot *plot, sb_error *error)
{
    sb_sheet sheet = {0};
    sb_curve energy = {0};
    sb_status status = read_energy(run, &sheet, error);
    if (status == SB_OK) status = mechanical(&sheet, &energy, error);
    if (status == SB_OK) {
        sb_curve_map(&energy, 1, 0, 1 / energy.y[0], 0);
        status = sb_plot_run(plot, run, &energy, error);
    }
    sb_sheet_free(&sheet);
    sb_curve_free(&energy);
    return status;
}

/* Plots the items of one run's loss in a panel; no panel if there are no items. */
static sb_status plot_items(const sb_case_run *run, sb_plot *plot, sb_error *error)
{
    char title[160];
    bool panel = false;
    sb_sheet sheet = {0};
    sb_curve energy = {0};
    snprintf(title, sizeof title, "What changed it, %.100s", run->label);
    sb_status status = read_energy(run, &sheet, error);
    if (status == SB_OK) status = mechanical(&sheet, &energy, error);
    for (size_t k = 0; status == SB_OK && k < sheet.columns; k++) {
        sb_curve item = {0};
        char label[SB_FIGURE_TEXT];
        const char *column = sheet.fields[k];
        if (!is_item(column)) continue;
        snprintf(label, sizeof label, "%.*s", (int)(strstr(column, "_J") - column), column);
        if (!panel) status = sb_plot_panel(plot, title, "time (s)", "over the start's", error);
        panel = true;
        if (status == SB_OK) status = sb_sheet_curve(&sheet, NULL, "time_s", column, &item, error);
        sb_curve_map(&item, 1, 0, 1 / energy.y[0], 0);
        if (status == SB_OK) status = sb_plot_curve(plot, SB_PLOT_LINE, label, &item, error);
        sb_curve_free(&item);
    }
    sb_sheet_free(&sheet);
    sb_curve_free(&energy);
    return status;
}

static sb_status plot(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error)
{
    const sb_case_run *chosen = &runs[0];
    sb_status status = sb_plot_panel(plot, "Kinetic and potential energy", "time (s)", "over the start's", error);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        status = plot_one(&runs[i], plot, error);
        if (runs[i].judged && runs[i].seed == 1 && strcmp(runs[i].preset, "default") == 0) chosen = &runs[i];
    }
    return status == SB_OK ? plot_items(chosen, plot, error) : status;
}

static const sb_plan full[] = {{.resolution = 0.04, .paper = true},
                               {.resolution = 0.02, .paper = true, .judged = true, .seeds = 3},
                               {.resolution = 0.0125},
                               {.resolution = 0}};
static const sb_plan quick[] = {{.resolution = 0.04, .judged = true}, {.resolution = 0}};

const sb_case sb_case_energy = {
    .name = "momentum-energy",
    .title = "Momentum and energy of a collapsing column",
    .targets = "momentum balance with bodies: within 1e-6 of sum m |a| at every step; energy: rises by at most 1e-4 of "
               "the initial energy over any 50 steps; loss of energy: itemised to 1e-6",
    .method = "Reference: the conservation laws. A column of 0.4 m collapses onto a block in a closed tank, for 3 s. "
              "Energy is\nkinetic plus potential energy above the floor, one row of energy.csv per step; no filter.",
    .scene = "energy/collapse.yaml",
    .headline = "energy, largest rise over 50 steps",
    .full = full,
    .quick = quick,
    .evaluate = evaluate,
    .plot = plot};
