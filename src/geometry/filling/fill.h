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

/* Fluid particles. Each represents spacing^3 (2D: spacing^2 per metre) of water. Arrays are owned. */
typedef struct sb_fluid {
    size_t count;
    sb_vec3 *position;   /* m */
    sb_vec3 *velocity;   /* m/s */
    double *pressure;    /* Pa, hydrostatic below the local surface */
    double still_depth;  /* m, largest still depth of a column */
    sb_box_share *boxes; /* one for each box of the scene */
    sb_wave_room wave;
} sb_fluid;

/* Fills the scene's sea and boxes. SB_BAD_INPUT gives the place where a sea escapes through an open side, or the
   fault of its seed. The result is the same for any number of threads. On error *fluid is unchanged. */
sb_status sb_fill_water(const sb_scene *scene, const sb_fill_solid *solids, size_t count, sb_fluid *fluid,
                        sb_error *error);
void sb_fluid_free(sb_fluid *fluid);

#endif
