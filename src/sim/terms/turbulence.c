#include "sim/terms/turbulence.h"

#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"

sb_status sb_stage_turbulence(sb_sim *sim, sb_error *error)
{
    const sb_status status = sim->passes->strain_rate(sim, error);
    sb_refresh_values(sim, sim->work.eddy);
    return status;
}
