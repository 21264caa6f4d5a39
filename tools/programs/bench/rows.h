/* Measured values: rows of one table, stored as CSV. */
#ifndef SB_BENCH_ROWS_H
#define SB_BENCH_ROWS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_BENCH_NAME = 64, SB_BENCH_REPEATS_MAX = 100 };

/* One quantity of one subject, over repeats of the same work. */
typedef struct sb_bench_row {
    char subject[SB_BENCH_NAME]; /* a kernel, a scene, "machine" */
    size_t particles;            /* fluid particles; 0: not applicable */
    int threads;
    char quantity[SB_BENCH_NAME]; /* "time per particle", "memory", ... */
    char unit[SB_BENCH_NAME];
    double least, median, most;
    int repeats;
} sb_bench_row;

/* A zero-initialised table is empty. */
typedef struct sb_bench_rows {
    size_t count, capacity;
    sb_bench_row *rows;
    bool incomplete;
} sb_bench_rows;

/* Samples of one quantity. */
typedef struct sb_bench_samples {
    double value[SB_BENCH_REPEATS_MAX];
    int count;
} sb_bench_samples;

/* Adds a sample; samples beyond SB_BENCH_REPEATS_MAX are ignored. */
void sb_bench_sample(sb_bench_samples *samples, double value);

/* NaN: no samples. */
double sb_bench_median(const sb_bench_samples *samples);

/* Adds smallest value, median and largest value of the samples, each times `factor`. */
void sb_bench_add(sb_bench_rows *rows, const char *subject, size_t particles, int threads, const char *quantity,
                  const char *unit, const sb_bench_samples *samples, double factor);
/* Quantities without repeats. */
typedef struct sb_bench_value {
    const char *quantity, *unit;
    double value;
} sb_bench_value;
void sb_bench_add_value(sb_bench_rows *rows, const char *subject, size_t particles, int threads, const char *quantity,
                        const char *unit, double value);
void sb_bench_add_values(sb_bench_rows *rows, const char *subject, size_t particles, int threads,
                         const sb_bench_value *values, size_t count);
/* SB_FAILED: memory was exhausted and rows are missing. */
sb_status sb_bench_complete(const sb_bench_rows *rows, sb_error *error);
void sb_bench_rows_free(sb_bench_rows *rows);

/* The first row of that subject and quantity; particles 0 or threads 0: any. NULL: none. */
const sb_bench_row *sb_bench_find(const sb_bench_rows *rows, const char *subject, size_t particles, int threads,
                                  const char *quantity);

/* Writes a CSV file, whole or not at all, after the lines of `origin`, each with a leading '#'. */
sb_status sb_bench_write(const sb_bench_rows *rows, const char *origin, const char *path, sb_error *error);
/* Appends the rows of such a file. *found: false, without error, if the file does not exist. origin: the lines with
   '#', at most `size` bytes. */
sb_status sb_bench_read(sb_bench_rows *rows, char *origin, size_t size, bool *found, const char *path, sb_error *error);

#endif
