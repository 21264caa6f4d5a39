/* Sub-particle-scale turbulence after [W, eqs. 8, 9]: each particle's eddy viscosity, which src/sim/viscosity.c
   adds to the water's own. */
#ifndef SB_SIM_TURBULENCE_H
#define SB_SIM_TURBULENCE_H

#include "sim/state.h"

/* Whether the scene asks for it; where not, sim->eddy stays NULL and no stage runs. */
bool sb_turbulence_on(const sb_scene *scene);

/* sim->eddy from the velocities at the step's start, the packing's stress taken away, and the step's neighbour lists
 * and densities. Never fails. */
sb_status sb_stage_turbulence(sb_sim *sim, sb_error *error);

#endif
