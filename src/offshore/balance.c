/* Volumes, energies and exchange. */
#include "offshore/dispersion.h"
#include "offshore/state.h"

#include <math.h>

sb_offshore_view sb_offshore_read(const sb_offshore *offshore)
{
    const sb_offshore_options *o = &offshore->options;
    const size_t at = offshore->origin;
    return (sb_offshore_view){.columns = o->columns,
                              .rows = o->rows,
                              .stride = offshore->stride,
                              .x = o->x,
                              .y = o->y,
                              .cell = o->cell,
                              .time = offshore->time,
                              .before = offshore->before_time,
                              .dry_depth = o->dry_depth,
                              .bed = offshore->bed + at,
                              .h = offshore->now.h + at,
                              .hu = offshore->now.hu + at,
                              .hv = offshore->now.hv + at};
}

sb_offshore_balance sb_offshore_find_balance(const sb_offshore *offshore)
{
    const sb_offshore_options *o = &offshore->options;
    const double area = sb_offshore_flat(offshore) ? o->cell : o->cell * o->cell;
    sb_offshore_balance b = {.first = offshore->first, .added = offshore->added, .repaired = offshore->repaired};
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) b.entered[s] = offshore->entered[s];
    for (size_t j = 0; j < o->rows; j++) {
        double volume = 0, kinetic = 0, potential = 0, x = 0, y = 0;
        for (size_t i = 0; i < o->columns; i++) {
            const size_t at = offshore->origin + j * offshore->stride + i;
            const double h = offshore->now.h[at], hu = offshore->now.hu[at], hv = offshore->now.hv[at];
            volume += h;
            x += hu;
            y += hv;
            potential += o->gravity * h * (offshore->bed[at] + 0.5 * h);
            if (h > 0) kinetic += 0.5 * (hu * hu + hv * hv) / h;
        }
        b.now += volume * area;
        b.momentum_x += x * area;
        b.momentum_y += y * area;
        b.kinetic += kinetic * area;
        b.potential += potential * area;
    }
    return b;
}

sb_offshore_effort sb_offshore_find_effort(const sb_offshore *offshore)
{
    sb_offshore_effort effort = {.steps = offshore->steps};
    if (offshore->dispersion) sb_offshore_dispersion_effort(offshore, &effort.iterations, &effort.breaking);
    return effort;
}

double sb_offshore_add(sb_offshore *offshore, size_t column, size_t row, double depth, double hu, double hv)
{
    const sb_offshore_options *o = &offshore->options;
    const size_t at = offshore->origin + row * offshore->stride + column;
    const double before = offshore->now.h[at], after = fmax(0, before + depth);
    offshore->now.h[at] = after;
    offshore->now.hu[at] = after > 0 ? offshore->now.hu[at] + hu : 0;
    offshore->now.hv[at] = after > 0 && !sb_offshore_flat(offshore) ? offshore->now.hv[at] + hv : 0;
    offshore->added += (after - before) * (sb_offshore_flat(offshore) ? o->cell : o->cell * o->cell);
    return after - before;
}
