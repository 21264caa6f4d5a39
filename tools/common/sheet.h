/* CSV files with one header line, read whole: the tables of a run, and our own reference tables,
   whose leading lines that begin with '#' cite their source. */
#ifndef SB_COMMON_SHEET_H
#define SB_COMMON_SHEET_H

#include "curve.h"

#include <stdio.h>

/* Fields are texts in `text`, which the sheet owns. */
typedef struct sb_sheet {
    char *text;
    size_t columns, rows, capacity;
    const char **fields; /* [0 .. columns) the header, then row by row */
} sb_sheet;

/* SB_BAD_INPUT names the file and the line whose number of fields differs from the header's. An
   unfinished last line, as a stopped run leaves it, is ignored. */
sb_status sb_sheet_read(const char *path, sb_sheet *sheet, sb_error *error);
void sb_sheet_free(sb_sheet *sheet);

/* The column whose header is `name`, or name with _per_m behind it (a run in 2D); (size_t)-1: none.
 */
size_t sb_sheet_column(const sb_sheet *sheet, const char *name);
/* NaN when the field is empty or no number. */
double sb_sheet_number(const sb_sheet *sheet, size_t row, size_t column);
const char *sb_sheet_text(const sb_sheet *sheet, size_t row, size_t column);

/* Writes a text as a field, in quotes where it needs them (RFC 4180). It holds no line's end. */
void sb_sheet_put(FILE *out, const char *text);

/* Two columns by name as a curve. where: only rows whose second column is this name (forces.csv,
   gauges.csv,
   ...); NULL: all rows. SB_BAD_INPUT when a column or every row is missing. */
sb_status sb_sheet_curve(const sb_sheet *sheet, const char *where, const char *x, const char *y, sb_curve *curve,
                         sb_error *error);

#endif
