/* The course of a value from its first sample to the newest one, in a fixed number of intervals, for sparklines. */
#ifndef SB_MONITOR_HISTORY_H
#define SB_MONITOR_HISTORY_H

#include <stdint.h>

enum { SB_HISTORY = 64 };

/* Of each interval, the sample of largest magnitude. When all intervals are used, pairs of them are joined. A
   zero-initialised struct is empty. */
typedef struct sb_history {
    double value[SB_HISTORY];
    int count;
    uint64_t stride, held; /* samples of an interval; of the newest one so far */
} sb_history;

void sb_history_add(sb_history *history, double value);

#endif
