/* The deviatoric stress correction, applied before each solve (docs/method.md, section 6; docs/decisions/0015). In a
   sheared particle packing the pressure acts more strongly along one direction than along another. In water it does
   not. */
#ifndef SB_SIM_STRESS_CORRECTION_H
#define SB_SIM_STRESS_CORRECTION_H

#include "sim/simulation.h"

/* Whether the scene uses the correction. If not, no stage runs. */
bool sb_stress_correction_on(const sb_scene *scene);

/* Adds the correction to the velocities of one step, from the pressures of the last step and the present neighbour
   lists. Momentum is conserved. The work is entered in the ledger. Fails, without changing velocities, if a particle
   would be too fast. */
sb_status sb_stage_stress_correction(sb_sim *sim, sb_error *error);

#endif
