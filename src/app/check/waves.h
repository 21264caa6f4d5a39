/* What the wave makers of a scene make, and what its sponges leave, for `check`. */
#ifndef SB_APP_CHECK_WAVES_H
#define SB_APP_CHECK_WAVES_H

#include "geometry/model/model.h"
#include "output/log/json.h"
#include "scene/scene.h"

/* Prints the solitary waves and the wave trains, with wavelength, kd, Ursell number, steepness, particles per height
   and length, travel; and the reflection that is predicted for each sponge. */
void sb_check_waves_text(const sb_scene *scene, const sb_model *model);
/* The same as lists "solitary_waves", "waves" and "sponges" of the open object; none where there is no item. */
void sb_check_waves_json(const sb_scene *scene, const sb_model *model, sb_json *json);

#endif
