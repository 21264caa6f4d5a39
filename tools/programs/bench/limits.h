/* Measures the limits of this machine before each section, for comparison with its figures. */
#ifndef SB_BENCH_LIMITS_H
#define SB_BENCH_LIMITS_H

#include "sections.h"

/* Adds rows of the subject "machine": the speed of a = b and of a = b + s c [McCalpin 1995], and of products and sums
   held in registers, by the threads of the request. Sets the medians in the request. Bytes are those of the program:
   cache lines that a processor reads before it writes to them are not counted. */
sb_status sb_bench_limits(sb_bench_request *request, sb_bench_rows *rows, sb_error *error);

/* SB_BAD_INPUT: the tables of that folder are of a machine with another copy bandwidth than the request's. Machines
   with processors of the same name may differ in memory. */
sb_status sb_bench_same_machine(const char *folder, const sb_bench_request *request, sb_error *error);

#endif
