/* What this machine can do at best, measured just before each section whose figures are held against it. */
#ifndef SB_BENCHMARK_LIMITS_H
#define SB_BENCHMARK_LIMITS_H

#include "sections.h"

/* Adds rows of the subject "machine": the speed of a = b and of a = b + s c [McCalpin 1995], and of products and sums
   held in registers, by the threads of the request. Sets the medians in the request. Bytes are those that the program
   names: what a processor reads in addition, to own a line before it writes to it, is not counted. */
sb_status sb_bench_limits(sb_bench_request *request, sb_bench_rows *rows, sb_error *error);

/* SB_BAD_INPUT where that folder's tables are of a machine with another copy bandwidth than the request's: machines
   whose processors share a name may differ in memory. */
sb_status sb_bench_same_machine(const char *folder, const sb_bench_request *request, sb_error *error);

#endif
