/* Each subject is measured in its own process. Its peak memory is not that of other subjects, no threads of others
   remain, and a failure does not affect other subjects. */
#ifndef SB_BENCHMARK_CHILD_H
#define SB_BENCHMARK_CHILD_H

#include "rows.h"

typedef sb_status sb_bench_work(const void *context, sb_bench_rows *rows, sb_error *error);

/* Runs the work in a forked process and appends its rows. The caller must not have used OpenMP before. SB_FAILED: the
   process failed. */
sb_status sb_bench_in_child(sb_bench_work *work, const void *context, sb_bench_rows *rows, sb_error *error);

#endif
