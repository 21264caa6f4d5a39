/* What `check` says about surface tension. All functions do nothing where it is off. */
#ifndef SB_APP_CHECK_TENSION_H
#define SB_APP_CHECK_TENSION_H

#include "app/check/warning_visit.h"
#include "geometry/model/model.h"
#include "output/log/json.h"

/* Prints the capillary length, and Bond and Weber numbers. */
void sb_check_tension_text(const sb_scene *scene, const sb_model *model);
/* The same as an object "surface_tension". */
void sb_check_tension_json(const sb_scene *scene, const sb_model *model, sb_json *json);
/* Warns of surface tension that acts below the spacing only. */
void sb_tension_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

#endif
