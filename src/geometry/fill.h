/* Water as particles on a lattice of columns: the sea by flood fill, boxes of water, initial waves.
 */
#ifndef SB_GEOMETRY_FILL_H
#define SB_GEOMETRY_FILL_H

#include "geometry/solid.h"
#include "scene/scene.h"

/* A body that water cannot be in; in 2D of the section's mesh. */
typedef struct sb_fill_solid {
    const sb_solid *solid;
    const char *name;
} sb_fill_solid;

/* Particles that a box of water has room for, and those that it got: what a water before it holds is not its. */
typedef struct sb_box_share {
    size_t room, got;
} sb_box_share;

/* Of an initial solitary wave, what is above the still-water level, and the room that the water has for it. In 2D per
   metre of width. */
typedef struct sb_wave_room {
    bool wet;         /* there is water for it at all */
    double area;      /* m^2, of the whole wave in the plane x-z, as far up as the domain's top */
    double width;     /* m, of the water across the wave, where that is widest */
    double held;      /* m^3 of the wave that the water has */
    double low, high; /* m, the water's extent in x */
    double reach;     /* m, from the crest to where half a per cent of the volume is left */
} sb_wave_room;

/* Each particle stands for spacing^3 (2D: spacing^2 per metre) of water. Owned. */
typedef struct sb_fluid {
    size_t count;
    sb_vec3 *position;   /* m */
    sb_vec3 *velocity;   /* m/s */
    double *pressure;    /* Pa, hydrostatic below the local surface */
    double still_depth;  /* m, largest still depth of a column */
    sb_box_share *boxes; /* of each of the scene's boxes */
    sb_wave_room wave;
} sb_fluid;

/* Fills the scene's sea and boxes. SB_BAD_INPUT names the place where a sea escapes, or what is
   wrong with its seed. Same result for any number of threads; on error *fluid is untouched. */
sb_status sb_fill_water(const sb_scene *scene, const sb_fill_solid *solids, size_t count, sb_fluid *fluid,
                        sb_error *error);
void sb_fluid_free(sb_fluid *fluid);

#endif
