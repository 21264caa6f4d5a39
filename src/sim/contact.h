/* The last word of a wall: no particle comes nearer to its sheet than some half a spacing.
   Pressure holds water off where there is enough of it; a lone drop or a thin film is too light to build up
   density before it has passed, and would leak. */
#ifndef SB_SIM_CONTACT_H
#define SB_SIM_CONTACT_H

#include "sim/state.h"

/* Mends the velocity (m/s) that particle i is about to move with: its component towards a wall, relative to
   the wall, is cut so that the step ends there (inelastic; along the wall nothing
   changes). Returns whether it did, with the boundary particle that felt it (as in wall_pairs). */
bool sb_contact_mend(const sb_sim *sim, size_t i, sb_f4 *velocity, uint32_t *touched);

#endif
