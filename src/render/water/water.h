/* Draws the water of one picture, either as a smooth surface or as lit spheres, into textures that sb_compose_draw
   joins with the bodies. */
#ifndef SB_RENDER_WATER_H
#define SB_RENDER_WATER_H

#include "render/bodies/light.h"
#include "render/water/sides.h"
#include "render/water/splat.h"
#include "render/water/tops.h"
#include "render/water/visible.h"
#include "scene/scene.h"

typedef struct sb_water {
    int width, height;
    GLuint sphere_program, points, buffer;
    GLuint surface, cover;     /* as in sb_splat */
    GLuint framebuffer, depth; /* of spheres: draws to surface */
    bool solid;                /* cover is not used: the surface covers every pixel that has a depth */
    sb_visible visible;
    sb_surfels surfels;
    sb_splat splat;
    sb_sides sides;
    sb_density *density; /* of the picture drawn last */
} sb_water;

/* Creates the programs and buffers. The context must be current. A zeroed sb_water may be destroyed. */
sb_status sb_water_create(int width, int height, sb_water *water, sb_error *error);
void sb_water_destroy(sb_water *water);

/* Draws the frame's particles. values: of each particle, 0..1. ground: as in sb_density_build. */
sb_status sb_water_draw(sb_water *water, const sb_frame *frame, const float *values, const sb_ground *ground,
                        const sb_view *view, sb_water_style style, sb_error *error);

#endif
