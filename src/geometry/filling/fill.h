/* Places fluid particles on a lattice of columns: the sea by flood fill, boxes of water, and initial waves. */
#ifndef SB_GEOMETRY_FILL_H
#define SB_GEOMETRY_FILL_H

#include "geometry/solid/solid.h"
#include "scene/scene.h"

/* A body that displaces water. In 2D the solid is that of the section's mesh. */
typedef struct sb_fill_solid {
    const sb_solid *solid;
    const char *name;
} sb_fill_solid;

/* Number of particles that a box has room for, and the number that it received. The difference lies in water that
   comes earlier in the scene. */
typedef struct sb_box_share {
    size_t room, received;
} sb_box_share;

/* The part of an initial solitary wave above the still-water level, and how much of it the water contains. In 2D
   volumes are per metre of width. */
typedef struct sb_wave_room {
    bool wet;         /* the scene has water that the wave can be in */
    double area;      /* m^2, of the whole wave in the plane x-z, up to the domain's top */
    double width;     /* m, largest width of the water across the wave */
    double held;      /* m^3 of the wave that the water contains */
    double low, high; /* m, the water's extent in x */
    double extent;    /* m, distance from the crest beyond which half a per cent of the volume lies */
} sb_wave_room;

/* What places the water of one sea or one box, part by part. */
typedef struct sb_fill_source sb_fill_source;

/* Fluid particles. Each represents spacing^3 (2D: spacing^2 per metre) of water. Arrays are owned. */
typedef struct sb_fluid {
    size_t count;           /* of all particles */
    size_t from, here;      /* the arrays have the particles [from, from + here) */
    sb_vec3 *position;      /* m */
    sb_vec3 *velocity;      /* m/s */
    double *pressure;       /* Pa, hydrostatic below the local surface */
    double still_depth;     /* m, largest still depth of a column */
    sb_fill_source *source; /* owned; NULL: the arrays have all particles */
    sb_box_share *boxes;    /* one for each box of the scene */
    sb_wave_room wave;
} sb_fluid;

/* One of `parts` parts of the water, as large as another one. */
typedef struct sb_fill_share {
    size_t part, parts; /* parts 0 or 1: the whole */
} sb_fill_share;

/* Whether the water of a scene can be placed in parts: it is one sea or one box. */
bool sb_fill_divides(const sb_scene *scene);

/* Fills the scene's sea and boxes, and places a share of the particles if they can be placed in parts, else all.
   The solids outlive fluid->source. SB_BAD_INPUT gives the place where a sea escapes through an open side, or the
   fault of its seed. The result is the same for any number of threads. On error *fluid is unchanged. */
sb_status sb_fill_water(const sb_scene *scene, const sb_fill_solid *solids, size_t count, const sb_fill_share *share,
                        sb_fluid *fluid, sb_error *error);

/* source.c: places the particles [from, from + here) of all, with the bits that they have if all are placed at once.
 *fluid: arrays, from, here, count. */
sb_status sb_fill_place(const sb_fill_source *source, size_t from, size_t here, sb_fluid *fluid, sb_error *error);
void sb_fill_source_destroy(sb_fill_source *source);
void sb_fluid_free(sb_fluid *fluid);

#endif
