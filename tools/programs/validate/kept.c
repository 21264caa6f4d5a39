#include "kept.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

sb_status sb_kept_open(const char *report_folder, sb_sheet *table, sb_error *error)
{
    char folder[SB_PATH_MAX], path[SB_PATH_MAX];
    *table = (sb_sheet){0};
    sb_status status = sb_path_join(folder, report_folder, "validation", error);
    if (status == SB_OK) status = sb_path_join(path, folder, "results.csv", error);
    if (status != SB_OK || access(path, R_OK) != 0) return status;
    return sb_sheet_read(path, table, error);
}

static const char *text_of(const sb_sheet *table, size_t row, const char *column)
{
    return sb_sheet_text(table, row, sb_sheet_column(table, column));
}

static double number_of(const sb_sheet *table, size_t row, const char *column)
{
    return sb_sheet_number(table, row, sb_sheet_column(table, column));
}

static size_t count_of(const sb_sheet *table, size_t row, const char *column)
{
    const double value = number_of(table, row, column);
    return value >= 0 ? (size_t)value : 0;
}

static void add_row(const sb_sheet *table, size_t row, sb_figures *figures)
{
    sb_figure f = {.reference = number_of(table, row, "reference"),
                   .value = number_of(table, row, "value"),
                   .error = number_of(table, row, "error"),
                   .limit = number_of(table, row, "target"),
                   .low = number_of(table, row, "reference_low"),
                   .high = number_of(table, row, "reference_high"),
                   .pass = strcmp(text_of(table, row, "verdict"), "FAIL") != 0};
    if (isnan(f.low) || isnan(f.high)) f.low = f.high = 0;  /* no band */
    f.one_sided = isnan(f.reference) && f.value == f.error; /* sb_figure_below */
    snprintf(f.quantity, sizeof f.quantity, "%s", text_of(table, row, "quantity"));
    snprintf(f.unit, sizeof f.unit, "%s", text_of(table, row, "unit"));
    snprintf(f.error_unit, sizeof f.error_unit, "%s", text_of(table, row, "error_unit"));
    snprintf(f.note, sizeof f.note, "%s", text_of(table, row, "note"));
    sb_figures_add(figures, &f);
}

static bool of_case(const sb_sheet *table, size_t row, const char *name)
{
    return strcmp(text_of(table, row, "case"), name) == 0;
}

void sb_kept_read(const sb_sheet *table, sb_result *r)
{
    char defaults[17];
    if (r->state != SB_RESULT_NOT_RUN || !r->request_hash[0]) return;
    snprintf(defaults, sizeof defaults, "%016" PRIx64, r->defaults_hash);
    for (size_t row = 0; row < table->rows; row++) {
        if (!of_case(table, row, r->request.of->name) || strcmp(text_of(table, row, "request"), r->request_hash) != 0 ||
            strcmp(text_of(table, row, "defaults"), defaults) != 0)
            continue;
        sb_case_run *view = &r->run.view;
        add_row(table, row, &r->figures);
        snprintf(r->run.commit, sizeof r->run.commit, "%s", text_of(table, row, "commit"));
        snprintf(r->run.machine, sizeof r->run.machine, "%s", text_of(table, row, "machine"));
        snprintf(r->run.build, sizeof r->run.build, "%s", text_of(table, row, "build"));
        r->run.threads = (int)count_of(table, row, "threads");
        view->particles = count_of(table, row, "particles");
        view->steps = count_of(table, row, "steps");
        view->iterations = number_of(table, row, "sweeps_per_step");
        view->wall = number_of(table, row, "run_time_s");
        r->kept = true;
        r->state = SB_RESULT_DONE;
    }
}

void sb_kept_across(const sb_sheet *table, const char *name, sb_figures *figures)
{
    for (size_t row = 0; row < table->rows; row++)
        if (of_case(table, row, name) && !text_of(table, row, "resolution_m")[0]) add_row(table, row, figures);
}
