/* The grid of a scene's depth-averaged model at t = 0: bed, uplift, and water. */
#ifndef SB_GEOMETRY_GRID_START_H
#define SB_GEOMETRY_GRID_START_H

#include "offshore/start.h"

/* Fills an empty start; free it with sb_offshore_start_free. SB_BAD_INPUT as sb_bed_fill, and when there is no water;
   SB_FAILED when the model does not fit into memory. The start stays empty on error. */
sb_status sb_grid_start_fill(const sb_scene *scene, sb_offshore_start *start, sb_error *error);

/* Heap bytes of the model and of what is recorded of it. */
double sb_grid_bytes(const sb_scene *scene);

#endif
