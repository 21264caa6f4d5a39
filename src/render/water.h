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
sb_status sb_water_create(int width, int height, GLuint depth_stencil, sb_water *water,
                          sb_error *error);
void sb_water_destroy(sb_water *water);

/* Draws the frame's particles over what is in `target` (with the same depths), lit and hazed. */
sb_status sb_water_draw(sb_water *water, const sb_frame *frame, const sb_light *light,
                        const sb_view *view, double speed_max, GLuint target, sb_error *error);

#endif
