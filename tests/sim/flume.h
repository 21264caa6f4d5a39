/* A flume with a sea at rest and a paddle, for tests of still water that sleeps. */
#ifndef SB_TESTS_FLUME_H
#define SB_TESTS_FLUME_H

#include "sim/tank.h"

#define SB_FLUME_DEPTH 1.0 /* m */

/* A paddle, body 1, at x = 0 that pushes for 0.9 s at up to 0.5 m/s: waves of a sixth of the depth. */
void flume_make(tank *t, int dimensions, double dr, sb_vec3 size, bool sleep);

#endif
