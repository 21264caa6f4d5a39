/* The motion of a paddle that absorbs, from step to step: its displacement from its law. */
#ifndef SB_PHYSICS_ABSORBING_H
#define SB_PHYSICS_ABSORBING_H

#include "physics/wavemakers/paddle_transfer.h"

#include <stdbool.h>

/* Zero-initialised: a paddle at its law beside still water. */
typedef struct sb_absorbing_state {
    double mean;          /* m, of second order, of the surface beside the paddle */
    double low, fast;     /* m, slow part of the surface, and its lagged part */
    double offset, speed; /* m, displacement from the law; m/s, its rate in the last step */
} sb_absorbing_state;

/* What a step needs. */
typedef struct sb_absorbing_input {
    double surface;     /* m, measured beside the paddle, above its level at rest */
    double expected;    /* m, what the law makes there by linear theory */
    double law_speed;   /* m/s, of the law */
    double least, most; /* m, of the offset: <= 0, >= 0 */
} sb_absorbing_input;

/* Advances the state by dt > 0. Returns whether the end of its reach stopped the paddle. */
bool sb_absorbing_advance(const sb_absorbing_filter *filter, const sb_absorbing_input *input, double dt,
                          sb_absorbing_state *state);

#endif
