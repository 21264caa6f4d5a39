/* Numbers and bars as short text for a table. */
#ifndef SB_MONITOR_TEXT_H
#define SB_MONITOR_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* "12 s", "3 min 05 s", "2 h 07 min", "unknown" for negative. */
void sb_text_duration(char *out, size_t size, double seconds);

/* The unit that shows `peak` newtons in at most four digits: its name and its size in N. */
typedef struct sb_text_unit {
    const char *name;
    double size;
} sb_text_unit;
sb_text_unit sb_text_force_unit(double peak);

/* A number in at most 9 characters, two decimals where they fit; sign: with + or -. */
void sb_text_number(char *out, size_t size, double value, bool sign);

/* A bar of `cells` columns filled to `share` (0..1), a mark at `mark` (< 0: none). In UTF-8 in
   eighths of a column, else of '#' and '.'. out has room for 4 cells + 1 bytes. */
void sb_text_bar(char *out, int cells, double share, double mark, bool utf8);

/* A bar that grows from the middle of 2 half + 1 columns: to the left for -1, to the right for 1.
 */
void sb_text_signed_bar(char *out, int half, double share, bool utf8);

#endif
