/* The fluid particles in a box at an instant, and their connected groups. Private to src/measure. */
#ifndef SB_MEASURE_CLOUD_H
#define SB_MEASURE_CLOUD_H

#include "sim/sim.h"

#include <stdbool.h>

/* One entry of a list that is sorted by cell. */
typedef struct sb_cloud_slot {
    uint64_t key;
    uint32_t index;
} sb_cloud_slot;

/* A zero-initialised cloud is empty. Its buffers are reused from query to query. */
typedef struct sb_cloud {
    size_t count, capacity;
    sb_fluid_sample *samples;
    size_t slot_capacity, parent_capacity, size_capacity;
    sb_cloud_slot *slots;
    uint32_t *parents;
    double *sizes;
    size_t mark_capacity;
    bool *marks; /* one per sample, valid after sb_cloud_unmark */
} sb_cloud;

void sb_cloud_free(sb_cloud *cloud);
size_t sb_cloud_bytes(const sb_cloud *cloud);

/* Fills the cloud with the particles that were in [min, max] `lag` seconds before the simulation's time. The lag must
   lie within the last step. Positions are moved back along the velocity. This is exact for a particle that the step
   moved by dt times its new velocity. A particle without contact moved by the mean of its old and new velocity; its
   position is wrong by up to g dt lag / 2. */
sb_status sb_cloud_query(sb_cloud *cloud, const sb_sim *sim, sb_vec3 min, sb_vec3 max, double lag, sb_error *error);

/* The same, but appends to the samples that are already there. */
sb_status sb_cloud_add(sb_cloud *cloud, const sb_sim *sim, sb_vec3 min, sb_vec3 max, double lag, sb_error *error);

/* Keeps the group of particles, connected by distances < link (m), with the largest sum of .density, in which the
   caller may have stored weights; this removes spray. The order of the samples is kept. */
sb_status sb_cloud_keep_heaviest(sb_cloud *cloud, double link, sb_error *error);

/* Clears all marks. Marks belong to the samples only as long as the samples keep their order. */
sb_status sb_cloud_unmark(sb_cloud *cloud, sb_error *error);

/* Marks the largest group of samples connected by distances < link (m). */
sb_status sb_cloud_mark_largest(sb_cloud *cloud, double link, sb_error *error);

/* Spreads the marks: each marked sample with at least `least` others nearer than link (m) marks all of these, and so
   on. */
sb_status sb_cloud_spread(sb_cloud *cloud, double link, size_t least, sb_error *error);

#endif
