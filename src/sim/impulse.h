/* Sums of forces on bodies, shared by the water that moves and the water asleep. */
#ifndef SB_SIM_IMPULSE_H
#define SB_SIM_IMPULSE_H

#include "sim/state.h"

enum { SB_IMPULSE_VALUES = 9 }; /* pressure and friction, N, and moment, N m: three components each */

/* Adds what the pressure of particle i does to bodies, by the lists and pressures of the last step (M17);
   sum: SB_IMPULSE_VALUES per body. */
void sb_impulse_of_pressure(const sb_sim *sim, size_t i, double *sum);
/* Adds a push (N) of particle i on what it touches, as in wall_pairs. */
void sb_impulse_of_push(const sb_sim *sim, size_t i, uint32_t wall, sb_vec3 push, double *sum);

/* Adds a force's values over dt (s) to a body's impulse. */
void sb_impulse_add(sb_body_impulse *total, double dt, const double *values);

#endif
