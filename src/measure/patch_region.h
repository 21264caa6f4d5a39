/* The weights of a patch on a face of any shape: see patch.c. Private to src/measure. */
#ifndef SB_MEASURE_PATCH_REGION_H
#define SB_MEASURE_PATCH_REGION_H

#include "base/status.h"
#include "base/vec.h"

#include <stdbool.h>
#include <stddef.h>

/* Half the width of the square in which the face's shape is known, in radii; beyond it the face counts as endless. */
#define SB_PATCH_REGION 2.5

/* A square lattice in the plane of the disk, in 2D a line. */
typedef struct sb_patch_region {
    int half, rows; /* points at i = -half..half along u, j = -rows..rows along v */
    double cell;    /* m */
    double radius;  /* m */
    sb_vec3 center, u, v;
    double off;       /* m, from the center to the face; INFINITY: the face is not in the square */
    double *share;    /* per point: part of its cell that is on the face */
    double *norm;     /* a at each point */
    double at_center; /* a(c) */
} sb_patch_region;

/* Whether a point of the disk's plane is on the face. */
typedef bool sb_on_face(const void *context, sb_vec3 at);

sb_status sb_patch_region_make(sb_patch_region *region, sb_vec3 center, sb_vec3 normal, double radius, bool flat,
                               sb_on_face *on_face, const void *context, sb_error *error);
size_t sb_patch_region_bytes(const sb_patch_region *region);
void sb_patch_region_free(sb_patch_region *region);

/* Returns the weight W of a point in the plane, 1/m^2 (1/m in 2D). A point beside the face has that of the nearest
   point on it. */
double sb_patch_region_weight(const sb_patch_region *region, sb_vec3 at);

#endif
