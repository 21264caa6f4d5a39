/* How the water comes to rest before t = 0, and how far it has come. */
#ifndef SB_SIM_SETTLE_H
#define SB_SIM_SETTLE_H

#include "sim/sim.h"
#include "sim/simd.h"

enum sb_settling {
    SB_RUNNING,     /* not at all: time goes on */
    SB_DAMPING,     /* a sea: part of the velocity is lost in each step; an initial wave is held by a pull */
    SB_CALMING,     /* the same, at settling's end: pressures start from the run's share again */
    SB_CREEPING,    /* boxes of water, which nothing holds: all of it */
    SB_START_TRIAL, /* one step that moves nothing and tells how velocities change at t = 0 */
};

/* Where settling is between two of its steps. */
typedef struct sb_settle {
    bool under_way;
    int done, most; /* steps */
    int turn;       /* the step at which the last ones begin */
    int calm;       /* calm steps in a row */
    double speed;   /* m/s, the highest after the last of them; the next one tells it anew, so no checkpoint has it */
    double kinetic; /* J, at the last trial; INFINITY: there was none */
} sb_settle;

/* Whether the step that was the last has been made. What it left behind is not saved: the water is let
   go from it at once. */
bool sb_settle_over(const sb_settle *settle);
/* Horizontal acceleration (m/s^2) that keeps an initial wave's surface level while it settles:
   with g it stands everywhere across the surface, g d(eta)/dx. */
float sb_settle_wave_acceleration(const sb_sim *sim, sb_record at);

#endif
