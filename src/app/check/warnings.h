/* Warnings about a scene that can run but is probably not what the user meant. `check` and `run` both print them. */
#ifndef SB_APP_WARNINGS_H
#define SB_APP_WARNINGS_H

#include "app/check/warning_visit.h"
#include "geometry/model/model.h"

/* Calls visit for each warning. Warnings about meshes and sampling are in the model.
   SB_FAILED without memory for one of them. */
sb_status sb_scene_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context, sb_error *error);

/* The same for what follows from the model: what sponges reflect, and walls that reflect water and have more facets
   than the simulation can handle. SB_FAILED without memory. */
sb_status sb_model_warnings(const sb_scene *scene, const sb_model *model, sb_warning_visit *visit, void *context,
                            sb_error *error);

#endif
