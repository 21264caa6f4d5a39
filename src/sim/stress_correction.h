/* The packing's own stress, taken away before each solve (docs/method.md, section 6; docs/decisions/0015): where
   neighbours lie sheared, the pressure pushes harder along one direction than along another, though water does not. */
#ifndef SB_SIM_STRESS_CORRECTION_H
#define SB_SIM_STRESS_CORRECTION_H

#include "sim/state.h"

/* Whether the scene asks for it; where not, no stage runs. */
bool sb_stress_correction_on(const sb_scene *scene);

/* Adds to the velocities of one step what the stress lacks to be a pressure, by the pressures of the last step and the
   step's neighbour lists; momentum stays. Its work goes into the ledger. Uses acceleration, residual, source and
   scratch. Where that would make a particle too fast it fails, and velocities stay as they were. */
sb_status sb_stage_stress_correction(sb_sim *sim, sb_error *error);

#endif
