/* Heights of terrain at the cell centres of the depth-averaged model's grid. */
#ifndef SB_GEOMETRY_GRID_BED_H
#define SB_GEOMETRY_GRID_BED_H

#include "base/status.h"
#include "offshore/start.h"

/* Number of cells of scene->offshore; 1 row in 2D. */
size_t sb_bed_columns(const sb_scene *scene);
size_t sb_bed_rows(const sb_scene *scene);

/* Fills start->bed, which has room for the cells, in m: linear within the triangles of offshore.terrain, or else the
   highest surface of the bodies seen from above, or else the domain's floor. A grid of offshore.terrain without a key
   `projection` has that of the grids before it. SB_BAD_INPUT names a file that cannot be read, the first cell that
   offshore.terrain does not cover, or a grid whose projection puts places elsewhere than that of the grids before it.
   Sets start->uncovered, start->projection, and start->told to what the grids state, and to warnings of heights that
   are most likely missing ones; the caller frees both also on error. Bodies are warned of only where there are no
   particles. */
sb_status sb_bed_fill(const sb_scene *scene, sb_offshore_start *start, sb_error *error);

/* Fills start->depth, which has room for the cells, with offshore.uplift in the same way, in m: 0 where its grid has no
   height, and everywhere without an uplift. Its projection is as that of a further grid of offshore.terrain, or of the
   first grid among the bodies when these are the bed. SB_BAD_INPUT names a file that cannot be read, or that covers no
   cell. Appends what the grid states, and warnings, to start->told. */
sb_status sb_uplift_fill(const sb_scene *scene, sb_offshore_start *start, sb_error *error);

#endif
