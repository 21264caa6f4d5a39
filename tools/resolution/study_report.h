/* What a resolution study says. */
#ifndef SB_STUDY_REPORT_H
#define SB_STUDY_REPORT_H

#include "order.h"
#include "study_options.h"
#include "trials.h"

/* Trials spacing by spacing, coarse to fine; at each the seeds 1..seeds. */
typedef struct sb_study {
    const sb_study_options *options;
    const sb_store *store;
    const sb_result *trials;
    size_t count;
} sb_study;

/* One quantity over the spacings. values[level * seeds + seed]: NaN where there is none; free with
   sb_free. */
typedef struct sb_study_row {
    const char *quantity, *unit; /* of a trial's figure */
    double *values;
    sb_level levels[SB_STUDY_LEVELS];
    sb_convergence convergence;
    sb_order_range range; /* of single seeds; NaN with fewer than three spacings */
    double finest;        /* m: the finest spacing with a value, which the error bar belongs to; NaN: none */
} sb_study_row;

/* Every wanted quantity of any trial, in the order it is met. *rows: sb_study_rows_free. */
sb_status sb_study_rows(const sb_study *study, sb_study_row **rows, size_t *count, sb_error *error);
void sb_study_rows_free(sb_study_row *rows, size_t count);

/* The table of orders as Markdown, as it is printed and stands in study.md. */
void sb_study_table(FILE *out, const sb_study *study, const sb_study_row *rows, size_t count);

/* folder/study.md, runs.csv, orders.csv and study.png, each whole or not at all. Without gnuplot the
   report says so in place of the picture. */
sb_status sb_study_write(const sb_study *study, const sb_study_row *rows, size_t count, const char *folder,
                         sb_error *error);

#endif
