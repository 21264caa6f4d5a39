#include "quantity.h"

#include "base/file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Reads a table of the run; false (and SB_OK) if the run has none. */
static bool open_table(const sb_case_run *run, const char *name, sb_sheet *sheet, sb_status *status, sb_error *error)
{
    char path[SB_PATH_MAX];
    *status = sb_path_join(path, run->folder, name, error);
    if (*status != SB_OK || access(path, F_OK) != 0) return false;
    *status = sb_sheet_read(path, sheet, error);
    return *status == SB_OK;
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

static sb_status report(sb_figures *figures, const char *name, const char *what, const char *unit, double value,
                        sb_error *error)
{
    char quantity[SB_FIGURE_TEXT];
    snprintf(quantity, sizeof quantity, "%.63s, %s", name, what);
    return sb_figure_report(figures, quantity, unit, (double)NAN, value, error, "%s", "");
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

static sb_status add_forces(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    sb_sheet sheet = {0};
    sb_status status;
    bool flat = run->scene->dimensions == 2;
    if (!open_table(run, "forces.csv", &sheet, &status, error)) return status;
    for (size_t r = 0; status == SB_OK && r < sheet.rows && is_first(&sheet, r); r++) {
        const char *name = sb_sheet_text(&sheet, r, 1);
        const load l = load_on(&sheet, name);
        status = report(figures, name, "impulse", flat ? "N s/m" : "N s", hypot(l.impulse[0], l.impulse[1]), error);
        if (status == SB_OK)
            status = report(figures, name, "vertical impulse", flat ? "N s/m" : "N s", l.impulse[2], error);
        if (status == SB_OK) status = report(figures, name, "peak", flat ? "N/m" : "N", l.peak, error);
    }
    sb_sheet_free(&sheet);
    return status;
}

/* Adds the largest or the last value of a column for every name in a table. */
static sb_status add_column(const sb_case_run *run, const char *table, const char *column, const char *what,
                            const char *unit, bool last, double shift, sb_figures *figures, sb_error *error)
{
    sb_sheet sheet = {0};
    sb_status status;
    if (!open_table(run, table, &sheet, &status, error)) return status;
    for (size_t r = 0; status == SB_OK && r < sheet.rows && is_first(&sheet, r); r++) {
        const char *name = sb_sheet_text(&sheet, r, 1);
        sb_curve curve = {0};
        status = sb_sheet_curve(&sheet, name, "time_s", column, &curve, error);
        size_t top = sb_curve_highest(&curve, 0, HUGE_VAL);
        if (last && curve.count) top = curve.count - 1;
        double value = status == SB_OK && top != (size_t)-1 ? curve.y[top] - shift : (double)NAN;
        if (status == SB_OK) status = report(figures, name, what, unit, value, error);
        sb_curve_free(&curve);
    }
    sb_sheet_free(&sheet);
    return status;
}

sb_status sb_quantities_of(const sb_case_run *run, sb_figures *figures, sb_error *error)
{
    const sb_scene *scene = run->scene;
    sb_status status = add_forces(run, figures, error);
    if (status == SB_OK)
        status = add_column(run, "gauges.csv", "z_m", "crest", "m", false, scene->sea.present ? scene->sea.level : 0,
                            figures, error);
    if (status == SB_OK) status = add_column(run, "runup.csv", "z_m", "run-up height", "m", false, 0, figures, error);
    if (status == SB_OK)
        status = add_column(run, "runup.csv", "front_m", "run-up front", "m", false, 0, figures, error);
    if (status == SB_OK)
        status = add_column(run, "overtopping.csv", "volume_m3", "volume", scene->dimensions == 2 ? "m^2" : "m^3", true,
                            0, figures, error);
    return status;
}
