/* What this machine can do at best, measured in the same process as the kernels that are held against it. */
#ifndef SB_BENCHMARK_LIMITS_H
#define SB_BENCHMARK_LIMITS_H

#include "rows.h"

/* Medians, by the threads OpenMP uses now. Bytes are those that the program names: what a processor reads in
   addition, to own a line before it writes to it, is not counted. */
typedef struct sb_bench_limits {
    double copy;       /* bytes per second of a = b */
    double triad;      /* of a = b + s c [McCalpin 1995] */
    double arithmetic; /* floating-point operations per second: products and sums held in registers, two each */
} sb_bench_limits;

/* Adds rows of the subject "machine". megabytes: of each of the three arrays; many times the last cache. */
sb_status sb_bench_limits_measure(size_t megabytes, int repeats, sb_bench_limits *limits, sb_bench_rows *rows,
                                  sb_error *error);

#endif
