/* A subscriber in a process of its own. */
#ifndef SB_STREAM_BENCH_SUBSCRIBER_H
#define SB_STREAM_BENCH_SUBSCRIBER_H

#include "base/status.h"
#include "stream/live.h"

#include <sys/types.h>

typedef struct sb_bench_result {
    sb_live_counts counts;
    double scene_seconds; /* from the subscription to the complete scene; negative: it did not come */
    double processor;     /* s */
    bool ended;           /* the stream's last status arrived */
} sb_bench_result;

typedef struct sb_bench_subscriber {
    pid_t process;
    int pipe; /* its end for reading */
} sb_bench_subscriber;

/* Starts a process that subscribes and receives for at most so many seconds, or until the stream has ended. Returns
   when it has subscribed. Call it before this process opens LCM. */
sb_status sb_bench_subscribe(const char *url, const char *prefix, double seconds, sb_bench_subscriber *subscriber,
                             sb_error *error);
/* Waits for its end. SB_FAILED if it ended without a result. */
sb_status sb_bench_result_of(sb_bench_subscriber *subscriber, sb_bench_result *result, sb_error *error);

#endif
