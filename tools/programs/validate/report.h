/* Writes the report: validation.md with a summary and a section per case, one plot per case, and results.csv. */
#ifndef SB_VALIDATE_REPORT_H
#define SB_VALIDATE_REPORT_H

#include "markdown.h"
#include "results.h"

/* Validation in its store. */
typedef struct sb_report {
    sb_store *store;
    const sb_case_results *cases;
    size_t count;
} sb_report;

/* Writes validation.md, validation/<case>.png and validation/results.csv into the report folder, each whole or not at
   all. If a plot cannot be drawn, the report says so and the earlier picture stays. */
sb_status sb_validation_write(const sb_report *report, sb_error *error);

/* Parts of the report. */

/* Section of a case. picture: path relative to the report; NULL: none. */
void sb_report_case(FILE *out, const sb_case_results *results, const char *picture);
/* One row of the summary table. */
void sb_report_summary_row(FILE *out, const sb_case_results *results);
/* Rows of the table of missed figures. */
void sb_report_missed_rows(FILE *out, const sb_case_results *results);
/* Rows of results.csv, of a sb_report: one per run and figure. */
void sb_report_csv(FILE *out, const void *report);

#endif
