/* Where a run's time went: the table that `run --profile` prints. */
#ifndef SB_OUTPUT_PROFILE_H
#define SB_OUTPUT_PROFILE_H

#include "output/saved.h"

#include <stdio.h>

enum { SB_PROFILE_LISTS = 4 };

/* Pointers are read during the call only. Seconds are wall time of the whole team. */
typedef struct sb_profile {
    const sb_stage_time *stages; /* since the start, settling included */
    size_t stage_count;
    uint64_t steps, iterations; /* of the run proper, settling not included */
    double particle_steps;      /* sum over those steps of the fluid particles there were */
    size_t settling_particles;  /* fluid particles while the water came to rest */
    double setup, settling;     /* s: before the first step; bringing the water to rest */
    double wall, simulated;     /* s: all in all; of the scene's clock */
    size_t bytes;               /* heap bytes of the simulation */
    int threads;
    const sb_skipped *skipped[SB_PROFILE_LISTS]; /* NULL: no list */
} sb_profile;

/* One line per stage with its calls, seconds, share of all stages and ns per particle and step; then steps,
   iterations, particle-steps per second, memory, and what the scene let the run leave out and what that saved.
   Settling's steps are in the stages' figures, and in the particle-steps that they are divided by. */
void sb_profile_print(FILE *out, const sb_profile *profile);

#endif
