#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"
#include "sim/search/around.h"
#include "sim/step/stages.h"

sb_status sb_stage_neighbours(sb_sim *sim, sb_error *error)
{
    sb_status status = sim->passes->neighbours(sim, error);
    if (status == SB_OK && sim->exchange->under_way && sb_groups_order(sim) != 0)
        status = sb_fail_memory(error, "groups of particles");
    if (sim->exchange->balance) sim->exchange->balance(sim, status == SB_OK);
    return status;
}
