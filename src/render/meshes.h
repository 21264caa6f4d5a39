/* The solid bodies of a scene as triangles and lines ready to draw. */
#ifndef SB_RENDER_MESHES_H
#define SB_RENDER_MESHES_H

#include "frame/frame.h"
#include "geometry/model.h"
#include "render/camera.h"
#include "render/light.h"
#include "render/program.h"

typedef struct sb_meshes sb_meshes;

/* Uploads every body that has triangles; their vertices become single precision relative to
   `origin` (m, scene). Needs the context. The model is not needed afterwards. */
sb_status sb_meshes_create(const sb_model *model, sb_vec3 origin, sb_meshes **meshes, sb_error *error);
void sb_meshes_destroy(sb_meshes *meshes);

/* Only the depth of the closed bodies and terrain that never move, under the given clip matrix. */
void sb_meshes_draw_depth(const sb_meshes *meshes, const float clip[16]);

/* Lit faces, moving bodies displaced as the frame says (matched by order, else by name). */
void sb_meshes_draw_faces(const sb_meshes *meshes, const sb_light *light, const sb_view *view, const sb_frame *frame);

/* Feature edges as thin dark lines over what lies at their depth. */
void sb_meshes_draw_edges(const sb_meshes *meshes, const sb_view *view, const sb_frame *frame);

#endif
