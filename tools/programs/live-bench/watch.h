/* One run that is shown to browsers: its processor time by step, the memory of its server, the arrival of its frames.
 */
#ifndef SB_LIVE_BENCH_WATCH_H
#define SB_LIVE_BENCH_WATCH_H

#include "clients.h"

enum { SB_BENCH_SAMPLES = 1 << 14 };

typedef struct sb_bench_watch {
    /* Given: */
    const char *program, *scene, *out, *output; /* output: file for what the run prints */
    double seconds;                             /* after its first frame */
    size_t clients;
    /* Found: */
    size_t samples;
    double step[SB_BENCH_SAMPLES], processor[SB_BENCH_SAMPLES]; /* s, of the run's process */
    double memory_settled, memory_end;                          /* bytes, of the server: after a quarter, at the end */
    double interval;                                            /* s, mean between two frames */
    double server_processor;                                    /* s, of shorebreak-live and its receiver */
    sb_bench_reception reception;
    sb_bench_arrivals arrivals;
} sb_bench_watch;

/* Runs and watches. SB_FAILED with the reason if the run fails or sends nothing. */
sb_status sb_bench_watch_run(sb_bench_watch *watch, sb_error *error);

/* The processor time at a step, between samples on straight lines. */
double sb_bench_processor_at(const sb_bench_watch *watch, double step);

#endif
