/* The box that pictures show. */
#ifndef SB_RENDER_BOUNDS_H
#define SB_RENDER_BOUNDS_H

#include "geometry/model/model.h"
#include "scene/scene.h"

/* Finds the box (m, scene) around the domain, the meshes of all bodies, and the water of a grid that frames contain. */
void sb_bounds_find(const sb_scene *scene, const sb_model *model, sb_vec3 *min, sb_vec3 *max);

#endif
