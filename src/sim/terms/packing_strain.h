/* The density of a strained packing, for the density correction (docs/method.md, M4b; docs/decisions/0097).

   Water that is strained keeps its density. The density sum of its particles does not: a particle at the surface gains
   neighbours where the packing is stretched upwards, and a stretched lattice has a larger sum than a square one.
   Without this stage the solve moves water until the sum is that of the packing at the start: crests rise by half a
   spacing times the strain. The stage therefore takes from c_i what a smooth strain without change of volume adds to
   the sum:

       dc_i/dt = -sum_j m (L_i + L_j)/2 x_ij . grad W_ij,   L_i = <deviatoric part of the rate of strain>_i

   <> is the mean of the stress correction (sim/terms/stress_correction.h), whose force has the same form: strains of
   the scale of waves cost neither force nor density, and the order of adjacent particles stays under both. */
#ifndef SB_SIM_PACKING_STRAIN_H
#define SB_SIM_PACKING_STRAIN_H

#include "sim/simulation.h"

/* Stage, after the density correction: changes c_i and the density. Not while water settles, and not in strips of given
   water. */
sb_status sb_stage_packing_strain(sb_sim *sim, sb_error *error);

#endif
