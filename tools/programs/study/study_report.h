/* Writes the report of a resolution study. */
#ifndef SB_STUDY_STUDY_REPORT_H
#define SB_STUDY_STUDY_REPORT_H

#include "order.h"
#include "runs.h"
#include "study_options.h"

/* One quantity over the spacings. values[level * seeds + seed]; NaN: none. */
typedef struct sb_study_row {
    const char *quantity, *unit; /* of a run's figure */
    double *values;
    sb_level levels[SB_STUDY_LEVELS];
    sb_convergence convergence;
    sb_order_range range; /* of single seeds; NaN with fewer than three spacings */
    double finest;        /* m, finest spacing with a value, to which the error bar belongs; NaN: none */
} sb_study_row;

/* Runs by spacing, coarse to fine; at each spacing the seeds 1..seeds. */
typedef struct sb_study {
    const sb_study_options *options;
    const sb_store *store;
    const sb_result *runs;
    size_t count, row_count;
    sb_study_row *rows;
} sb_study;

/* Collects every selected quantity of any run, in order. Free the rows with sb_study_rows_free, also after a failure.
 */
sb_status sb_study_rows(sb_study *study, sb_error *error);
void sb_study_rows_free(sb_study *study);

/* Writes the table of orders in Markdown, for the terminal and study.md. */
void sb_study_table(FILE *out, const sb_study *study);

/* Writes study.md, runs.csv, orders.csv and study.png into the store's folder, each whole or not at all. Without
   gnuplot the report says so in place of the picture. */
sb_status sb_study_write(const sb_study *study, sb_error *error);

#endif
