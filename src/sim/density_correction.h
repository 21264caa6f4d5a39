/* What a particle's density sum lacks where its kernel is cut off by the surface, or has too much of where a wall
   stands in for water: taken from the lattice that the particle starts in, carried along with it, and added to its sum.
   So the surface rests at its place, instead of sinking until the sum is full, and the lattice is at rest as it was
   laid; and since the addition is constant while a particle stays where it is, the constraint on its density has
   the plain sum's derivative: forces still derive from it, momentum and energy balance as before.
   A particle that comes from the surface, or from a wall, into the bulk of the water gives its addition up. */
#ifndef SB_SIM_DENSITY_CORRECTION_H
#define SB_SIM_DENSITY_CORRECTION_H

#include "sim/state.h"

/* Whether the scene asks for it; where not, sim->density_correction stays NULL and no stage runs. */
bool sb_density_correction_on(const sb_scene *scene);

/* Before the first step: none is known. */
void sb_density_correction_clear(sb_sim *sim);

/* Adds them to the densities, from what the stage neighbours left. Never fails. */
sb_status sb_stage_density_correction(sb_sim *sim, sb_error *error);

#endif
