/* Surface elements of the water: the visible particles, moved to the smooth surface of the water's density. */
#ifndef SB_RENDER_SURFELS_H
#define SB_RENDER_SURFELS_H

#include "frame/frame.h"
#include "render/camera/camera.h"
#include "render/water/density.h"

/* Lengths are in m along the camera's axes: right, up, forward. */
typedef struct sb_surfel {
    float place[3], normal[3]; /* relative to the eye; unit, towards the eye */
    float value;               /* 0..1 of the colour map */
    float thickness;           /* water behind it along the ray, at most SB_SURFEL_THICKEST spacings */
    float radius;              /* m, of its disc: smaller where there are few particles */
    float share;               /* 1: part of a surface, 0: a single drop */
} sb_surfel;

enum { SB_SURFEL_THICKEST = 6 };

/* Kept from frame to frame, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_surfels {
    size_t count, capacity, chosen_capacity, block_capacity;
    sb_surfel *list; /* in the order of the particles */
    uint32_t *chosen;
    size_t *blocks;
    sb_density density;
} sb_surfels;

/* Collects the surface elements of the particles that have no water between them and the eye. values: of each particle,
   0..1. ground: as in
   sb_density_build. The result is the same for any number of threads. The frame's spacing must be above 0. */
sb_status sb_surfels_collect(sb_surfels *surfels, const sb_frame *frame, const float *values, const sb_ground *ground,
                             const sb_view *view, int threads, sb_error *error);
void sb_surfels_free(sb_surfels *surfels);

#endif
