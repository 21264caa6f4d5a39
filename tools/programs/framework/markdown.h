/* Writes reports: whole files, numbers, cells and lists in Markdown, fields in CSV. */
#ifndef SB_FRAMEWORK_MARKDOWN_H
#define SB_FRAMEWORK_MARKDOWN_H

#include "arguments.h"
#include "base/file.h"

#include <stdio.h>

/* The folder of a report: --report, or `below` of the folder `out` (unless NULL), or else docs/results. */
sb_status sb_report_folder(const sb_common_options *options, const char *out, const char *below,
                           char folder[SB_PATH_MAX], sb_error *error);

typedef void sb_put(FILE *out, const void *report);
/* Writes folder/name by `put`, whole or not at all, and makes the folder. */
sb_status sb_report_write(const char *folder, const char *name, sb_put *put, const void *report, sb_error *error);

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
