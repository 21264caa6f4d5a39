/* The stages that every step has; those that a scene may leave out stand in the headers of what they are for.
   step.c has their order. */
#ifndef SB_SIM_STAGES_H
#define SB_SIM_STAGES_H

#include "sim/sim.h"
#include "sim/simd.h"

/* sim/time_step.c: the report's time step; fails when the run has diverged. */
sb_status sb_stage_time_step(sb_sim *sim, sb_error *error);
/* sim/walls.c: paddles to t, their table, their velocity to t + dt. */
sb_status sb_stage_walls(sb_sim *sim, sb_error *error);
/* sim/sort_stage.c: wraps or drops particles outside, sorts the rest along the Z-curve, builds the cells. */
sb_status sb_stage_sort(sb_sim *sim, sb_error *error);
/* sim/ghosts.c: images of what is near periodic sides, their places and velocities as after the sort. */
sb_status sb_stage_ghosts(sb_sim *sim, sb_error *error);
/* sim/neighbours.c: lists, densities, wall vectors, diagonal, all in one pass; and for the stage completion, in the
   place of source and residual, the walls' part of the densities and |sum_j m grad W_ij|^2. */
sb_status sb_stage_neighbours(sb_sim *sim, sb_error *error);
/* sim/viscosity.c: v* = v + dt (g + viscosity + wall friction). */
sb_status sb_stage_forces(sb_sim *sim, sb_error *error);
/* sim/pressure.c: source, solve, final acceleration. */
sb_status sb_stage_source(sb_sim *sim, sb_error *error);
sb_status sb_stage_pressure(sb_sim *sim, sb_error *error);
/* sim/integrate.c: new velocities, in the field acceleration; places at t + dt. */
sb_status sb_stage_accelerate(sb_sim *sim, sb_error *error);
sb_status sb_stage_move(sb_sim *sim, sb_error *error);
/* sim/impulse.c: forces of the water on bodies over the step. */
sb_status sb_stage_impulse(sb_sim *sim, sb_error *error);

/* sim/integrate.c: fails with where the particle is and the velocity that it would reach. */
sb_status sb_sim_diverged(const sb_sim *sim, size_t particle, sb_f4 velocity, sb_error *error);

#endif
