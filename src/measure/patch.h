/* The patch of a wall around a pressure probe. Private to src/measure. */
#ifndef SB_MEASURE_PATCH_H
#define SB_MEASURE_PATCH_H

#include "measure/parts.h"

/* Collects the static boundary particles around the probe and decides whether the probe is on the wall (at most half a
   spacing off). If it is, chooses the patch: the part of one smooth surface around the probe. */
sb_status sb_patch_create(const sb_scene *scene, const sb_model *model, const sb_probe *probe, sb_patch **patch,
                          sb_error *error);
/* The distance from the probe at which boundary particles count, m. */
double sb_patch_range(const sb_scene *scene, const sb_probe *probe);
void sb_patch_destroy(sb_patch *patch);
size_t sb_patch_bytes(const sb_patch *patch);

bool sb_patch_on_wall(const sb_patch *patch);

/* Point at which it is decided whether the probe is wet: the probe's own position, but at least half a spacing away
   from walls that cross the patch. */
sb_vec3 sb_patch_wetness_point(const sb_patch *patch);

/* Where the simulation must record forces for the patch. Returns their number; 0: the probe is not on a wall. */
enum { SB_PATCH_PLACES = 4 };
size_t sb_patch_places(const sb_patch *patch, sb_push_place places[SB_PATCH_PLACES]);

/* What a force adds to the pressure on the patch, Pa. */
double sb_patch_share(const sb_patch *patch, const sb_wall_push *push);

/* Whether the position is in the fluid layer next to the wall. The stress of that layer is larger along the wall than
   across it, and its pressure is some per cent too high. */
bool sb_patch_first_layer(const sb_patch *patch, sb_vec3 position);

#endif
