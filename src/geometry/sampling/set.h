/* The set of accepted boundary particles, with a hash of 4 x 4 x 4 blocks of cells for distance queries. */
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
    uint32_t slab; /* of the sampling that placed it */
} sb_sample;

/* A set. Zeroed except for cell and origin it is empty. Arrays are owned. */
typedef struct sb_sample_set {
    double cell;    /* m; the radius of a query should be a few cells at most */
    sb_vec3 origin; /* m */
    size_t count, sample_capacity, next_capacity;
    sb_sample *sample;
    uint32_t *next; /* per sample: index + 1 of the previous one in its cell */
    size_t block_count, block_capacity;
    uint32_t (*block)[SB_SAMPLE_BLOCK]; /* index + 1 of the last sample of each cell */
    size_t table_size;                  /* a power of two */
    uint64_t *key;
    uint32_t *value; /* index + 1 of a block; 0: free */
} sb_sample_set;

void sb_sample_set_free(sb_sample_set *set);

/* Removes the samples of the slabs before `slab`; the others keep their order. Returns 0, or -1 without memory (the set
   is then unchanged). */
int sb_sample_set_keep(sb_sample_set *set, uint32_t slab);

/* Adds a sample. Returns 0, or -1 without memory (the set is then unchanged). */
int sb_sample_set_add(sb_sample_set *set, const sb_sample *sample);

/* Returns the distance to the nearest sample, at most limit; its index in *index (may be NULL) if nearer. */
double sb_sample_set_nearest(const sb_sample_set *set, sb_vec3 at, double limit, size_t *index);

/* Whether any sample is nearer than radius. */
bool sb_sample_set_any(const sb_sample_set *set, sb_vec3 at, double radius);

#endif
