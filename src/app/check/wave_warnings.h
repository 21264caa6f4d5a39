/* Warns of waves to order that do not come to the place where they are wanted, or are never made, for `check` and
   `run`. */
#ifndef SB_APP_WAVE_WARNINGS_H
#define SB_APP_WAVE_WARNINGS_H

#include "app/check/warning_visit.h"
#include "scene/scene.h"

/* Visits the warnings of the scene's wave makers. Fails only without memory. */
sb_status sb_wave_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context, sb_error *error);

#endif
