#include "sim/terms/turbulence.h"

#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"

bool sb_turbulence_on(const sb_scene *scene)
{
    return scene->numerics.turbulence == SB_TURBULENCE_SPS;
}

sb_status sb_stage_turbulence(sb_sim *sim, sb_error *error)
{
    (void)error;
    sim->passes->strain_rate(sim);
    sb_refresh_values(sim, sim->work.eddy);
    return SB_OK;
}
