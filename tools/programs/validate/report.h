/* Writes the report: validation.md with a summary and a section per case, one plot per case, and results.csv. */
#ifndef SB_VALIDATION_REPORT_H
#define SB_VALIDATION_REPORT_H

#include "results.h"

#include <stdio.h>

typedef struct sb_report {
    const sb_store *store;
    const sb_case_results *cases;
    size_t count;
    const char *command; /* as typed */
    bool quick;
} sb_report;

/* Writes folder/validation.md, folder/validation/<case>.png and folder/validation/results.csv, each
   whole or not at all. If a plot cannot be drawn, the report says so and the earlier picture stays. */
sb_status sb_report_write(const sb_report *report, const char *folder, sb_error *error);

/* Parts of the report. */

/* Section of a case. picture: path relative to the report; NULL: none. */
void sb_report_case(FILE *out, const sb_case_results *results, const char *picture);
/* One row of the summary table. */
void sb_report_summary_row(FILE *out, const sb_case_results *results);
/* Rows of the table of missed figures. */
void sb_report_missed_rows(FILE *out, const sb_case_results *results);
/* Rows of results.csv: one per run and figure. */
void sb_report_csv(FILE *out, const sb_report *report);

/* Text for a table cell. A number has four digits; NaN is an en dash; an error has a sign and a unit. */
void sb_text_number(char text[48], double value);
/* Writes a name with the escapes that a table cell needs. */
void sb_text_cell(FILE *out, const char *name);
void sb_text_error(char text[48], double error, const char *unit);

#endif
