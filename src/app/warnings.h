/* What a scene deserves a word for before it runs, though it can: `check` and `run` both tell. */
#ifndef SB_APP_WARNINGS_H
#define SB_APP_WARNINGS_H

#include "scene/scene.h"

typedef void sb_warning_visit(void *context, const char *text);

/* Each a line without its end. What the meshes and the sampling gave cause for stands in the model's warnings. */
void sb_scene_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

#endif
