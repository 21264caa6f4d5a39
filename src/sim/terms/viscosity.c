/* The stage forces: v* = v + dt (g + Monaghan viscosity [S16, eq. 14] + physical and eddy viscosity + wall friction and
   wall shear + the hydrostatic push of images). */
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/step/stages.h"

static sb_viscous factors_of(const sb_sim *sim)
{
    const sb_numerics *n = &sim->scene->numerics;
    const sb_constants *c = &sim->constant;
    double h_quanta = (double)c->support / sim->space.quantum;
    return (sb_viscous){
        .on = sim->needs.viscosity,
        .artificial = 2.0f * (float)n->artificial_viscosity * c->support * c->sound_speed,
        .physical = 4.0f * (float)(c->dimension + 2) * c->viscosity,
        .eddy = 2.0f * (float)(c->dimension + 2),
        .epsilon = (float)(0.01 * h_quanta * h_quanta),
        .inverse_quantum = (float)(1.0 / sim->space.quantum),
    };
}

sb_status sb_stage_forces(sb_sim *sim, sb_error *error)
{
    const sb_viscous viscous = factors_of(sim);
    const sb_wall_drag law = sb_wall_drag_make(sim);
    if (viscous.on) sb_pressure_load_begin(sim, sim->work.density);
    return sim->passes->forces(sim, &viscous, &law, error);
}
