#include "sim/density_correction.h"

#include <math.h>

/* Of the rest density: by so much an addition may be off without being mended, once it has twice what a flat surface
   with the same cut-off would lack. More is disorder that particles carry about, and waves scatter from
   (docs/decisions/0015). */
static const float SLACK = 0.003f;

/* At the start an excess above the walls' share, and this part of the rest density, is no stand-in for water but an
   overlap, and is left to be pushed apart. */
static const float OVERLAP = 0.1f;

/* An addition that is out of bounds is mended within the time in which a long wave crosses this many supports. */
static const double CROSSED = 2;

bool sb_density_correction_on(const sb_scene *scene)
{
    return scene->numerics.density == SB_DENSITY_COMPLETED;
}

void sb_density_correction_clear(sb_sim *sim)
{
    for (size_t i = 0; sim->density_correction && i < sim->model->fluid_count; i++) sim->density_correction[i] = NAN;
}

/* density: the sum; by_walls: the walls' part of it; square: |sum_j m grad W_ij|^2 over the water; share: of what is
   out of bounds, to be mended now. */
static float mended(const sb_constants *c, float own, float density, float by_walls, float square, float share)
{
    if (isnan(own)) own = fmaxf(c->rest_density - density, -by_walls - OVERLAP * c->rest_density);
    if (by_walls > 0) return own;
    const float slack = SLACK * c->rest_density;
    const float least = c->bulk_deficit - slack, most = c->bulk_deficit + 2 * c->surface_deficit * square + slack;
    const float bound = own > most ? most : own < least ? least : own;
    return own + share * (bound - own);
}

sb_status sb_stage_density_correction(sb_sim *sim, sb_error *error)
{
    (void)error;
    const size_t n = sim->n;
    const double crossed = sim->report.time_step * (double)sim->constant.wave_speed / (double)sim->constant.support;
    const float share = (float)fmin(crossed / CROSSED, 1);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        float *own = &sim->density_correction[sim->id[i]];
        *own = mended(&sim->constant, *own, sim->density[i], sim->source[i], sim->residual[i], share);
        sim->density[i] += *own;
    }
    return SB_OK;
}
