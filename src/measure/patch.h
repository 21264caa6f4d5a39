/* The patch of a wall around a pressure probe. Private to src/measure. */
#ifndef SB_MEASURE_PATCH_H
#define SB_MEASURE_PATCH_H

#include "measure/parts.h"

/* Collects the static boundary particles around the probe and decides whether the probe is on the wall (at most half a
   spacing off). If it is, chooses the patch: the part of one smooth surface around the probe. */
sb_status sb_patch_create(const sb_scene *scene, const sb_model *model, const sb_probe *probe, sb_patch **patch,
                          sb_error *error);
void sb_patch_destroy(sb_patch *patch);
size_t sb_patch_bytes(const sb_patch *patch);

bool sb_patch_on_wall(const sb_patch *patch);

/* Point at which it is decided whether the probe is wet: the probe's own position, but at least half a spacing away
   from walls that cross the patch. */
sb_vec3 sb_patch_wetness_point(const sb_patch *patch);

/* Mean pressure over the patch in Pa: the force of the last step on it, by the simulation's own formula, divided by its
   area [A12, eq. 10]. Overwrites the view's cloud. */
sb_status sb_patch_pressure(const sb_patch *patch, const sb_measure_view *view, double *pressure, sb_error *error);

/* Whether the position is in the fluid layer next to the wall. The stress of that layer is larger along the wall than
   across it, and its pressure is some per cent too high. */
bool sb_patch_first_layer(const sb_patch *patch, sb_vec3 position);

#endif
