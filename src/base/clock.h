/* Elapsed time on the clock. It is for reports and for timeouts of connections and threads only: no decision of the
   simulation may depend on it. */
#ifndef SB_BASE_CLOCK_H
#define SB_BASE_CLOCK_H

#include <time.h>

/* Returns the seconds of a monotonic clock. */
static inline double sb_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
