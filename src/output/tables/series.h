/* Reads a table of the run back as named series for plotting. Private to src/output. */
#ifndef SB_OUTPUT_SERIES_H
#define SB_OUTPUT_SERIES_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_SERIES_COLUMNS = 14, SB_SERIES_NAME = 64 };

/* One row: values[0] is the time, values[k] column k of the file (from 0); NaN where it is empty. */
typedef struct sb_series_row {
    size_t name;
    double values[SB_SERIES_COLUMNS];
} sb_series_row;

typedef struct sb_series {
    size_t name_count, name_capacity, row_count, row_capacity;
    char (*names)[SB_SERIES_NAME]; /* in the order of first appearance */
    sb_series_row *rows;
} sb_series;

/* named: the second column is a name, as in all tables except energy.csv, which becomes one series "". Incomplete lines
   are ignored. */
sb_status sb_series_read(const char *path, bool named, sb_series *series, sb_error *error);
void sb_series_free(sb_series *series);

#endif
