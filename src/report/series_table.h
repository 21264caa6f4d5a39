/* A table of a run (forces.csv, gauges.csv, ...) in memory, as one series for each body, gauge or line. */
#ifndef SB_REPORT_SERIES_TABLE_H
#define SB_REPORT_SERIES_TABLE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_SERIES_COLUMNS_MAX = 20 }; /* of values, the time included */

typedef struct sb_series {
    char *name;
    size_t rows, capacity; /* capacity counts values */
    double *values;        /* rows x columns, the time first; NaN: the cell is empty */
} sb_series;

typedef struct sb_series_table {
    size_t columns;
    char *names[SB_SERIES_COLUMNS_MAX]; /* of the columns, as in the file's header */
    size_t count, capacity;
    sb_series *series; /* in the order of their first rows */
    size_t damaged; /* lines that are no rows of this table, and rows whose time does not increase; they are left out */
} sb_series_table;

/* Reads at most `columns` values of each row, the time included; a row is time, name, values. named: false for a table
   without names, such as energy.csv, whose only series is "". SB_BAD_INPUT if there is no such file, if it is larger
   than 1 GB, or if its header is not that of a run's table. The last line may be incomplete. */
sb_status sb_series_table_read(const char *path, size_t columns, bool named, sb_series_table *table, sb_error *error);
void sb_series_table_free(sb_series_table *table);

/* The series with this name; NULL: there is none. */
const sb_series *sb_series_table_find(const sb_series_table *table, const char *name);

/* The value of a row. */
static inline double sb_series_table_value(const sb_series_table *table, const sb_series *series, size_t row,
                                           size_t column)
{
    return series->values[row * table->columns + column];
}

#endif
