/* Records the forces of the water on walls near given places, for probes. Output only: nothing of the simulation reads
   them. */
#ifndef SB_SIM_PUSHES_H
#define SB_SIM_PUSHES_H

#include "sim/simulation.h"

typedef struct sb_pushes {
    size_t place_count;
    sb_push_place *places;
    bool *wanted;   /* per body: there is a place on it, */
    bool *whole;    /* and one that is everywhere */
    sb_vec3 period; /* m; 0: the domain does not repeat */
    size_t count, capacity;
    sb_wall_push *list; /* of the last step, in an order that depends on timing */
    bool failed;        /* no memory */
} sb_pushes;

/* Whether forces on particles of the group can be near a place. */
bool sb_pushes_near(const sb_sim *sim, const sb_group *group);
/* Adds a force on a body if it is near a place. Any thread may call it. */
void sb_pushes_add(sb_pushes *pushes, const sb_wall_push *push);
/* Forgets the pushes of the last step. */
void sb_pushes_clear(sb_pushes *pushes);
/* Adds those of the other domains. Returns 0, or -1 if memory ran out in any domain. */
int sb_pushes_share(sb_sim *sim);
void sb_pushes_destroy(sb_pushes *pushes);

#endif
