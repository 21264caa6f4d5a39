/* A CSV file of ours, read back as named series for plotting. Inside src/output. */
#ifndef SB_OUTPUT_SERIES_H
#define SB_OUTPUT_SERIES_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_SERIES_COLUMNS = 14, SB_SERIES_NAME = 64 };

/* Row-wise values; [0] is the time, [k] the k-th column of the file; NaN where it is empty. */
typedef struct sb_series_row {
    size_t name;
    double values[SB_SERIES_COLUMNS];
} sb_series_row;

typedef struct sb_series {
    size_t name_count, name_capacity, row_count, row_capacity;
    char (*names)[SB_SERIES_NAME]; /* in the order of first appearance */
    sb_series_row *rows;
} sb_series;

/* named: the second column is a name, as in all tables but energy.csv (there one series "" is
   made). Incomplete lines are ignored. */
sb_status sb_series_read(const char *path, bool named, sb_series *series, sb_error *error);
void sb_series_free(sb_series *series);

#endif
