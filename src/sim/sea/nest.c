/* The depth-averaged model beside the particles. */
#include "sim/sea/strip.h"

const sb_offshore *sb_sim_grid(const sb_sim *sim)
{
    return sim->strip ? sb_sea_grid(sim->strip->sea) : NULL;
}

/* The grid takes whole steps of its own length, so that its cost does not depend on the particles' time step, and is
   ahead of them by less than one of its steps. Its time is 0 when it starts, which may be before the particles. */
sb_status sb_strip_advance_grid(sb_sim *sim, sb_error *error)
{
    sb_offshore *grid = sb_sea_grid(sim->strip->sea);
    if (!grid) return SB_OK;
    const double end = sim->state.time + sim->state.time_step - sim->scene->given.start;
    while (sb_offshore_read(grid).time < end) {
        const sb_status status = sb_offshore_step(grid, 2 * (end + 1), NULL, error);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}
