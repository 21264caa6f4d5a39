/* Heights between the nodes of a grid, layers of grids, and missing heights. Private to src/geometry/grid. */
#ifndef SB_GEOMETRY_GRID_SAMPLE_H
#define SB_GEOMETRY_GRID_SAMPLE_H

#include "geometry/grid/grid.h"

/* The height at a place, linear in both directions between the nodes. A node's cell extends half a step to each side,
   so that neighbouring files join. INFINITY: outside of all cells; NAN: in the cell of a missing height. */
double sb_grid_height(const sb_grid *grid, double x, double y);

/* Lays the heights of `above` over those of `below`, both count[0] x count[1]; heights are as those of
   sb_grid_height. From the edge of its cover on, `above` gains weight over `width` steps, so that the ground has no
   cliff where the layers differ. `distance` has room for one number per height. */
void sb_grid_overlay(const size_t count[2], double width, const double *above, double *below, float *distance);

/* Replaces NAN (not INFINITY) by heights interpolated from those around: the start is a pyramid of means, then each
   becomes the mean of its neighbours, 100 times. The result is between the least and the greatest height. A grid
   without heights is unchanged. Returns how many are filled; SB_FAILED without memory. */
sb_status sb_grid_fill(const size_t count[2], double *heights, size_t *filled, sb_error *error);

#endif
