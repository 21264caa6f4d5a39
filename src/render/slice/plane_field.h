/* Velocity, a field and the density of the water at the nodes of a grid on a plane. */
#ifndef SB_RENDER_PLANE_FIELD_H
#define SB_RENDER_PLANE_FIELD_H

#include "frame/frame.h"
#include "render/slice/plane.h"
#include "render/water/density.h"

/* What is known of the water at a place of the plane. */
typedef struct sb_plane_sample {
    float velocity[2]; /* m/s along the plane's axes; NaN: there is no water near */
    float value;       /* 0..1 of the colour map */
    float density;     /* as sb_density_at; it continues into solid bodies */
    float solid;       /* 0..1: how much of the surroundings is in solid bodies */
} sb_plane_sample;

/* Whether there is water. */
static inline bool sb_plane_wet(const sb_plane_sample *sample)
{
    return sample->density >= 0.5f && sample->solid < 0.5f;
}

/* Kept from picture to picture, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_plane_field {
    size_t n[2];
    double low[2], cell; /* m, the first node; distance between nodes */
    sb_plane_sample *node;
    size_t node_capacity, near_capacity, first_capacity, solid_capacity;
    struct sb_plane_particle *near;
    size_t *first;
    float
        *solid; /* per node, zero after the grid is laid: share of the cell around it that is solid, set by the owner */
} sb_plane_field;

/* Lays a grid over [low, high] (m) with half a spacing between nodes, or more if there were more than four million. */
sb_status sb_plane_field_lay(sb_plane_field *field, const double low[2], const double high[2], double spacing,
                             sb_error *error);

/* Interpolates the particles within two spacings to the nodes: a linear field is fitted by weighted least squares;
   where particles are few, their weighted mean (Shepard) is used instead. A linear field is exact within the water.
   values: of each particle, 0..1. The result is the same for any number of threads. */
sb_status sb_plane_field_fill(sb_plane_field *field, const sb_plane *plane, const sb_frame *frame, const float *values,
                              const sb_density *density, int threads, sb_error *error);

/* Interpolates between the nodes. Outside of the grid, the density is 0. */
sb_plane_sample sb_plane_field_at(const sb_plane_field *field, double a, double b);

void sb_plane_field_free(sb_plane_field *field);

#endif
