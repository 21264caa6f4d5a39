/* The background of a picture: a clear sky above a hazy horizon. */
#ifndef SB_RENDER_SKY_H
#define SB_RENDER_SKY_H

#include "render/light.h"

typedef struct sb_sky {
    GLuint program, empty;
} sb_sky;

sb_status sb_sky_create(sb_sky *sky, sb_error *error);
void sb_sky_destroy(sb_sky *sky);

/* Fills all pixels whose depth is still that of the far plane. */
void sb_sky_draw(const sb_sky *sky, const sb_light *light, const sb_view *view);

/* Sets the uniforms from which passes over the whole picture compute the ray of a pixel: right, up, back (the camera's
   axes) and lens (half the picture's width and height at depth 1). */
void sb_sky_bind_rays(const sb_view *view, GLuint program);

#endif
