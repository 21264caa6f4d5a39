/* Settling: how the water comes to rest before t = 0, and its progress. */
#ifndef SB_SIM_SETTLE_H
#define SB_SIM_SETTLE_H

#include "sim/sim.h"
#include "sim/state/simd.h"

/* Progress of settling between two of its steps. */
typedef struct sb_settle {
    bool under_way;
    int done, most; /* steps */
    int turn;       /* the step at which the last steps begin */
    int calm;       /* calm steps in a row */
    double speed;   /* m/s, highest speed after the last step done; each step sets it, so that no checkpoint has it */
    double kinetic; /* J, at the last trial; INFINITY: no trial yet */
} sb_settle;

/* Whether the last settling step has been done. The state after it is never saved, because the run starts from it at
   once. */
bool sb_settle_over(const sb_settle *settle);
/* Horizontal acceleration (m/s^2) that holds an initial wave during settling, g d(eta)/dx. Together with gravity it is
   normal to the wave's surface everywhere. */
float sb_settle_wave_acceleration(const sb_sim *sim, sb_record at);

#endif
