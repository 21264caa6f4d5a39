/* The density correction c_i (docs/method.md, section 3). A particle's density sum is too low where the free surface
   cuts its kernel off. c_i is this difference on the initial lattice. It is stored with the particle and added to its
   density sum in every step. The free surface therefore stays in place instead of sinking until the sum equals the rest
   density, and the initial lattice is at rest.
   c_i is constant while a particle remains where it is. The density then has the same derivative as the plain sum, and
   the balances of momentum and energy hold unchanged. Where a particle moves from the surface into the bulk, c_i
   returns to the value of the bulk. The walls must complete the kernel as water does: walls that reflect it, not
   boundary particles. */
#ifndef SB_SIM_DENSITY_CORRECTION_H
#define SB_SIM_DENSITY_CORRECTION_H

#include "sim/simulation.h"

/* Marks all corrections as not yet known, as before the first step. */
void sb_density_correction_clear(sb_sim *sim);

/* Updates the corrections from the results of the stage neighbours, and adds them to the densities. Never fails. */
sb_status sb_stage_density_correction(sb_sim *sim, sb_error *error);

#endif
