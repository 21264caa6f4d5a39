/* What `check` prints of terrain grids: what their files state, and what was made of them. */
#ifndef SB_APP_CHECK_TERRAIN_H
#define SB_APP_CHECK_TERRAIN_H

#include "geometry/model/model.h"
#include "output/log/json.h"

/* Print the bodies that are grids. */
void sb_check_terrain_text(const sb_model *model);

/* Print the grids of the depth-averaged model's bed. */
void sb_check_bed_text(const sb_scene *scene, const sb_offshore_told_list *told);
void sb_check_bed_json(const sb_offshore_told_list *told, sb_json *json);

#endif
