/* Warnings about reflections and harmonics that the measurements cannot have. */
#ifndef SB_APP_CHECK_REFLECTIONS_H
#define SB_APP_CHECK_REFLECTIONS_H

#include "app/check/warning_visit.h"
#include "scene/scene.h"

/* Warns of sets of measure.reflections whose gauges, window, period or wavelength do not fit the waves. SB_FAILED
   without memory. */
sb_status sb_reflection_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context, sb_error *error);

/* Warns of harmonics of another period than that of the scene's regular waves, whose they are not. what: the key of the
   period; period: s, 0: none. */
void sb_period_warning(const sb_scene *scene, const char *what, double period, sb_warning_visit *visit, void *context);

#endif
