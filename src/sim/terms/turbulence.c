#include "sim/terms/turbulence.h"

#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"

sb_status sb_stage_turbulence(sb_sim *sim, sb_error *error)
{
    (void)error;
    sim->passes->strain_rate(sim);
    sb_refresh_values(sim, sim->work.eddy);
    return SB_OK;
}
