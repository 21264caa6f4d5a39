/* Tables of numbers in columns, as spreadsheets and other programs write them. */
#ifndef SB_BASE_COLUMNS_H
#define SB_BASE_COLUMNS_H

#include <stdbool.h>
#include <stddef.h>

/* Whether the line names the columns: words, and none of them a number. Blanks, commas and semicolons part words. */
bool sb_columns_header(const char *line, size_t length);

/* A unit of length or time in such a line that is neither metre nor second ("mm", "cm", "km", "ft", "ms", "min", "h"),
   or NULL. */
const char *sb_columns_unit(const char *line, size_t length);

#endif
