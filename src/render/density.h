/* The density of water on a grid around a frame's particles. It shows which particles are at the water's surface. */
#ifndef SB_RENDER_DENSITY_H
#define SB_RENDER_DENSITY_H

#include "frame/frame.h"

/* Kept from frame to frame, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_density {
    float min[3], cell, inverse; /* m, relative to the frame's origin; 1/m */
    size_t n[3];                 /* nodes */
    size_t capacity[2];
    float *node; /* about 1 inside, 0.5 at the surface, 0 outside */
    float *spare;
} sb_density;

/* Distributes the particles to nodes that are 1.5 particle spacings apart (more for very wide frames) and smooths the
   result once. Particles that are farther away than 1e4 km or not finite are left out. The frame's spacing must be
   above 0. */
sb_status sb_density_build(sb_density *density, const sb_frame *frame, sb_error *error);
void sb_density_free(sb_density *density);

/* Returns the density at a point, linearly interpolated between nodes; 0 outside of the grid. */
float sb_density_at(const sb_density *density, float x, float y, float z);

/* Returns false for the particles that are left out. */
static inline bool sb_density_counts(const float *position)
{
    return fabsf(position[0]) < 1e7f && fabsf(position[1]) < 1e7f && fabsf(position[2]) < 1e7f;
}

#endif
