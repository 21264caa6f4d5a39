/* Warnings about measurements that the run cannot fill. */
#ifndef SB_APP_CHECK_MEASURES_H
#define SB_APP_CHECK_MEASURES_H

#include "app/warning_visit.h"
#include "scene/scene.h"

/* Warns of waves and rates that begin after the end of the run, without gauges, or with too few rows per period. */
void sb_measure_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

#endif
