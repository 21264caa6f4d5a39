/* Water: particles as lit spheres coloured by speed, their depths smoothed into one surface. */
#ifndef SB_RENDER_WATER_H
#define SB_RENDER_WATER_H

#include "render/light.h"
#include "render/visible.h"

typedef struct sb_water {
    int width, height;
    GLuint sphere_program, smooth_program, shade_program;
    GLuint points, buffer, empty;
    GLuint colors;                     /* the colour map as a texture */
    GLuint surface[2], framebuffer[2]; /* eye depth in m (0: no water), share of speed_max,
                                          x and y of the normal along the camera's axes */
    sb_visible visible;
} sb_water;

/* depth_stencil: the renderbuffer shared with the picture's framebuffer, width x height. Needs the
   context. A zeroed one is fine to destroy. */
sb_status sb_water_create(int width, int height, GLuint depth_stencil, sb_water *water, sb_error *error);
void sb_water_destroy(sb_water *water);

/* Lays the visible particles into the shared depths, which are clear, and marks their pixels with
   stencil 1. What is drawn nearer afterwards must set the stencil back to 0. */
sb_status sb_water_lay(sb_water *water, const sb_frame *frame, const sb_view *view, double speed_max, sb_error *error);

/* Paints the marked pixels of `target`, smoothed, lit and hazed; leaves target bound. */
void sb_water_shade(const sb_water *water, const sb_frame *frame, const sb_light *light, const sb_view *view,
                    GLuint target);

#endif
