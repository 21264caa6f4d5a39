#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"
#include "sim/step/stages.h"

sb_status sb_stage_neighbours(sb_sim *sim, sb_error *error)
{
    const sb_status status = sim->passes->neighbours(sim, error);
    if (sim->exchange->balance) sim->exchange->balance(sim, status == SB_OK);
    return status;
}
