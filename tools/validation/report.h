/* The report: validation.md with a summary and a section per case, a plot per case and results.csv.
 */
#ifndef SB_VALIDATION_REPORT_H
#define SB_VALIDATION_REPORT_H

#include "results.h"

#include <stdio.h>

typedef struct sb_report {
    const sb_store *store;
    const sb_case_results *cases;
    size_t count;
    const char *command; /* as it was typed */
    bool quick;
} sb_report;

/* Writes folder/validation.md, folder/validation/<case>.png and folder/validation/results.csv, each
   whole or not at all. A plot that cannot be drawn is said so in the report and keeps its former
   picture. */
sb_status sb_report_write(const sb_report *report, const char *folder, sb_error *error);

/* Inside the report. */

/* Its section; picture: path relative to the report, NULL when there is none. */
void sb_report_case(FILE *out, const sb_case_results *results, const char *picture);
/* One line of the summary. */
void sb_report_summary_line(FILE *out, const sb_case_results *results);
/* Rows of results.csv: one per run and figure. */
void sb_report_csv(FILE *out, const sb_report *report);

/* Text for a table cell: NaN is an en dash; four digits; an error carries its sign and unit. */
void sb_text_number(char text[48], double value);
/* A name as it can stand in a cell of a table. */
void sb_text_cell(FILE *out, const char *name);
void sb_text_error(char text[48], double error, const char *unit);

#endif
