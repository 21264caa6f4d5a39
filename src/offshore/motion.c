#include "offshore/motion.h"
#include "offshore/dispersion.h"
#include "offshore/state.h"

#include <math.h>

/* Velocity of a cell; the nearest cell of the grid stands for one beyond it. */
typedef struct velocity {
    double u, v;
} velocity;

static size_t clamped(ptrdiff_t i, size_t count)
{
    return i < 0 ? 0 : i >= (ptrdiff_t)count ? count - 1 : (size_t)i;
}

static velocity velocity_at(const sb_offshore *o, ptrdiff_t i, ptrdiff_t j)
{
    const size_t at = o->origin + clamped(j, o->options.rows) * o->stride + clamped(i, o->options.columns);
    const double h = o->now.h[at], dry = o->options.dry_depth;
    return (velocity){sb_offshore_velocity(o->now.hu[at], h, dry), sb_offshore_velocity(o->now.hv[at], h, dry)};
}

/* Adds the divergence of a cell's velocity, with this weight, and what depends on dispersion. */
static void add_cell(const sb_offshore *o, size_t column, size_t row, double weight, sb_offshore_motion *out)
{
    const ptrdiff_t i = (ptrdiff_t)column, j = (ptrdiff_t)row;
    const size_t at = o->origin + row * o->stride + column;
    const double d = o->options.cell, h = o->now.h[at];
    if (!(weight > 0) || !(h > o->options.dry_depth)) return;
    const velocity here = velocity_at(o, i, j), w = velocity_at(o, i - 1, j), e = velocity_at(o, i + 1, j);
    const velocity s = velocity_at(o, i, j - 1), n = velocity_at(o, i, j + 1);
    out->divergence += weight * (e.u - w.u + n.v - s.v) / (2 * d);
    if (!o->dispersion || !(o->dispersion->active[at] > 0)) return;
    const velocity sw = velocity_at(o, i - 1, j - 1), se = velocity_at(o, i + 1, j - 1);
    const velocity nw = velocity_at(o, i - 1, j + 1), ne = velocity_at(o, i + 1, j + 1);
    const double square = d * d;
    out->bend[0] += weight * (e.u - 2 * here.u + w.u + 0.25 * (ne.v - se.v - nw.v + sw.v)) / square;
    out->bend[1] += weight * (n.v - 2 * here.v + s.v + 0.25 * (ne.u - se.u - nw.u + sw.u)) / square;
    out->lift += weight * 3 * o->dispersion->pressure[at] / (h * h);
}

/* The motion of a sample over ground; dry, if its water is not above the ground. */
static void motion_of(const sb_offshore *offshore, const sb_offshore_sample *sample, double time, double x, double y,
                      double ground, sb_offshore_motion *out)
{
    const sb_offshore_sample s = *sample;
    const double after = time - s.time[1];
    const bool both = s.wet[0];
    *out = (sb_offshore_motion){.bed = s.bed, .surface = s.water[1].surface};
    if (!s.wet[1]) return;
    out->surface += both ? after * s.rate.surface : 0;
    out->wet = out->surface > ground;
    if (!out->wet) return;
    out->u = s.water[1].u + (both ? after * s.rate.u : 0);
    out->v = s.water[1].v + (both ? after * s.rate.v : 0);
    out->u_rate = both ? s.rate.u : 0;
    out->v_rate = both ? s.rate.v : 0;
    const sb_offshore_corners c = sb_offshore_around(offshore, x, y);
    for (int k = 0; k < 4; k++)
        add_cell(offshore, c.column + (size_t)(k & 1), c.row + (sb_offshore_flat(offshore) ? 0 : (size_t)(k >> 1)),
                 c.weight[k], out);
}

void sb_offshore_motion_at(const sb_offshore *offshore, double time, double x, double y, sb_offshore_motion *out)
{
    const sb_offshore_sample s = sb_offshore_at(offshore, x, y);
    motion_of(offshore, &s, time, x, y, s.bed, out);
    if (!out->wet) out->surface = s.bed;
}

void sb_offshore_motion_over(const sb_offshore *offshore, double time, double x, double y, double ground,
                             sb_offshore_motion *out)
{
    const sb_offshore_sample s = sb_offshore_over(offshore, x, y, ground);
    motion_of(offshore, &s, time, x, y, ground, out);
}
