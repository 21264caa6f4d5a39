/* The particles in a box at an instant, and the groups they hang together in. Inside src/measure.
 */
#ifndef SB_MEASURE_CLOUD_H
#define SB_MEASURE_CLOUD_H

#include "sim/sim.h"

#include <stdbool.h>

/* One place of a cell-sorted list. */
typedef struct sb_cloud_slot {
    uint64_t key;
    uint32_t index;
} sb_cloud_slot;

/* Zero-initialised is empty. Buffers are kept from query to query. */
typedef struct sb_cloud {
    size_t count, capacity;
    sb_fluid_sample *samples;
    size_t slot_capacity, parent_capacity, size_capacity;
    sb_cloud_slot *slots;
    uint32_t *parents;
    double *sizes;
    size_t mark_capacity;
    bool *marks; /* of the samples, after sb_cloud_unmark */
} sb_cloud;

void sb_cloud_free(sb_cloud *cloud);
size_t sb_cloud_bytes(const sb_cloud *cloud);

/* Fills the cloud with the particles that were in [min, max] `lag` seconds before the sim's time,
   lag being within the last step: positions move back along the velocity: exactly, for a
   step moves each particle by dt times its new velocity; but one that touched nothing, which moved by the mean of old
   and new, comes out by up to g dt lag / 2 off. */
sb_status sb_cloud_query(sb_cloud *cloud, const sb_sim *sim, sb_vec3 min, sb_vec3 max, double lag, sb_error *error);

/* The same, behind the samples that are there. */
sb_status sb_cloud_add(sb_cloud *cloud, const sb_sim *sim, sb_vec3 min, sb_vec3 max, double lag, sb_error *error);

/* Keeps the largest group of particles connected by distances < link (m): spray goes, water stays.
   Order is kept. */
sb_status sb_cloud_keep_largest(sb_cloud *cloud, double link, sb_error *error);

/* The same for the group with the largest sum of .density, which the caller may have used for weights. */
sb_status sb_cloud_keep_heaviest(sb_cloud *cloud, double link, sb_error *error);

/* Takes all marks away. Marks are the samples' until these change their order. */
sb_status sb_cloud_unmark(sb_cloud *cloud, sb_error *error);

/* Marks the largest group of samples connected by distances < link (m). */
sb_status sb_cloud_mark_largest(sb_cloud *cloud, double link, sb_error *error);

/* Marks spread: from each marked sample that has at least `least` others nearer than link (m) to all of these. */
sb_status sb_cloud_spread(sb_cloud *cloud, double link, size_t least, sb_error *error);

#endif
