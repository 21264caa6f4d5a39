/* Reads rows of numbers from a text file. */
#ifndef SB_PHYSICS_NUMBER_ROWS_H
#define SB_PHYSICS_NUMBER_ROWS_H

#include "base/status.h"

#include <stddef.h>

/* Takes a row of numbers from the given line of a file, counted from 1. */
typedef sb_status sb_number_row(void *context, size_t line, const double *values, sb_error *error);

/* Calls take for each row of `columns` numbers, at most 8, of a text table (base/rows.h), until one call fails. #
   begins a comment, and one line before the first row may name the columns. least: rows that the file must have;
   expected: the columns with their units in parentheses, for messages and to refuse a header that names others.
   SB_BAD_INPUT names the file and the line. */
sb_status sb_number_rows_visit(const char *path, size_t columns, size_t least, const char *expected,
                               sb_number_row *take, void *context, sb_error *error);

typedef struct sb_number_rows {
    double *values; /* row after row */
    size_t *lines;  /* of each row, counted from 1 */
    size_t count;   /* of rows, at least 1 */
} sb_number_rows;

/* Reads such rows. The caller frees them with sb_number_rows_free; after a failure there is nothing to free. */
sb_status sb_number_rows_read(const char *path, size_t columns, const char *expected, sb_number_rows *rows,
                              sb_error *error);

void sb_number_rows_free(sb_number_rows *rows);

#endif
