/* Recognises the header of a table of numbers, as spreadsheets and other programs write it. */
#ifndef SB_BASE_COLUMNS_H
#define SB_BASE_COLUMNS_H

#include <stdbool.h>
#include <stddef.h>

/* Returns whether the line names the columns: it contains words, and none of them is a number. Blanks, commas,
   semicolons and quotes separate words. */
bool sb_columns_header(const char *line, size_t length);

/* Returns the first unit in such a line that is none of metres, seconds and degrees ("mm", "cm", "km", "ft", "ms",
   "min", "h", "Hz", "rad"), or NULL. */
const char *sb_columns_unit(const char *line, size_t length);

/* Returns the number, from 1, of the first column whose name has the unit m or s although `units` has another one for
   it, or 0. units: 'm', 's' or another character for each column. Commas, semicolons or tabs separate names that
   contain blanks. */
size_t sb_columns_misplaced(const char *line, size_t length, const char *units);

/* Returns the number, from 1, of the first column that has the name of another one, or of a quantity that the table
   does not have ("frequency"), or 0. expected: the names in their order, each followed by its unit in parentheses:
   "time (s) surface (m)". A name may be cut short ("t"), and names other than these count as right. */
size_t sb_columns_misnamed(const char *line, size_t length, const char *expected);

#endif
