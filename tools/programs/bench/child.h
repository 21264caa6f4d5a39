/* Each subject is measured in its own process. Its peak memory is not that of other subjects, no threads of others
   remain, and a failure does not affect other subjects. */
#ifndef SB_BENCH_CHILD_H
#define SB_BENCH_CHILD_H

#include "sections.h"

/* Runs the work in a process with the requested number of threads and appends its rows. The caller must not have used
   OpenMP before. A failure has the status and message of the work, or SB_FAILED if a signal ended the process. */
sb_status sb_bench_in_child(sb_bench_run *work, const sb_bench_request *request, sb_bench_rows *rows, sb_error *error);
/* The same for several sizes, in request->particles. sizes: ended by 0. */
sb_status sb_bench_sizes(sb_bench_run *work, const sb_bench_request *request, const size_t *sizes, sb_bench_rows *rows,
                         sb_error *error);

#endif
