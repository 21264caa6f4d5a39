/* Reads CSV files with one header line: the tables of a run, and reference tables, whose leading lines with '#' cite
   their source. */
#ifndef SB_FRAMEWORK_SHEET_H
#define SB_FRAMEWORK_SHEET_H

#include "base/status.h"
#include "curve.h"

#include <stdio.h>

/* Fields point into `text`, which the sheet owns. */
typedef struct sb_sheet {
    char *text;
    size_t columns, rows, capacity;
    const char **fields; /* [0 .. columns) the header, then row by row */
} sb_sheet;

/* SB_BAD_INPUT: a line has another number of fields than the header; the error names file and line. An unfinished last
   line, as a stopped run leaves it, is ignored. */
sb_status sb_sheet_read(const char *path, sb_sheet *sheet, sb_error *error);
void sb_sheet_free(sb_sheet *sheet);

/* The column with the header `name`, or `name` followed by _per_m (a 2D run); (size_t)-1: none. */
size_t sb_sheet_column(const sb_sheet *sheet, const char *name);
/* NaN: the field is empty or not a number. */
double sb_sheet_number(const sb_sheet *sheet, size_t row, size_t column);
/* "": no such field. */
const char *sb_sheet_text(const sb_sheet *sheet, size_t row, size_t column);

/* Writes a text as a field, in quotes if needed (RFC 4180). The text has no line break. */
void sb_sheet_put(FILE *out, const char *text);

/* Two columns by name as a curve. where: only rows with this name in the second column (as in forces.csv or
   gauges.csv); NULL: all rows. SB_BAD_INPUT: a column is missing, or there are no rows. */
sb_status sb_sheet_curve(const sb_sheet *sheet, const char *where, const char *x, const char *y, sb_curve *curve,
                         sb_error *error);

#endif
