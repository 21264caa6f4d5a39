/* The solid bodies as one camera sees them: colour, normal and depth of each pixel. They are drawn again only when the
   view or a body has moved. */
#ifndef SB_RENDER_SCENERY_H
#define SB_RENDER_SCENERY_H

#include "render/bodies/meshes.h"

typedef struct sb_scenery {
    int width, height;
    GLuint color, normal, depth; /* as sb_meshes_draw_faces; depth buffer of 24 bits */
    GLuint framebuffer;
    bool drawn;
    sb_view view;
    size_t body_capacity, body_count;
    sb_vec3 *displacements; /* m, of each body of the frame that was drawn */
    bool read;              /* `values` are those of the depth texture */
    float *values;          /* NULL until they are read */
} sb_scenery;

/* Creates the textures. The context must be current. A zeroed sb_scenery may be destroyed. */
sb_status sb_scenery_create(int width, int height, sb_scenery *scenery, sb_error *error);
void sb_scenery_destroy(sb_scenery *scenery);

/* Draws the bodies unless they look the same as before. */
sb_status sb_scenery_draw(sb_scenery *scenery, const sb_meshes *meshes, const sb_light *light, const sb_view *view,
                          const sb_frame *frame, sb_error *error);

/* The values of the depth texture, rows from the bottom up, valid until the bodies are drawn again; they are read from
   OpenGL once. NULL without memory. */
const float *sb_scenery_depths(sb_scenery *scenery);

#endif
