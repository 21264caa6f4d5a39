/* Wall time, for reports only: nothing that steers a run may read it. */
#ifndef SB_BASE_CLOCK_H
#define SB_BASE_CLOCK_H

#include <time.h>

/* Seconds of a monotonic clock. */
static inline double sb_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
