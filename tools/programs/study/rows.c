/* Collects the quantities of a study from its runs. */
#include "study_report.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

static bool is_known(const sb_study *study, const char *quantity)
{
    for (size_t i = 0; i < study->row_count; i++)
        if (strcmp(study->rows[i].quantity, quantity) == 0) return true;
    return false;
}

static sb_status begin(const sb_study *study, const sb_figure *figure, sb_study_row *row, sb_error *error)
{
    *row = (sb_study_row){.quantity = figure->quantity, .unit = figure->unit};
    row->values = sb_alloc(study->count, sizeof *row->values);
    return row->values ? SB_OK : sb_fail_memory(error, "a study");
}

/* Fills in the values of all runs, their means and their convergence. */
static void fill(const sb_study *study, sb_study_row *row)
{
    const sb_study_options *o = study->options;
    size_t seeds = (size_t)o->seeds, n = o->spacing_count;
    for (size_t i = 0; i < study->count; i++) {
        const sb_result *t = &study->runs[i];
        const sb_figure *f = t->state == SB_RESULT_DONE ? sb_figures_find(&t->figures, row->quantity) : NULL;
        row->values[i] = f ? f->value : (double)NAN;
    }
    for (size_t l = 0; l < n; l++) {
        row->levels[l].spacing = o->spacings[l];
        sb_mean_of(&row->values[l * seeds], seeds, &row->levels[l].value, &row->levels[l].error);
    }
    row->convergence = sb_converge(row->levels, n);
    row->range = (sb_order_range){(double)NAN, (double)NAN, (double)NAN};
    size_t level[3];
    const size_t found = sb_finest_levels(row->levels, n, level);
    row->finest = found > 0 ? o->spacings[level[found - 1]] : (double)NAN;
    if (found < 3) return;
    const double spacing[3] = {o->spacings[level[0]], o->spacings[level[1]], o->spacings[level[2]]};
    const double *const values[3] = {&row->values[level[0] * seeds], &row->values[level[1] * seeds],
                                     &row->values[level[2] * seeds]};
    const size_t counts[3] = {seeds, seeds, seeds};
    row->range = sb_order_over_seeds(spacing, values, counts);
}

sb_status sb_study_rows(sb_study *study, sb_error *error)
{
    sb_status status = SB_OK;
    size_t capacity = 0;
    for (size_t i = 0; i < study->count; i++) {
        const sb_result *t = &study->runs[i];
        for (size_t k = 0; status == SB_OK && t->state == SB_RESULT_DONE && k < t->figures.count; k++) {
            const sb_figure *f = &t->figures.rows[k];
            if (!sb_study_selects(study->options, f->quantity) || is_known(study, f->quantity)) continue;
            if (sb_grow((void **)&study->rows, &capacity, study->row_count + 1, sizeof *study->rows) != 0)
                return sb_fail_memory(error, "a study");
            status = begin(study, f, &study->rows[study->row_count], error);
            if (status == SB_OK) fill(study, &study->rows[study->row_count++]);
        }
    }
    return status;
}

void sb_study_rows_free(sb_study *study)
{
    for (size_t i = 0; i < study->row_count; i++) sb_free(study->rows[i].values);
    sb_free(study->rows);
}
