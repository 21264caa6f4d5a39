/* Forces on bodies, summed by one thread over groups of particles, independent of the order of groups. */
#ifndef SB_SIM_CPU_BODY_FORCES_H
#define SB_SIM_CPU_BODY_FORCES_H

#include "sim/exchange/sums.h"
#include "sim/search/around.h"

typedef struct sb_body_forces {
    double *sum;    /* of the present group: sum[body][SB_FORCE_VALUES] */
    uint32_t *body; /* those that the group acts on */
    size_t count;   /* of them */
    bool *acted_on; /* per body */
    sb_exact *all;  /* of all groups so far: all[body][SB_FORCE_VALUES] */
} sb_body_forces;

/* Returns 0, or -1 without memory. */
int sb_body_forces_create(sb_body_forces *f, size_t bodies);
void sb_body_forces_free(sb_body_forces *f);

/* Vector from an image of a boundary particle to the original. A force across a periodic side acts on the original. */
sb_vec3 sb_wall_to_original(const sb_space *space, sb_record image);
/* Records a force (N) between particle i and a boundary particle, as in wall_pairs, for probes. */
void sb_wall_push_record(const sb_sim *sim, size_t i, uint32_t wall, sb_vec3 force);

/* Adds a force on a body. pressure, drag: N; at: m, the point of application. */
void sb_body_forces_add(const sb_sim *sim, sb_body_forces *to, uint32_t body, sb_vec3 at, sb_vec3 pressure,
                        sb_vec3 drag);
/* Adds a pressure force (N) on a facet. normal: the facet's, or 0 0 0: that of the force. */
void sb_body_forces_of_facet(const sb_sim *sim, sb_body_forces *to, uint32_t mirror, sb_vec3 at, sb_vec3 force,
                             sb_vec3 normal);
/* Ends a group. */
void sb_body_forces_close(sb_body_forces *f);

#endif
