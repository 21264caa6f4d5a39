/* The run time of each stage: the table that `run --profile` prints. */
#ifndef SB_OUTPUT_PROFILE_H
#define SB_OUTPUT_PROFILE_H

#include "output/log/saved.h"

#include <stdio.h>

enum { SB_PROFILE_LISTS = 4 };

/* Pointers are read during the call only. Seconds are elapsed wall time, not summed over threads. */
typedef struct sb_profile {
    const sb_stage_time *stages; /* since the start, including settling */
    size_t stage_count;
    uint64_t steps, iterations; /* without settling */
    double particle_steps;      /* sum of the number of fluid particles over those steps */
    size_t settling_particles;  /* number of fluid particles during settling */
    double setup, settling;     /* s: before the first step; in settling */
    double wall, simulated;     /* s: total run time; simulated time */
    size_t bytes;               /* heap bytes of the simulation */
    int threads;
    const sb_skipped *skipped[SB_PROFILE_LISTS]; /* NULL: no list */
} sb_profile;

/* Prints one line per stage with its calls, seconds, fraction of all stages and ns per particle-step; then steps,
   iterations, particle-steps per second, memory, what the scene does not need, and what that saved. The stages' values,
   and the particle-steps by which they are divided, include settling. */
void sb_profile_print(FILE *out, const sb_profile *profile);

#endif
