/* Draws the water: particles as lit spheres coloured by speed, whose depths are smoothed into a surface. */
#ifndef SB_RENDER_WATER_H
#define SB_RENDER_WATER_H

#include "render/light.h"
#include "render/visible.h"

typedef struct sb_water {
    int width, height;
    GLuint sphere_program, smooth_program, shade_program;
    GLuint points, buffer, empty;
    GLuint colors;                     /* the colour map as a texture */
    GLuint surface[2], framebuffer[2]; /* depth in m along the view (0: no water), fraction of speed_max,
                                          x and y of the normal along the camera's axes */
    sb_visible visible;
} sb_water;

/* Creates the programs and buffers. depth_stencil: the renderbuffer that is shared with the picture's framebuffer,
   width x height. The context must be current. A zeroed sb_water may be destroyed. */
sb_status sb_water_create(int width, int height, GLuint depth_stencil, sb_water *water, sb_error *error);
void sb_water_destroy(sb_water *water);

/* Draws the visible particles into the shared depth buffer, which must be clear, and marks their pixels with stencil 1.
   Nearer objects that are drawn afterwards must reset the stencil to 0. */
sb_status sb_water_draw_depth(sb_water *water, const sb_frame *frame, const sb_view *view, double speed_max,
                              sb_error *error);

/* Draws the marked pixels of `target`: the smoothed surface with light and haze. target stays bound. */
void sb_water_shade(const sb_water *water, const sb_frame *frame, const sb_light *light, const sb_view *view,
                    GLuint target);

#endif
