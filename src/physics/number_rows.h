/* Reads rows of numbers from a text file. */
#ifndef SB_PHYSICS_NUMBER_ROWS_H
#define SB_PHYSICS_NUMBER_ROWS_H

#include "base/status.h"

#include <stddef.h>

/* Reads a file of text of at most 64 MB into *text, which the caller frees with sb_free. SB_BAD_INPUT names the place
   of a zero byte or another control character, which only a file that is no text table has. */
sb_status sb_number_text_read(const char *path, char **text, sb_error *error);

/* Reads `columns` numbers from each line into *values, row after row, which the caller frees with sb_free; *rows: their
   number. Blanks, a comma or a semicolon separate numbers, # begins a comment, and one line before the first row may
   name the columns. expected: what a row is, for messages. SB_BAD_INPUT names the file and the line. */
sb_status sb_number_rows_read(const char *path, size_t columns, const char *expected, double **values, size_t *rows,
                              sb_error *error);

#endif
