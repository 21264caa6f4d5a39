#include "sim/step/policy.h"

#include <math.h>

/* Damped water moves in proportion to dt^2, and it is slow enough for longer steps. */
#define DAMPED_STEP 1.5

/* Longest creeping step. A step of any length removes the same fraction of a density error, but unsupported water falls
   in proportion to dt^2 (docs/decisions/0021). */
#define CREEPING_STEP 0.15

/* Distance by which settling moves out, in each step, a particle that starts too close to a wall. During the run such a
   particle may not come any closer, and only pressure moves it out, so that contact resolution adds no energy. */
#define RELEASE 0.005f

#define ANY INFINITY

const sb_step_policy sb_policy_run = {
    .name = "running",
    .runs = true,
    .moves = true,
    .keep_after = 1,
    .step_factor = 1,
    .longest_step = ANY,
};

const sb_step_policy sb_policy_damp = {
    .name = "damping",
    .holds_wave = true,
    .moves = true,
    .damps = true,
    .keep_after = 1,
    .step_factor = DAMPED_STEP,
    .longest_step = ANY,
    .release = RELEASE,
};

const sb_step_policy sb_policy_creep = {
    .name = "creeping",
    .holds_wave = true,
    .moves = true,
    .keep_after = 0,
    .step_factor = 1,
    .longest_step = CREEPING_STEP,
    .release = RELEASE,
};

const sb_step_policy sb_policy_start_trial = {
    .name = "start trial",
    .moves = false,
    .keep_after = 1,
    .step_factor = 1,
    .longest_step = ANY,
    .release = RELEASE,
};
