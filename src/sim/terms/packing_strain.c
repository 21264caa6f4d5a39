#include "sim/terms/packing_strain.h"

#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/sea/strip.h"
#include "sim/terms/stress_correction.h"

#include <math.h>

/* Largest change of c_i in one step, as a fraction of the rest density. In an impact, particles change places: that is
   no strain of the packing. Without the bound, jets and loose tolerances diverge (docs/decisions/0097). */
static const float MOST = 0.01f;

/* Adds the change of c_i in this step. */
static void follow(sb_sim *sim)
{
    const size_t n = sim->state.n;
    const float dt = (float)sim->state.time_step, most = MOST * sim->constant.rest_density;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        if (sim->strip && sb_strip_side_of(sim->strip, sim->state.position[i])) continue;
        const float change = fmaxf(fminf(-dt * sim->work.strained[i], most), -most);
        sim->state.density_correction[i] += change;
        sim->work.density[i] += change;
    }
}

sb_status sb_stage_packing_strain(sb_sim *sim, sb_error *error)
{
    if (!sim->policy->runs) return SB_OK;
    sim->passes->strain(sim);
    sb_refresh(sim, sim->work.deviator);
    sb_pressure_load_begin(sim, sim->work.deviator_xx);
    if (sb_stress_mean(sim) != 0) return sb_fail_memory(error, "means of the strain of the particle packing");
    sim->passes->strained(sim);
    follow(sim);
    return SB_OK;
}
