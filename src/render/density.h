/* How full of water space is, on a grid around a frame's particles: tells inside from surface. */
#ifndef SB_RENDER_DENSITY_H
#define SB_RENDER_DENSITY_H

#include "frame/frame.h"

/* Kept from frame to frame so that its memory is. Zeroed is empty. */
typedef struct sb_density {
    float min[3], cell, inverse; /* m, relative to the frame's origin; 1/m */
    size_t n[3];                 /* nodes */
    size_t capacity[2];
    float *node; /* about 1 inside, 0.5 at the surface, 0 outside */
    float *spare;
} sb_density;

/* Spreads the particles onto nodes 1.5 spacings apart (more for very wide frames) and smooths once.
   Particles beyond 1e4 km or not finite are left out. spacing must be > 0. */
sb_status sb_density_build(sb_density *density, const sb_frame *frame, sb_error *error);
void sb_density_free(sb_density *density);

/* Linear between nodes; 0 outside the grid. */
float sb_density_at(const sb_density *density, float x, float y, float z);

/* False for the particles that are left out. */
static inline bool sb_density_counts(const float *position)
{
    return fabsf(position[0]) < 1e7f && fabsf(position[1]) < 1e7f && fabsf(position[2]) < 1e7f;
}

#endif
