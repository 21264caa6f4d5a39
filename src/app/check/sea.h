/* Warnings about waves that a sea gives, and about waves of any source that nearly break. */
#ifndef SB_APP_CHECK_SEA_H
#define SB_APP_CHECK_SEA_H

#include "app/check/warning_visit.h"
#include "scene/scene.h"

/* Warns of waves of a theory that come in too late to be seen. */
void sb_sea_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

/* Warns of waves of wave makers, of a sea's theory and of the start that are nearly as high as waves that break, or of
   which the highest ones break. */
void sb_breaking_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

#endif
