/* Sub-particle-scale turbulence: the eddy viscosity nu_t = min(C_s dr, kappa d)^2 |S| [W, eqs. 8, 9] of each particle,
   with |S| = sqrt(2 S:S), S the strain rate and d the distance from the nearest wall. The stage forces adds it to the
   physical viscosity. Velocity gradients are corrected by the neighbours' second moments, so that linear fields are
   exact also beside walls and free surfaces. The velocities of walls do not enter, because water slips along them. */
#ifndef SB_SIM_TURBULENCE_H
#define SB_SIM_TURBULENCE_H

#include "sim/simulation.h"

/* von Karman's constant, as in [W]. */
static const float SB_KARMAN = 0.4f;

/* Smallest determinant of the second moments for which gradients are corrected. It is 1 for isotropic moments, 0.6
   along the edge of a block of water, 0.3 in its corner, and 0 in a film of one layer, whose velocities contain no
   gradient across the film. */
static const float SB_THINNEST = 0.1f;

/* Computes sim->work.eddy from the velocities after the stress correction, the neighbour lists and the densities.
   SB_FAILED: too many boundary particles are near a particle. */
sb_status sb_stage_turbulence(sb_sim *sim, sb_error *error);

#endif
