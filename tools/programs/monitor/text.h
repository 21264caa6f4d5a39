/* Formats numbers and bars as short text for a table. */
#ifndef SB_MONITOR_TEXT_H
#define SB_MONITOR_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Formats a duration as "12 s", "3 min 05 s" or "2 h 07 min"; a negative one as "unknown". */
void sb_text_duration(char *out, size_t size, double seconds);

/* A force unit: its name and its size in N. */
typedef struct sb_text_unit {
    const char *name;
    double size;
} sb_text_unit;
/* Returns the unit in which `peak` newtons have at most three digits before the decimal point (GN: any number). */
sb_text_unit sb_text_force_unit(double peak);

/* Formats a number in at most 9 characters, with two decimals where they fit; sign: always with + or -. */
void sb_text_number(char *out, size_t size, double value, bool sign);

/* Draws a bar of `cells` columns that is filled to `share` (0..1), with a mark at `mark` (< 0: none). In UTF-8 it is
   drawn in eighths of a column, else with '#' and '.'. out must have room for 4 cells + 1 bytes. */
void sb_text_bar(char *out, int cells, double share, double mark, bool utf8);

/* Draws the course of a value in at most `cells` columns, in eight levels from `low` to `high`. If there are more
   values than columns, each column shows the value of largest magnitude. out must have room for 3 cells + 1 bytes. */
void sb_text_spark(char *out, int cells, const double *values, int count, double low, double high, bool utf8);

#endif
