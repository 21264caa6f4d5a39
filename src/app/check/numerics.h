/* Warnings about numerical parameters. */
#ifndef SB_APP_CHECK_NUMERICS_H
#define SB_APP_CHECK_NUMERICS_H

#include "app/check/warning_visit.h"
#include "scene/scene.h"

/* Warns of values that differ from those of the preset although the run does not use them. */
void sb_numerics_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

#endif
