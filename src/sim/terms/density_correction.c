#include "sim/terms/density_correction.h"

#include "sim/sea/strip.h"

#include <math.h>

/* Margin of the bounds of c_i, as a fraction of the rest density. A wider margin lets particles keep disorder, at which
   passing waves scatter (docs/decisions/0015). */
static const float SLACK = 0.003f;

/* At the start, an excess of the density sum above this fraction of the rest density is an overlap of particles. It is
   not corrected, so that pressure separates them. */
static const float OVERLAP = 0.1f;

/* A c_i outside of its bounds returns to them within the time in which a long wave crosses this many support radii. */
static const double CROSSED = 2;

void sb_density_correction_clear(sb_sim *sim)
{
    for (size_t i = 0; sim->state.density_correction && i < sim->state.n; i++) sim->state.density_correction[i] = NAN;
}

/* The c_i of a particle after this step. own: its c_i before, NAN in the first step; density: the density sum; square:
   |sum_j m grad W_ij|^2; share: fraction of the excess over the bounds that is removed now. */
static float corrected(const sb_constants *c, float own, float density, float square, float share)
{
    if (isnan(own)) own = fmaxf(c->rest_density - density, -OVERLAP * c->rest_density);
    const float slack = SLACK * c->rest_density;
    const float least = c->bulk_deficit - slack, most = c->bulk_deficit + 2 * c->surface_deficit * square + slack;
    const float bound = own > most ? most : own < least ? least : own;
    return own + share * (bound - own);
}

sb_status sb_stage_density_correction(sb_sim *sim, sb_error *error)
{
    (void)error;
    const size_t n = sim->state.n;
    const double crossed = sim->state.time_step * (double)sim->constant.wave_speed / (double)sim->constant.support;
    const float share = (float)fmin(crossed / CROSSED, 1);
    const sb_strip *strip = sim->strip;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        if (strip && sb_strip_side_of(strip, sim->state.position[i])) continue; /* it keeps its own */
        float *own = &sim->state.density_correction[i];
        *own = corrected(&sim->constant, *own, sim->work.density[i], sim->work.water_squared[i], share);
        sim->work.density[i] += *own;
    }
    return SB_OK;
}
