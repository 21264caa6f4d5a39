/* Sponges: zones in which water is slowed down or has a viscosity, physics/sponge.h. */
#ifndef SB_SIM_SPONGE_H
#define SB_SIM_SPONGE_H

#include "sim/simulation.h"

/* Stages. After the forces: v* loses strength dt/(1 + strength dt) of the velocity at the step's start, so that water
   at rest stays at rest. */
sb_status sb_stage_sponge(sb_sim *sim, sb_error *error);
/* Sums the work and the momentum of that into sim->work, before particles move. */
sb_status sb_stage_drained(sb_sim *sim, sb_error *error);

/* After the turbulence: adds the viscosity of sponges to sim->work.eddy, which the stage forces adds to the physical
   viscosity. It acts on all pairs, with the mean that alpha would have on approaching pairs alone with h the support
   radius; method.md, section 14. */
sb_status sb_stage_viscous_sponge(sb_sim *sim, sb_error *error);

#endif
