/* Sub-particle-scale turbulence [W, eqs. 8, 9]: computes each particle's eddy viscosity, which
   src/sim/terms/viscosity.c adds to the physical viscosity. */
#ifndef SB_SIM_TURBULENCE_H
#define SB_SIM_TURBULENCE_H

#include "sim/simulation.h"

/* Whether the scene uses turbulence. If not, sim->work.eddy is NULL and no stage runs. */
bool sb_turbulence_on(const sb_scene *scene);

/* Computes sim->work.eddy from the velocities after the stress correction, the neighbour lists and the densities. Never
   fails. */
sb_status sb_stage_turbulence(sb_sim *sim, sb_error *error);

#endif
