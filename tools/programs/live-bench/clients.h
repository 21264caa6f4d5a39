/* Clients of a run's web server that read frames: well, slowly, or not at all. They join and leave. */
#ifndef SB_LIVE_BENCH_CLIENTS_H
#define SB_LIVE_BENCH_CLIENTS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sb_bench_clients sb_bench_clients;

/* When frames became complete at a subscriber in this process, to compare with. */
enum { SB_BENCH_FRAMES = 1 << 14 };
typedef struct sb_bench_arrivals {
    double time[SB_BENCH_FRAMES]; /* s, of sb_clock, of frame n % SB_BENCH_FRAMES; 0: not known */
    int64_t newest;
} sb_bench_arrivals;

/* The first client does not read, the second one reads 1 kB/s; of the others, every second one leaves and joins again
   after some seconds. SB_FAILED without memory. */
sb_status sb_bench_clients_create(int port, size_t count, sb_bench_clients **clients, sb_error *error);
void sb_bench_clients_destroy(sb_bench_clients *clients);

/* Reads what has arrived. */
void sb_bench_clients_read(sb_bench_clients *clients, const sb_bench_arrivals *arrivals);

typedef struct sb_bench_reception {
    uint64_t frames, bytes;  /* of the clients that read well */
    uint64_t joins, dropped; /* dropped: connections that the server ended */
    uint64_t late;           /* frames that were complete at a client more than `interval` after the subscriber */
    double latest;           /* s, the largest such delay */
} sb_bench_reception;
/* interval: s, above which a frame counts as late; it may be set again at any time. */
void sb_bench_clients_interval(sb_bench_clients *clients, double interval);
sb_bench_reception sb_bench_clients_result(const sb_bench_clients *clients);

#endif
