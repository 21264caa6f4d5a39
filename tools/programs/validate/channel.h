/* Long waves in a channel between a side of kind sea and a wall: the reference of a case. */
#ifndef SB_VALIDATE_CHANNEL_H
#define SB_VALIDATE_CHANNEL_H

#include "curve.h"

/* The channel lies between x = 0, where a wave comes in, and a wall at x = length. bed: its height, m, at x. incoming:
   what u + 2 sqrt(g h) of the wave is above that of still water, m/s, at a time. */
typedef struct sb_channel {
    double length, level, gravity; /* m, m, m/s^2 */
    double (*bed)(double x);
    const sb_curve *surface, *velocity; /* of the incoming wave over time: m above the level, m/s */
} sb_channel;

/* Solves the shallow-water equations from rest until `duration` (s) and adds, at about every `interval` (s), the
   elevation at x to `eta` and the volume above still water, m^2, to `volume`. Second order in space; the flux of
   momentum is that of the central scheme, so that the flow must be far below u = sqrt(g h). */
void sb_channel_solve(const sb_channel *channel, double duration, double interval, double x, sb_curve *eta,
                      sb_curve *volume);

#endif
