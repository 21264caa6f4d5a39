/* The stages of every step. Optional stages are declared in the headers of their subjects. step.c has the order. */
#ifndef SB_SIM_STAGES_H
#define SB_SIM_STAGES_H

#include "sim/sim.h"
#include "sim/state/simd.h"

/* sim/step/time_step.c: sets the report's time step; fails if the run has diverged. */
sb_status sb_stage_time_step(sb_sim *sim, sb_error *error);
/* sim/walls/wall_motion.c: moves the paddles to t, rebuilds their table, and computes their velocities until t + dt. */
sb_status sb_stage_walls(sb_sim *sim, sb_error *error);
/* sim/search/sort_stage.c: wraps or removes particles outside of the domain, sorts the rest along the Z-curve, builds
   the cells. */
sb_status sb_stage_sort(sb_sim *sim, sb_error *error);
/* sim/exchange/exchange.c: makes ghost particles at periodic sides, with positions and velocities. */
sb_status sb_stage_ghosts(sb_sim *sim, sb_error *error);
/* sim/search/neighbours.c: computes lists, densities, wall vectors and the diagonal in one pass. */
sb_status sb_stage_neighbours(sb_sim *sim, sb_error *error);
/* sim/terms/viscosity.c: v* = v + dt (g + viscosity + wall friction). */
sb_status sb_stage_forces(sb_sim *sim, sb_error *error);
/* sim/pressure/pressure.c: source; solve and final acceleration. */
sb_status sb_stage_source(sb_sim *sim, sb_error *error);
sb_status sb_stage_pressure(sb_sim *sim, sb_error *error);
/* sim/step/integrate.c: new velocities, in the field acceleration; positions at t + dt. */
sb_status sb_stage_accelerate(sb_sim *sim, sb_error *error);
sb_status sb_stage_move(sb_sim *sim, sb_error *error);
/* sim/walls/impulse.c: forces of the water on bodies over the step. */
sb_status sb_stage_impulse(sb_sim *sim, sb_error *error);

/* sim/step/integrate.c: fails with a message that has the particle's position and the speed that it would have. */
sb_status sb_sim_diverged(const sb_sim *sim, size_t particle, sb_f4 velocity, sb_error *error);

#endif
