/* Accepted boundary particles with a hash of 4 x 4 x 4 blocks of cells for questions of distance.
 */
#ifndef SB_GEOMETRY_SAMPLE_SET_H
#define SB_GEOMETRY_SAMPLE_SET_H

#include "base/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SB_SAMPLE_BLOCK = 64 };

typedef struct sb_sample {
    sb_vec3 at, normal; /* m; unit, towards the water */
    uint32_t source;
} sb_sample;

/* Zeroed but for cell and origin: an empty set. Owned. */
typedef struct sb_sample_set {
    double cell;    /* m; questions reach no farther than a few cells */
    sb_vec3 origin; /* m */
    size_t count, sample_capacity, next_capacity;
    sb_sample *sample;
    uint32_t *next; /* per sample: index + 1 of the one before it in its cell */
    size_t block_count, block_capacity;
    uint32_t (*block)[SB_SAMPLE_BLOCK]; /* index + 1 of the last sample of each cell */
    size_t table_size;                  /* a power of two */
    uint64_t *key;
    uint32_t *value; /* index + 1 of a block; 0: free */
} sb_sample_set;

void sb_sample_set_free(sb_sample_set *set);

/* 0, or -1 without memory (the set is as it was). */
int sb_sample_set_add(sb_sample_set *set, const sb_sample *sample);

/* Distance to the nearest sample, at most limit; its index in *index (may be NULL) when nearer. */
double sb_sample_set_nearest(const sb_sample_set *set, sb_vec3 at, double limit, size_t *index);

/* Whether any sample is nearer than radius. */
bool sb_sample_set_any(const sb_sample_set *set, sb_vec3 at, double radius);

#endif
