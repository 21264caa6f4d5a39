#include "sim/terms/hyperviscosity.h"

#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"
#include "sim/step/stages.h"

#include <string.h>

double sb_faint_viscosity(const sb_scene *scene, double wave_speed)
{
    return 0x1p-20 * scene->numerics.hyperviscosity * wave_speed * scene->resolution;
}

sb_status sb_stage_hyperviscosity(sb_sim *sim, sb_error *error)
{
    (void)error;
    const sb_constants *c = &sim->constant;
    const float rate = (float)sim->scene->numerics.hyperviscosity * c->wave_speed / c->spacing;
    const float change = -rate * (float)sim->state.time_step / c->lattice_slopes;
    memset(sim->work.differences, 0, sim->state.n * sizeof *sim->work.differences);
    sim->passes->differences(sim, sim->state.velocity, 1 / c->lattice_slopes, sim->work.differences);
    sb_refresh(sim, sim->work.differences);
    sim->passes->differences(sim, sim->work.differences, change, sim->work.predicted);
    return SB_OK;
}
