/* Each subject is measured in a process of its own: its peak memory is its own, no thread team of another is left
   over, and what fails takes nothing else along. */
#ifndef SB_BENCHMARK_CHILD_H
#define SB_BENCHMARK_CHILD_H

#include "rows.h"

typedef sb_status sb_bench_work(const void *context, sb_bench_rows *rows, sb_error *error);

/* Runs the work in a forked process and appends its rows. The caller must not have used OpenMP before. SB_FAILED when
   the process died. */
sb_status sb_bench_in_child(sb_bench_work *work, const void *context, sb_bench_rows *rows, sb_error *error);

#endif
