/* The last word of a wall: no particle comes nearer to its sheet than some half a spacing.
   Pressure holds water off where there is enough of it; a lone drop or a thin film is too light to build up
   density before it has passed, and would leak. */
#ifndef SB_SIM_CONTACT_H
#define SB_SIM_CONTACT_H

#include "sim/state.h"

enum { SB_CONTACT_PUSHES_MAX = 3 }; /* a corner of three walls asks for one each */

/* One push: the boundary particle that feels it (as in wall_pairs), and by how much it changed the velocity, m/s. */
typedef struct sb_contact_push {
    uint32_t wall;
    sb_f4 change;
} sb_contact_push;

/* Mends the velocity (m/s) that particle i is about to move with: its component towards a wall, relative to
   the wall, is cut so that the step ends there (inelastic; along the wall nothing
   changes). Returns how many pushes that took, one after the other, each felt by the wall nearest then; 0: nothing was
   mended. Where two walls meet, a push is along the mean of their normals and still felt by one alone: parted among
   them it would do other work than they do. */
size_t sb_contact_resolve(const sb_sim *sim, size_t i, sb_f4 *velocity, sb_contact_push touched[SB_CONTACT_PUSHES_MAX]);

#endif
