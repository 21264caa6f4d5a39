/* The density of water on a grid around a frame's particles. It shows which particles are at the water's surface. */
#ifndef SB_RENDER_DENSITY_H
#define SB_RENDER_DENSITY_H

#include "frame/frame.h"

/* Where water cannot be: below the heights of the solid bodies as seen from above, and beyond the domain's sides. */
typedef struct sb_ground {
    int side;              /* cells on each side; 0: nothing is known */
    float *height;         /* m above origin, row by row; owned */
    sb_vec3 origin;        /* m, scene */
    double x, y, per_cell; /* m, corner relative to origin; cells per m */
    double floor_level;    /* m, scene: of the domain */
    bool sided;            /* the water ends at the sides; false: they are not known, or water is drawn beyond them */
    double side_min[2], side_max[2]; /* m, scene: the sides in x and in y */
} sb_ground;

/* Kept from frame to frame, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_density {
    float min[3], cell, inverse; /* m, relative to the frame's origin; 1/m */
    size_t n[3];                 /* nodes */
    size_t capacity[3];
    bool slice;                            /* all particles have the same y: a scene of two dimensions */
    bool sided;                            /* continued beyond the sides, which are at: */
    float side_min[2], side_max[2], floor; /* m, relative to the frame's origin */
    float *node;                           /* about 1 inside, 0.5 at the surface, 0 outside */
    float *spare, *open;
} sb_density;

/* Distributes the particles to nodes that are 1.5 particle spacings apart (more for very wide frames) and smooths the
   result once. Particles that are farther away than 1e4 km or not finite are left out. The frame's spacing must be
   above 0. ground may be NULL: with it, the density at a wall, and at a side, is that of
   the water in front of it, so that its gradient is along the wall. The result is the same for any number of threads.
 */
sb_status sb_density_build(sb_density *density, const sb_frame *frame, const sb_ground *ground, int threads,
                           sb_error *error);
void sb_density_free(sb_density *density);

/* Returns the density at a point, linearly interpolated between nodes; 0 outside of the grid. */
float sb_density_at(const sb_density *density, float x, float y, float z);

/* Returns the share of a node, along one axis, of even water that fills the domain between its sides (axis 0 and 1) or
   above its floor (2); 1 if these are not known. */
float sb_density_share(const sb_density *density, int axis, size_t node);

/* Returns the height of the bodies at a place (m, scene), or the floor's where there is none. Places beyond the sides
   have the height just within them. */
double sb_ground_height(const sb_ground *ground, double x, double y);

/* Returns false for the particles that are left out. */
static inline bool sb_density_counts(const float *position)
{
    return fabsf(position[0]) < 1e7f && fabsf(position[1]) < 1e7f && fabsf(position[2]) < 1e7f;
}

#endif
