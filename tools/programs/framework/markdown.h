/* Writes reports: whole files, numbers, cells and lists in Markdown, fields in CSV. */
#ifndef SB_FRAMEWORK_MARKDOWN_H
#define SB_FRAMEWORK_MARKDOWN_H

#include "store.h"

#include <stdio.h>

typedef void sb_put(FILE *out, const void *report);
/* Writes folder/name by `put`, whole or not at all, and makes its folder. */
sb_status sb_report_write(const char *folder, const char *name, sb_put *put, const void *report, sb_error *error);
/* Writes files into the store's report folder, ended by a row without a name, and prints the path of the last one. An
   earlier report stays if --report-only is given and the store has no run to report. */
typedef struct sb_report_file {
    const char *name;
    sb_put *put;
} sb_report_file;
sb_status sb_reports_write(const sb_store *store, const sb_report_file *files, const void *report, sb_error *error);

/* Text for a table cell. A number has four digits; NaN is an en dash; an error has a sign and a unit. */
void sb_text_number(char text[48], double value);
void sb_text_error(char text[48], double error, const char *unit);

/* Writes " text |", with the escapes that a cell needs. */
void sb_put_cell(FILE *out, const char *text);
/* Writes a number with four digits as a cell. */
void sb_put_number(FILE *out, double value);
/* Writes the line below the head of a table. */
void sb_put_rule(FILE *out, size_t columns);
/* Writes a list item per part of a text that "; " separates, with a capital or as it is. */
void sb_put_items(FILE *out, const char *text, bool capital);
/* Writes "No plot: reason." unless a picture was drawn; then `picture`. */
void sb_put_picture(FILE *out, const sb_error *reason, const char *picture);
/* Writes a number and a comma; NaN is an empty field. */
void sb_put_field(FILE *out, double value);

#endif
