/* Writes the report of a resolution study. */
#ifndef SB_STUDY_REPORT_H
#define SB_STUDY_REPORT_H

#include "order.h"
#include "study_options.h"
#include "trials.h"

/* Trials by spacing, coarse to fine; at each spacing the seeds 1..seeds. */
typedef struct sb_study {
    const sb_study_options *options;
    const sb_store *store;
    const sb_result *trials;
    size_t count;
} sb_study;

/* One quantity over the spacings. values[level * seeds + seed]; NaN: none. Free them with sb_free. */
typedef struct sb_study_row {
    const char *quantity, *unit; /* of a trial's figure */
    double *values;
    sb_level levels[SB_STUDY_LEVELS];
    sb_convergence convergence;
    sb_order_range range; /* of single seeds; NaN with fewer than three spacings */
    double finest;        /* m, finest spacing with a value, to which the error bar belongs; NaN: none */
} sb_study_row;

/* Collects every selected quantity of any trial, in order. Free *rows with sb_study_rows_free. */
sb_status sb_study_rows(const sb_study *study, sb_study_row **rows, size_t *count, sb_error *error);
void sb_study_rows_free(sb_study_row *rows, size_t count);

/* Writes the table of orders in Markdown, for the terminal and study.md. */
void sb_study_table(FILE *out, const sb_study *study, const sb_study_row *rows, size_t count);

/* Writes folder/study.md, runs.csv, orders.csv and study.png, each whole or not at all. Without gnuplot the report says
   so in place of the picture. */
sb_status sb_study_write(const sb_study *study, const sb_study_row *rows, size_t count, const char *folder,
                         sb_error *error);

#endif
