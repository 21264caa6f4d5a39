/* benchmarks.md, made of the sections' tables. */
#ifndef SB_BENCHMARK_REPORT_H
#define SB_BENCHMARK_REPORT_H

#include "sections.h"

#include <stdio.h>

/* The tables that there are. */
typedef struct sb_bench_table {
    const sb_bench_section *section;
    bool found;
    char origin[2048];
    sb_bench_rows rows;
} sb_bench_table;

/* Marks the origin of a quick form's table. */
#define SB_BENCH_QUICKLY ", quick"

enum { SB_BENCH_TABLES_MAX = 16 };

typedef struct sb_bench_tables {
    size_t count;
    sb_bench_table table[SB_BENCH_TABLES_MAX];
} sb_bench_tables;

/* Reads OUT/bench/<section>.csv, those that there are, and writes OUT/benchmarks.md and OUT/bench/scaling.png
   (without gnuplot: no picture). */
sb_status sb_bench_report(const char *out, sb_error *error);

/* Inside the report. */

/* The table of what was to be reached, row by row: figure, reach, stretch, measured, whether it passes. */
void sb_bench_put_reach(FILE *file, const sb_bench_tables *tables);
/* The row looked for, in the table of that section; NULL: none. */
const sb_bench_row *sb_bench_look_up(const sb_bench_tables *tables, const char *section, const char *subject,
                                     const char *quantity);
/* The largest basin's cost per particle over the smallest's, on the most threads; NaN: not measured. */
double sb_bench_growth(const sb_bench_rows *scaling);
/* Parallel efficiency from one thread to the most, in the basin nearest to a million particles; NaN. */
double sb_bench_efficiency(const sb_bench_rows *scaling, size_t particles, int threads);

#endif
