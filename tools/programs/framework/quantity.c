#include "quantity.h"

#include "base/file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* A table of the run; an empty one if the run has none. */
static const sb_sheet *open_table(const sb_case_run *run, const char *name)
{
    static const sb_sheet none;
    char path[SB_PATH_MAX];
    const bool there = sb_path_join(path, run->folder, name, NULL) == SB_OK && access(path, F_OK) == 0;
    return there ? sb_run_sheet(run, name) : &none;
}

/* Whether the row is the first with the name in its second column. */
static bool is_first(const sb_sheet *sheet, size_t row)
{
    for (size_t r = 0; r < row; r++) {
        if (strcmp(sb_sheet_text(sheet, r, 1), sb_sheet_text(sheet, row, 1)) == 0) return false;
        /* All names have rows at the first time. */
        if (strcmp(sb_sheet_text(sheet, r, 0), sb_sheet_text(sheet, row, 0)) != 0) return false;
    }
    return true;
}

static void report(sb_figures *figures, const char *name, const char *what, const char *unit, double value)
{
    char quantity[SB_FIGURE_TEXT];
    snprintf(quantity, sizeof quantity, "%.63s, %s", name, what);
    sb_figure_report(figures, quantity, unit, (double)NAN, value, "%s", "");
}

typedef struct load {
    double impulse[3], peak; /* N s, N */
} load;

/* Impulse and peak on one body. Rows are means over the interval that ends at their time. */
static load load_on(const sb_sheet *sheet, const char *name)
{
    static const char *const names[3] = {"Fx_N", "Fy_N", "Fz_N"};
    load l = {.peak = (double)NAN};
    double before = 0;
    size_t columns[3];
    for (int k = 0; k < 3; k++) columns[k] = sb_sheet_column(sheet, names[k]);
    for (size_t r = 0; r < sheet->rows; r++) {
        double force[3] = {0}, time = sb_sheet_number(sheet, r, 0);
        if (strcmp(sb_sheet_text(sheet, r, 1), name) != 0) continue;
        for (int k = 0; k < 3; k++) {
            if (columns[k] != (size_t)-1) force[k] = sb_sheet_number(sheet, r, columns[k]);
            l.impulse[k] += force[k] * (time - before);
        }
        l.peak = fmax(l.peak, hypot(force[0], force[1]));
        before = time;
    }
    return l;
}

static void add_forces(const sb_case_run *run, sb_figures *figures)
{
    const sb_sheet *sheet = open_table(run, "forces.csv");
    const bool flat = run->scene->dimensions == 2;
    for (size_t r = 0; r < sheet->rows && is_first(sheet, r); r++) {
        const char *name = sb_sheet_text(sheet, r, 1);
        const load l = load_on(sheet, name);
        report(figures, name, "impulse", flat ? "N s/m" : "N s", hypot(l.impulse[0], l.impulse[1]));
        report(figures, name, "vertical impulse", flat ? "N s/m" : "N s", l.impulse[2]);
        report(figures, name, "peak", flat ? "N/m" : "N", l.peak);
    }
}

/* Adds the largest or the last value of a column for every name in a table. */
static void add_column(const sb_case_run *run, const char *table, const char *column, const char *what,
                       const char *unit, bool last, double shift, sb_figures *figures)
{
    const sb_sheet *sheet = open_table(run, table);
    for (size_t r = 0; r < sheet->rows && is_first(sheet, r); r++) {
        const char *name = sb_sheet_text(sheet, r, 1);
        const sb_curve *curve = sb_run_curve(run, table, name, "time_s", column);
        const size_t top = last ? curve->count - 1 : sb_curve_highest(curve, 0, HUGE_VAL);
        report(figures, name, what, unit, sb_curve_y(curve, top) - shift);
    }
}

void sb_quantities_of(const sb_case_run *run, sb_figures *figures)
{
    const sb_scene *scene = run->scene;
    add_forces(run, figures);
    add_column(run, "gauges.csv", "z_m", "crest", "m", false, scene->sea.present ? scene->sea.level : 0, figures);
    add_column(run, "runup.csv", "z_m", "run-up height", "m", false, 0, figures);
    add_column(run, "runup.csv", "front_m", "run-up front", "m", false, 0, figures);
    add_column(run, "overtopping.csv", "volume_m3", "volume", scene->dimensions == 2 ? "m^2" : "m^3", true, 0, figures);
}
