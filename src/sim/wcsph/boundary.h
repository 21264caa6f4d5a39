/* Dynamic boundary particles [W, eqs. 13, 15]: two staggered layers with the mass of water particles. Their density
   follows the continuity equation; their pressure is beta times that of the water nearby, interpolated to them, and
   1 - beta times that of their own density. A boundary particle that water reaches starts with the density of that
   water's pressure. */
#ifndef SB_SIM_WCSPH_BOUNDARY_H
#define SB_SIM_WCSPH_BOUNDARY_H

#include "sim/simulation.h"

/* sb_wall_set.number: an index into the arrays of sb_boundary. Images beyond periodic sides have the number of their
   original, and this flag. */
#define SB_BOUNDARY_IMAGE 0x80000000u

SB_INLINE uint32_t sb_boundary_number(const sb_wall_set *set, size_t particle)
{
    return set->number[particle] & ~SB_BOUNDARY_IMAGE;
}

/* Adds the second layer to a set without images, and numbers its particles. Returns 0, or -1 without memory. */
int sb_boundary_layers(sb_sim *sim, sb_wall_set *set);
/* Allocates the densities of all that are numbered. Returns 0, or -1 without memory. */
int sb_boundary_create(sb_sim *sim);
void sb_boundary_destroy(sb_sim *sim);

/* Stage: rates and loads, from the water's present positions, velocities and densities. */
sb_status sb_stage_boundary(sb_sim *sim, sb_error *error);
/* Densities in the middle of a step of dt, and at its end. */
void sb_boundary_predict(sb_sim *sim, float dt);
void sb_boundary_correct(sb_sim *sim, float dt);

/* Adds the part of the accelerations that is due to the boundary particles' own q: -sum_b psi_b q_b grad W_ib. */
void sb_boundary_accelerate(sb_sim *sim);
/* Stage: the same part of the forces on bodies, into sim->work.stress_force. */
sb_status sb_stage_boundary_forces(sb_sim *sim, sb_error *error);

/* Continues the state hash; unchanged without dynamic boundary particles. */
uint64_t sb_boundary_hash(const sb_sim *sim, uint64_t hash);

#endif
