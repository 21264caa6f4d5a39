/* Contact resolution: limits the velocity of a particle so that it does not pass a wall within the step
   (docs/method.md, section 7). Where there is enough water, pressure keeps it away from walls. A single drop or a film
   of one layer has too little mass to build up density before it passes the wall, and would leak. */
#ifndef SB_SIM_CONTACT_H
#define SB_SIM_CONTACT_H

#include "sim/simulation.h"

enum { SB_CONTACT_PUSHES_MAX = 3 }; /* a corner of three walls needs one for each wall */

/* A contact of a particle with a facet. */
typedef struct sb_facet_contact {
    sb_f4 normal;    /* unit; last lane 0 */
    float push;      /* quanta, along the normal */
    uint32_t mirror; /* index into walls.mirrors.mirror */
} sb_facet_contact;

/* Whether there can be a facet near particle i of a group. */
bool sb_contact_possible(const sb_sim *sim, const sb_group *group, size_t i);

/* Finds a facet that particle i would come too near to, or pass, in this step with this velocity. Where it would pass
   several, the one that takes the least push: of two facets at a convex edge one push is enough, and at a concave one
   the next call finds the other. Returns false if there is none. */
bool sb_contact_find(const sb_sim *sim, const sb_group *group, size_t i, sb_f4 velocity, sb_facet_contact *contact);

#endif
