/* Contact resolution: limits the velocity of a particle so that it does not pass a wall within the step
   (docs/method.md, section 7). Where there is enough water, pressure keeps it away from walls. A single drop or a film
   of one layer has too little mass to build up density before it passes the boundary surface, and would leak. */
#ifndef SB_SIM_CONTACT_H
#define SB_SIM_CONTACT_H

#include "sim/simulation.h"

enum { SB_CONTACT_PUSHES_MAX = 3 }; /* a corner of three walls needs one for each wall */

/* One push: the boundary particle that receives the reaction (as in wall_pairs), and the change of velocity, m/s. */
typedef struct sb_contact_push {
    uint32_t wall;
    sb_f4 change;
} sb_contact_push;

/* Limits the velocity (m/s) with which particle i will move: the component towards a wall, relative to the wall, is
   reduced so that the step ends at the permitted distance (inelastic). The tangential component does not change.
   Returns the number of pushes, which are applied one after the other; 0: the velocity is unchanged. The wall that is
   nearest at the time receives the reaction. Where two walls meet, a push is along the mean of their normals, but only
   one wall receives the reaction: dividing it between moving and static walls would change the work that they do. */
size_t sb_contact_resolve(const sb_sim *sim, size_t i, sb_f4 *velocity, sb_contact_push pushes[SB_CONTACT_PUSHES_MAX]);

#endif
