/* What the maps of a run say: the depth near a body, the flooded ground. Private to src/compare. */
#ifndef SB_COMPARE_NEAR_BODY_H
#define SB_COMPARE_NEAR_BODY_H

#include "report/grid.h"
#include "report/run.h"

/* Reads maps/<name>.asc of a run; false without an effect if it cannot be read. Free with sb_grid_free. */
bool sb_map_of(const sb_report_run *run, const char *name, sb_grid *grid);

/* The greatest depth before a side of the body's plan rectangle, m: of the four sides the greatest mean of the map
   max_depth over cells whose middles lie before the side, at most two particle spacings away, or one cell if that is
   more. The mean, because the depth in one cell is that of a few particles. Dry cells count as 0. NaN: the map does not
   reach there, or the summary has no rectangle (min_m, max_m) of the body. depth: may be empty. */
double sb_depth_near(const sb_report_run *run, const char *body, const sb_grid *depth);

/* wet: a map whose values are above 0 where what was dry at the start became wet. ground: the map of the ground that
   was dry at the start and on which nothing stands, by which cells with buildings, walls and breakwaters are left out;
   empty, or of other cells: they count, as the run does not know them. *area, m²: these cells. *most, m: the greatest
   depth in them; NaN without a map of depths of the same cells. */
void sb_flooded(const sb_grid *wet, const sb_grid *depth, const sb_grid *ground, double *area, double *most);

#endif
