/* The difference of inundation between groups of runs. Private to src/compare. */
#ifndef SB_COMPARE_DIFFERENCE_H
#define SB_COMPARE_DIFFERENCE_H

#include "compare/comparison.h"
#include "report/grid.h"

/* The greatest depth in each cell, the mean over the runs of a group; 0 in cells that stayed dry in one of its runs,
   NaN in those that stayed dry in all. SB_BAD_INPUT if a run has no such map, or one of other cells than the first. */
sb_status sb_group_depth(const sb_comparison *comparison, size_t group, sb_grid *depth, sb_error *error);

/* other - one, m; a cell that stayed dry counts as depth 0; NaN where both stayed dry. Both have the same cells. */
sb_status sb_grid_subtract(const sb_grid *one, const sb_grid *other, sb_grid *difference, sb_error *error);

/* Whether two grids have the same cells. */
bool sb_grid_same(const sb_grid *one, const sb_grid *other);

/* The size, m, that one of a hundred of the cells with a difference exceeds; 0 if there is none. */
double sb_grid_spread(const sb_grid *difference);

/* Writes an ESRI ASCII grid; cells without a value are -9999. */
sb_status sb_grid_write(const char *path, const sb_grid *grid, sb_error *error);

#endif
