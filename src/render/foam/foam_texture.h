/* The foam of one picture as a texture, which sb_compose_draw joins with the water. */
#ifndef SB_RENDER_FOAM_TEXTURE_H
#define SB_RENDER_FOAM_TEXTURE_H

#include "render/bodies/scenery.h"
#include "render/foam/foam.h"
#include "render/water/water.h"

typedef struct sb_foam_texture {
    GLuint texture; /* as sb_foam_layer.pixels; 0: no picture has had foam yet */
    bool drawn;     /* the picture drawn last has foam */
    size_t surface_capacity;
    float *surface; /* read back from OpenGL */
    sb_foam_layer layer;
} sb_foam_texture;

/* Draws the foam of a frame whose bodies and water have been drawn. The context must be current. A zeroed struct is
   empty. A frame without foam costs nothing. */
sb_status sb_foam_texture_draw(sb_foam_texture *foam, const sb_frame *frame, sb_scenery *scenery, const sb_water *water,
                               const sb_view *view, sb_error *error);
void sb_foam_texture_destroy(sb_foam_texture *foam);

#endif
