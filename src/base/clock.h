/* Elapsed time on the clock. It is for reports and for timeouts of connections and threads only: no decision of the
   simulation may depend on it. */
#ifndef SB_BASE_CLOCK_H
#define SB_BASE_CLOCK_H

#include <math.h>
#include <pthread.h>
#include <time.h>

/* Returns the seconds of a monotonic clock. */
static inline double sb_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The same clock's time so many seconds from now, for pthread_cond_timedwait. */
static inline struct timespec sb_clock_after(double seconds)
{
    const double then = sb_clock() + seconds;
    return (struct timespec){(time_t)floor(then), (long)(1e9 * (then - floor(then)))};
}

/* A condition whose timed waits are by this clock. */
static inline void sb_clock_init_condition(pthread_cond_t *condition)
{
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(condition, &attributes);
    pthread_condattr_destroy(&attributes);
}

#endif
