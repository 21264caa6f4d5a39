/* Reads rows of numbers from a text file. */
#ifndef SB_PHYSICS_NUMBER_ROWS_H
#define SB_PHYSICS_NUMBER_ROWS_H

#include "base/status.h"

#include <stddef.h>

/* Takes a row of numbers from the given line of a file, counted from 1. */
typedef sb_status sb_number_row(void *context, size_t line, const double *values, sb_error *error);

/* Calls take for each row of `columns` numbers, at most 8, of a text file of at most 64 MB, until one call fails.
   Blanks, a comma or a semicolon separate numbers, # begins a comment, and one line before the first row may name the
   columns. least: rows that the file must have; expected: the columns with their units in parentheses, for messages and
   to refuse a header that names others. SB_BAD_INPUT names the file and the line, also that of a zero byte or another
   control character, which only a file that is no text table has. */
sb_status sb_number_rows_visit(const char *path, size_t columns, size_t least, const char *expected,
                               sb_number_row *take, void *context, sb_error *error);

/* Reads such rows into *values, row after row, which the caller frees with sb_free; *rows: their number, at least 1. */
sb_status sb_number_rows_read(const char *path, size_t columns, const char *expected, double **values, size_t *rows,
                              sb_error *error);

#endif
