/* What a step does: whether it is a step of the run, or one of the kinds of step that bring the water to rest before
   t = 0 (docs/method.md, section 10). A stage asks the policy and never which kind of step this is. */
#ifndef SB_SIM_POLICY_H
#define SB_SIM_POLICY_H

#include <stdbool.h>

typedef struct sb_step_policy {
    const char *name;
    bool runs;           /* time advances, paddles move; ledger, impulses on bodies and departures' energy are booked */
    bool holds_wave;     /* an acceleration holds the surface of an initial wave */
    bool moves;          /* particles move */
    bool damps;          /* velocities are damped before the particles move */
    float keep_after;    /* fraction of the velocity that remains after they have moved */
    double step_factor;  /* on the time step that waves permit */
    double longest_step; /* particle spacings over sqrt(g D) */
    float release;       /* particle spacings by which contact moves out a particle that is too close to a wall */
} sb_step_policy;

extern const sb_step_policy sb_policy_run;
/* Settling: each step removes part of the velocity. */
extern const sb_step_policy sb_policy_damp;
/* Settling: each step removes all of the velocity. */
extern const sb_step_policy sb_policy_creep;
/* One step that moves nothing and determines the change of the velocities at t = 0. */
extern const sb_step_policy sb_policy_start_trial;

#endif
