/* Momentum and energy of a collapsing water column in a closed tank. */
#include "cases.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WINDOW = 50 }; /* rows of energy.csv, one per step */

static sb_curve *column_of(const sb_case_run *run, const char *column)
{
    return sb_run_curve(run, "energy.csv", NULL, "time_s", column);
}

/* Kinetic plus potential energy over time. Potential energy counts from the floor, z = 0. */
static sb_curve *mechanical(const sb_case_run *run)
{
    sb_curve *energy = column_of(run, "kinetic_J");
    sb_curve_sum(energy, column_of(run, "potential_J"));
    return energy;
}

/* Change of a column from its first to its last row. */
static double change_of(const sb_sheet *sheet, const char *column)
{
    size_t k = sb_sheet_column(sheet, column);
    return sb_sheet_number(sheet, sheet->rows - 1, k) - sb_sheet_number(sheet, 0, k);
}

static void figure_items(const sb_sheet *sheet, double lost, double scale, sb_figures *figures)
{
    double sum = 0;
    size_t items = 0;
    for (size_t k = 0; k < sheet->columns; k++) {
        char name[SB_FIGURE_TEXT], quantity[SB_FIGURE_TEXT];
        if (!sb_energy_item(sheet, k, name)) continue;
        double change = change_of(sheet, sheet->fields[k]);
        snprintf(quantity, sizeof quantity, "energy, item %.60s", name);
        sb_figure_report(figures, quantity, "%", (double)NAN, 100 * change / scale,
                         "relative to the energy at the start; over the whole run");
        sum += change;
        items++;
    }
    sb_figure_below(figures, "energy, change that no item explains", "", items ? fabs(lost - sum) / scale : (double)NAN,
                    1e-6, "relative to the energy at the start; %zu items in energy.csv", items);
}

static void figure_energy(const sb_case_run *run, sb_figures *figures)
{
    const sb_curve *energy = mechanical(run);
    double start = sb_curve_first(energy), rise = energy->count > WINDOW ? -HUGE_VAL : (double)NAN, at = 0;
    for (size_t i = 0; i + WINDOW < energy->count; i++) {
        double change = energy->y[i + WINDOW] - energy->y[i];
        if (change <= rise) continue;
        rise = change;
        at = energy->x[i];
    }
    double lost = sb_curve_last(energy) - start;
    sb_figure_below(figures, "energy, largest rise over 50 steps", "", rise / start, 1e-4,
                    "relative to the mechanical energy at the start, potential energy counted from the floor (%.4g J); "
                    "the largest rise begins at t = %.3f s",
                    start, at);
    sb_figure_report(figures, "energy, change over the whole run", "%", (double)NAN, 100 * lost / start,
                     "relative to the same energy");
    figure_items(sb_run_sheet(run, "energy.csv"), lost, start, figures);
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const sb_curve *imbalance = column_of(run, "momentum_imbalance");
    sb_figure_below(figures, "momentum balance with bodies, worst step", "",
                    sb_curve_y(imbalance, sb_curve_highest(imbalance, -HUGE_VAL, HUGE_VAL)), 1e-6,
                    "|sum m a + sum F on bodies - M g| divided by sum m |a|");
    figure_energy(run, figures);
}

/* Plots the items of one run's loss in a panel; no panel if there are no items. */
static void plot_items(const sb_case_run *run, sb_plot *plot)
{
    char title[160], label[SB_FIGURE_TEXT];
    bool panel = false;
    const double start = sb_curve_first(mechanical(run));
    const sb_sheet *sheet = sb_run_sheet(run, "energy.csv");
    snprintf(title, sizeof title, "What changed it, %.100s", run->label);
    for (size_t k = 0; k < sheet->columns; k++) {
        if (!sb_energy_item(sheet, k, label)) continue;
        if (!panel) sb_plot_panel(plot, title, "time (s)", "over the start's");
        panel = true;
        sb_curve *item = column_of(run, sheet->fields[k]);
        sb_curve_map(item, 1, 0, 1 / start, 0);
        sb_plot_curve(plot, SB_PLOT_LINE, label, item);
    }
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    const sb_case_run *chosen = &runs[0];
    sb_plot_panel(plot, "Kinetic and potential energy", "time (s)", "over the start's");
    for (size_t i = 0; i < count; i++) {
        sb_curve *energy = mechanical(&runs[i]);
        sb_curve_map(energy, 1, 0, 1 / sb_curve_first(energy), 0);
        sb_plot_run(plot, &runs[i], energy);
        if (runs[i].judged && runs[i].seed == 1 && strcmp(runs[i].preset, "default") == 0) chosen = &runs[i];
    }
    plot_items(chosen, plot);
}

const sb_case sb_case_energy = {
    .name = "momentum-energy",
    .title = "Momentum and energy of a collapsing column",
    .targets = "momentum balance with bodies: within 1e-6 of sum m |a| at every step; energy: rises by at most 1e-4 of "
               "the initial energy over any 50 steps; loss of energy: itemised to 1e-6",
    .method = "Reference: the conservation laws. A column of 0.4 m collapses onto a block in a closed tank, for 3 s. "
              "Energy is\nkinetic plus potential energy above the floor, one row of energy.csv per step; no filter.",
    .scene = "energy/collapse.yaml",
    .headline = "energy, largest rise over 50 steps",
    .full = {{.resolution = 0.04, .paper = true},
             {.resolution = 0.02, .paper = true, .judged = true, .seeds = 3},
             {.resolution = 0.0125}},
    .quick = {{.resolution = 0.04, .judged = true}},
    .evaluate = evaluate,
    .plot = plot};
