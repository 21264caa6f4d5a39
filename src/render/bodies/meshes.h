/* Draws the solid bodies of a scene as triangles and lines. */
#ifndef SB_RENDER_MESHES_H
#define SB_RENDER_MESHES_H

#include "frame/frame.h"
#include "geometry/model/model.h"
#include "render/bodies/light.h"
#include "render/camera/camera.h"
#include "render/gl/program.h"

typedef struct sb_meshes sb_meshes;

/* Uploads every body that has triangles. The vertices are stored in single precision relative to `origin` (m, scene).
   The context must be current. The model is not used afterwards. */
sb_status sb_meshes_create(const sb_model *model, sb_vec3 origin, sb_meshes **meshes, sb_error *error);
void sb_meshes_destroy(sb_meshes *meshes);

/* Writes the colour of a body's corners: the square root of the linear colour, and 255 for the colours of terrain. */
void sb_meshes_paint(const sb_model_body *body, unsigned char paint[4]);

/* Replaces the colours of all corners, 4 bytes each: three per triangle, in the order of the model's bodies and their
 * triangles. */
void sb_meshes_recolor(sb_meshes *meshes, const unsigned char *colors, size_t corners);

/* Draws only the depth of the closed bodies and of the terrain that never move, with the given clip matrix. */
void sb_meshes_draw_depth(const sb_meshes *meshes, const float clip[16]);

/* Kinds of bodies in the alpha channel of the faces' colours; 0: no body. */
#define SB_MESHES_MOVING 0.35
#define SB_MESHES_BODY 0.5
#define SB_MESHES_TERRAIN 1.0

/* Draws the faces' colours (square root of the linear colour, kind) and normals (scene axes, towards the eye) to two
   targets. Moving bodies are displaced by the frame's displacements (matched by index, else by name). */
void sb_meshes_draw_faces(const sb_meshes *meshes, const sb_light *light, const sb_view *view, const sb_frame *frame);

/* The water that may hide edges. */
typedef struct sb_edge_water {
    GLuint surface, cover; /* textures, as in sb_splat */
    bool solid;            /* the surface covers every pixel that has a depth */
} sb_edge_water;

/* Draws the feature edges as thin dark lines. They are hidden by the bound framebuffer's depths, which are those of the
   bodies, and by the water. */
void sb_meshes_draw_edges(const sb_meshes *meshes, const sb_view *view, const sb_frame *frame,
                          const sb_edge_water *water);

#endif
