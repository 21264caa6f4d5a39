/* How many threads the system allows: libraries that cannot start theirs hang or end the process. */
#ifndef SB_BASE_THREADS_H
#define SB_BASE_THREADS_H

enum { SB_THREADS_MOST = 1200 };

/* Starts up to `wanted` threads at once, SB_THREADS_MOST at most, which do nothing, and ends them: how many the limits
   of processes and of memory allow at this moment, besides those that run. */
int sb_threads_allowed(int wanted);

#endif
