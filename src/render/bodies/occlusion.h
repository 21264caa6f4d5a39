/* Ambient occlusion: the fraction of the sky that near surfaces in the picture leave to each pixel. */
#ifndef SB_RENDER_OCCLUSION_H
#define SB_RENDER_OCCLUSION_H

#include "render/bodies/scenery.h"
#include "render/water/water.h"

typedef struct sb_occlusion {
    int width, height; /* px, half of the picture's */
    GLuint program, blur_program, empty;
    GLuint texture[2], framebuffer[2]; /* fraction, depth in m; the first is the result */
} sb_occlusion;

/* width, height: of the picture. The context must be current. A zeroed sb_occlusion may be destroyed. */
sb_status sb_occlusion_create(int width, int height, sb_occlusion *occlusion, sb_error *error);
void sb_occlusion_destroy(sb_occlusion *occlusion);

/* Draws the result from the bodies and the water. radius: m, up to which surfaces hide the sky. */
void sb_occlusion_draw(const sb_occlusion *occlusion, const sb_scenery *scenery, const sb_water *water,
                       const sb_view *view, double radius);

#endif
