/* Writes benchmarks.md from the kept rows of each machine. */
#ifndef SB_BENCH_REPORT_H
#define SB_BENCH_REPORT_H

#include "sections.h"

#include <stdio.h>

/* The kept rows of one section. */
typedef struct sb_bench_table {
    const sb_bench_section *section;
    bool found;
    char origin[2048];
    sb_bench_rows rows;
} sb_bench_table;

/* Marks the origin of a table of a quick form. */
#define SB_BENCH_QUICKLY ", quick"

enum { SB_BENCH_TABLES_MAX = 16 };

/* The tables of one machine. */
typedef struct sb_bench_tables {
    size_t count;
    sb_bench_table table[SB_BENCH_TABLES_MAX];
} sb_bench_tables;

/* Reads all existing FOLDER/<section>.csv. Zero-initialise the tables before, free them in any case. */
sb_status sb_bench_tables_read(sb_bench_tables *tables, const char *folder, sb_error *error);
void sb_bench_tables_free(sb_bench_tables *tables);

/* Writes OUT/benchmarks.md, machine by machine, from the tables in OUT/bench/<machine>/, and beside those scaling.png
   (without gnuplot: no picture). */
sb_status sb_bench_report(const char *out, sb_error *error);

/* Parts of the report. */

/* Writes the table of targets of one machine: figure, time, judged ratio, target, stretch target, result. */
void sb_bench_put_targets(FILE *file, const sb_bench_tables *tables);
/* Copy bandwidth measured with that table or, failing that or with NULL, with another one of the machine. NULL: none.
 */
const sb_bench_row *sb_bench_copy(const sb_bench_tables *tables, const sb_bench_table *table);
/* Cost per particle of the largest basin divided by that of the smallest, with most threads; NaN: not measured. */
double sb_bench_growth(const sb_bench_rows *scaling);
/* Parallel efficiency of that many threads; NaN: not measured. */
double sb_bench_efficiency(const sb_bench_rows *scaling, size_t particles, int threads);

#endif
