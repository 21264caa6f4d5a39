/* The wall around a pressure probe. Inside src/measure. */
#ifndef SB_MEASURE_PATCH_H
#define SB_MEASURE_PATCH_H

#include "measure/parts.h"

/* Collects the static boundary particles around the probe; finds whether it sits on the wall (at
   most half a spacing off) and, if so, the patch of one smooth surface that it stands for. */
sb_status sb_patch_create(const sb_scene *scene, const sb_model *model, const sb_probe *probe, sb_patch **patch,
                          sb_error *error);
void sb_patch_destroy(sb_patch *patch);
size_t sb_patch_bytes(const sb_patch *patch);

bool sb_patch_on_wall(const sb_patch *patch);

/* Where water shows whether the probe is wet: the probe, but half a spacing out of the walls that the patch runs into.
 */
sb_vec3 sb_patch_outlook(const sb_patch *patch);

/* Mean pressure over the patch: the force of the last step on it, by the formula of the simulation,
   over its area [A12, eq. 10]. In Pa; uses the sight's cloud. */
sb_status sb_patch_pressure(const sb_patch *patch, const sb_sight *sight, double *pressure, sb_error *error);

/* Is this the layer of fluid next to the wall? It presses along the wall more than across it, and its pressure is
   some per cent too high. */
bool sb_patch_first_layer(const sb_patch *patch, sb_vec3 position);

#endif
