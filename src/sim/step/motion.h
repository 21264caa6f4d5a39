/* Motion of a particle by a step, in whole quanta. */
#ifndef SB_SIM_MOTION_H
#define SB_SIM_MOTION_H

#include "sim/state/space.h"

#include <math.h>

/* Rounds to quanta. A clamped position is outside of the domain, and the sort drops the particle. */
SB_INLINE uint32_t sb_moved(uint32_t from, float step)
{
    float bound = 1.0e9f;
    step = step < -bound ? -bound : step > bound ? bound : step;
    int64_t to = (int64_t)from + (int64_t)rintf(step);
    return to < 0 ? 0 : to >= SB_POSITION_END ? SB_POSITION_END - 1 : (uint32_t)to;
}

#endif
