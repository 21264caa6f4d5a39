/* What `check` says of measurements: rates by formula, and warnings of what the run cannot fill. */
#ifndef SB_APP_CHECK_MEASURES_H
#define SB_APP_CHECK_MEASURES_H

#include "app/check/warning_visit.h"
#include "output/log/json.h"
#include "scene/scene.h"

/* Warns of waves and rates that begin after the end of the run, without gauges, or with too few rows per period. */
void sb_measure_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

/* The rates of overtopping by EurOtop at the planes that are compared with it. */
void sb_check_rates_text(const sb_scene *scene);
void sb_check_rates_json(const sb_scene *scene, sb_json *json);

#endif
