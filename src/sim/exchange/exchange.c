#include "sim/exchange/exchange.h"

#include "base/memory.h"
#include "sim/step/stages.h"

/* What the ghosts of a field of the owned particles are. */
static sb_halo halo_of(const sb_sim *sim, void *field, size_t size)
{
    return (sb_halo){.owned = field,
                     .ghosts = (char *)field + sim->state.n * size,
                     .owned_stride = size,
                     .ghost_stride = size,
                     .size = size};
}

static void begin(const sb_sim *sim, const sb_halo *halo)
{
    (sim->exchange->begin ? sim->exchange->begin : sim->exchange->refresh)(sim, halo);
}

void sb_refresh(const sb_sim *sim, sb_f4 *field)
{
    const sb_halo halo = halo_of(sim, field, sizeof *field);
    sim->exchange->refresh(sim, &halo);
}

void sb_refresh_begin(const sb_sim *sim, sb_f4 *field)
{
    const sb_halo halo = halo_of(sim, field, sizeof *field);
    begin(sim, &halo);
}

void sb_refresh_values(const sb_sim *sim, float *field)
{
    const sb_halo halo = halo_of(sim, field, sizeof *field);
    sim->exchange->refresh(sim, &halo);
}

void sb_refresh_owners(const sb_sim *sim, sb_f4 *field)
{
    sb_halo halo = halo_of(sim, field, sizeof *field);
    halo.without_images = true;
    sim->exchange->refresh(sim, &halo);
}

void sb_refresh_owners_values(const sb_sim *sim, float *field)
{
    sb_halo halo = halo_of(sim, field, sizeof *field);
    halo.without_images = true;
    sim->exchange->refresh(sim, &halo);
}

static sb_halo carried(const sb_sim *sim, const float *values)
{
    enum { LAST_LANE = 3 * sizeof(float) };
    return (sb_halo){.owned = values,
                     .ghosts = (char *)(sim->state.position + sim->state.n) + LAST_LANE,
                     .owned_stride = sizeof *values,
                     .ghost_stride = sizeof *sim->state.position,
                     .size = sizeof *values};
}

void sb_refresh_carried(sb_sim *sim, const float *values)
{
    const sb_halo halo = carried(sim, values);
    sim->exchange->refresh(sim, &halo);
}

void sb_refresh_carried_begin(sb_sim *sim, const float *values)
{
    const sb_halo halo = carried(sim, values);
    begin(sim, &halo);
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
    sb_cells_free(&sim->ghosts.halo_cells);
}
