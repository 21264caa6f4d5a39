/* Gauges in the depth-averaged water beside the particles. */
#include "measure/parts.h"
#include "offshore/motion.h"

double sb_grid_gauge_read(const sb_sim *sim, const sb_scene *scene, const sb_gauge *gauge, double time)
{
    const sb_offshore *grid = sb_sim_grid(sim);
    sb_offshore_motion water = {0};
    if (grid) sb_offshore_motion_at(grid, time - scene->given.start, gauge->x, gauge->y, &water);
    return water.wet ? water.surface : (double)NAN;
}
