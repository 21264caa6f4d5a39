#include "sim/exchange/exchange.h"

#include "base/memory.h"
#include "sim/step/stages.h"

void sb_refresh(const sb_sim *sim, sb_f4 *field)
{
    const size_t stride = sizeof *field;
    sim->exchange->refresh(sim, &(sb_halo){field, field + sim->state.n, stride, stride, sizeof *field});
}

void sb_refresh_values(const sb_sim *sim, float *field)
{
    const size_t stride = sizeof *field;
    sim->exchange->refresh(sim, &(sb_halo){field, field + sim->state.n, stride, stride, sizeof *field});
}

void sb_refresh_carried(sb_sim *sim, const float *values)
{
    enum { LAST_LANE = 3 * sizeof(float) };
    char *ghosts = (char *)(sim->state.position + sim->state.n) + LAST_LANE;
    sim->exchange->refresh(sim,
                           &(sb_halo){values, ghosts, sizeof *values, sizeof *sim->state.position, sizeof *values});
}

sb_status sb_stage_ghosts(sb_sim *sim, sb_error *error)
{
    const sb_status status = sim->exchange->make_ghosts(sim, error);
    if (status == SB_OK) sb_refresh(sim, sim->state.velocity);
    return status;
}

void sb_ghosts_destroy(sb_sim *sim)
{
    sb_free(sim->ghosts.of);
    sb_free(sim->ghosts.words);
    sb_free(sim->ghosts.other);
    sb_cells_free(&sim->ghosts.cells);
}
