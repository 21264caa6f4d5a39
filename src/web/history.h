/* The rows of forces and gauges that have arrived, for subscribers that join late. Memory is bounded: when a table is
   full, two neighbouring rows become one, and from then on so do arriving rows. */
#ifndef SB_WEB_HISTORY_H
#define SB_WEB_HISTORY_H

#include "stream/decode.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct sb_history_table {
    int components; /* values per name */
    size_t names;
    char (*name)[SB_STREAM_NAME];
    size_t rows, capacity; /* the last row is incomplete until `filled` is `names` and `merged` is `stride` */
    size_t filled, merged, stride;
    double *time;        /* s, capacity of them */
    float *value;        /* names * components per row; NaN: not known */
    uint64_t generation; /* changes when rows that were there before change */
} sb_history_table;

/* Zero-initialised it is empty, but for `components`. */
void sb_history_free(sb_history_table *table);
/* Forgets all rows and names. */
void sb_history_clear(sb_history_table *table);
/* Forgets the rows from this time on: a resumed run repeats them. */
void sb_history_cut(sb_history_table *table, double time);

/* Rows [first, first + count) of `total` of one time. values: `components` each. Rows are lost without memory. */
typedef struct sb_history_rows {
    double time;
    size_t total, first, count;
    const char (*name)[SB_STREAM_NAME];
    const float *value;
} sb_history_rows;
void sb_history_add(sb_history_table *table, const sb_history_rows *rows);

/* Number of complete rows. */
size_t sb_history_count(const sb_history_table *table);

/* Writes {"generation", "from", "stride", "names", "rows", "more"}: the complete rows from row `from` of `generation`
   on; from row 0 if the table has another generation. Each row is [time, value, ...]. Stops after about `limit` bytes;
   "more" says whether rows are left. */
void sb_history_write(const sb_history_table *table, uint64_t generation, size_t from, size_t limit, FILE *stream);

#endif
