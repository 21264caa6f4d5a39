/* Maps of depth-averaged water as files. */
#ifndef SB_APP_GRID_MAPS_H
#define SB_APP_GRID_MAPS_H

#include "offshore/maps.h"
#include "scene/scene.h"

/* Writes maps/<name>.asc below directory. nested: the scene with particles whose sea the water is, so that the names
   are those of such maps, and times those of the run; NULL: the water is the whole run. */
sb_status sb_grid_maps_write(const char *directory, const sb_offshore *water, const sb_offshore_maps *maps,
                             const sb_scene *nested, sb_error *error);

#endif
