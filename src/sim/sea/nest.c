/* The depth-averaged model beside the particles. It covers them, too, so that it gives the water of the strips. Coupled
   two ways, it has two parts on the two sides of a line of faces beyond each strip: within, the water that it gives;
   outside, this and the waves that leave the particles. The flux through the line is that of the given water as seen
   from within, and that of all water as seen from outside (in the manner of total and scattered fields in
   electrodynamics): the difference is added to the first cells outside. What leaves the particles continues in the
   grid, and the water within is not changed by it. */
#include "base/memory.h"
#include "sim/sea/strip.h"

#include <math.h>

/* Cells from the nearest one whose value reaches a strip by interpolation to the first one outside of the line. Beside
   the line the water within is disturbed over some cells: with 2 instead of 6, the level in the domain was wrong by a
   tenth of the wave that had left. */
enum { APART = 6 };

const sb_offshore *sb_sim_grid(const sb_sim *sim)
{
    return sim->strip ? sb_sea_grid(sim->strip->sea) : NULL;
}

const sb_offshore_maps *sb_sim_grid_maps(const sb_sim *sim)
{
    return sim->strip ? sb_sea_maps(sim->strip->sea) : NULL;
}

/* The line beyond a side. */
typedef struct line {
    const sb_strip_side *side;
    bool along_y;          /* the line runs along y */
    double sign;           /* of the axis inwards */
    size_t outside;        /* column, or row, of the first cells outside */
    size_t first, count;   /* cells along the line */
    double inwards, start; /* m, of the line: negative; along the side, of the first cell's centre */
} line;

static line line_of(const sb_sim *sim, const sb_offshore_view *v, const sb_strip_side *s)
{
    const bool upper = s->side % 2 == 1, across_x = s->axis == 0, flat = v->rows == 1;
    const double from = across_x ? v->x : v->y, other = across_x ? v->y : v->x;
    const sb_vec3 min = sim->model->min, max = sim->model->max;
    const double at = across_x ? (upper ? max.x : min.x) : (upper ? max.y : min.y);
    const double low = across_x ? min.y : min.x, high = across_x ? max.y : max.x;
    const double place = (at - from) / v->cell - 0.5;
    const double outside = upper ? ceil(place) + APART : floor(place) - APART;
    line l = {.side = s, .along_y = across_x, .sign = upper ? -1 : 1, .outside = (size_t)fmax(outside, 0)};
    const double face = from + (outside + (upper ? 0 : 1)) * v->cell;
    l.inwards = l.sign * (face - at);
    l.count = 1;
    if (flat) return l;
    const double first = ceil((low - other) / v->cell - 0.5 - 1e-9),
                 last = floor((high - other) / v->cell - 0.5 + 1e-9);
    l.first = (size_t)first;
    l.count = (size_t)(last - first + 1);
    l.start = other + (first + 0.5) * v->cell - low;
    return l;
}

static bool has_line(const sb_sim *sim, const sb_strip_side *s)
{
    return sb_sea_grid(sim->strip->sea) && sim->scene->offshore.coupling == SB_COUPLING_TWO_WAY &&
           sb_scene_given_side(sim->scene, s->side);
}

double sb_strip_to_line(const sb_sim *sim, const sb_strip_side *s)
{
    if (!has_line(sim, s)) return 0;
    const sb_offshore_view v = sb_offshore_read(sb_sea_grid(sim->strip->sea));
    return s->strip - line_of(sim, &v, s).inwards;
}

static sb_offshore_wave wave_at(const sb_sim *sim, const sb_strip_side *s, double later, double inwards, double along,
                                double depth)
{
    sb_column all = {.depth = depth};
    sb_strip_total(sim, s, later, inwards, along, &all);
    return (sb_offshore_wave){all.depth - depth, all.inwards, all.pressure};
}

/* The wave that leaves at cell k of a line, `later` seconds after it was measured. */
static sb_offshore_jump jump_at(const sb_sim *sim, const sb_offshore_view *v, const line *l, size_t k, double later)
{
    const size_t along = l->first + k;
    sb_offshore_jump jump = {.column = l->along_y ? l->outside : along,
                             .row = l->along_y ? along : l->outside,
                             .axis = l->along_y ? 0 : 1,
                             .sign = l->sign > 0 ? 1 : -1};
    const ptrdiff_t within = jump.sign * (l->along_y ? 1 : (ptrdiff_t)v->stride);
    const double h = v->h[(ptrdiff_t)(jump.row * v->stride + jump.column) + within];
    const double place = l->start + (double)k * v->cell;
    if (!(h > sim->scene->resolution)) return jump;
    sb_offshore_wave *const wave[] = {&jump.outer, &jump.outside, &jump.within, &jump.inner};
    for (int cell = 0; cell < 4; cell++)
        *wave[cell] = wave_at(sim, l->side, later, l->inwards + (cell - 1.5) * v->cell, place, h);
    return jump;
}

/* Sets the jumps of the grid's next step, at its middle: as long as the last one. */
static sb_status set_jumps(sb_sim *sim, sb_offshore *grid, double now, sb_error *error)
{
    const sb_offshore_view v = sb_offshore_read(grid);
    const double later = v.time + 0.5 * (v.time - v.before) - now;
    sb_strip *strip = sim->strip;
    size_t count = 0;
    for (size_t n = 0; n < strip->count; n++) {
        if (!has_line(sim, &strip->side[n])) continue;
        const line l = line_of(sim, &v, &strip->side[n]);
        if (sb_grow((void **)&strip->jumps, &strip->jump_capacity, count + l.count, sizeof *strip->jumps) != 0)
            return sb_fail_memory(error, "waves that leave into the grid");
        for (size_t k = 0; k < l.count; k++) strip->jumps[count++] = jump_at(sim, &v, &l, k, later);
    }
    sb_offshore_set_jumps(grid, strip->jumps, count);
    return SB_OK;
}

/* The grid takes whole steps of its own length, so that its cost does not depend on the particles' time step, and is
   ahead of them by less than one of its steps. Its time is 0 when it starts, which may be before the particles. */
sb_status sb_strip_advance_grid(sb_sim *sim, sb_error *error)
{
    sb_offshore *grid = sb_sea_grid(sim->strip->sea);
    if (!grid) return SB_OK;
    sb_offshore_maps *maps = sb_sea_maps(sim->strip->sea);
    const bool both = sim->scene->offshore.coupling == SB_COUPLING_TWO_WAY;
    const double now = sim->state.time - sim->scene->given.start, end = now + sim->state.time_step;
    while (sb_offshore_read(grid).time < end) {
        sb_status status = both ? set_jumps(sim, grid, now, error) : SB_OK;
        double taken = 0;
        if (status == SB_OK) status = sb_offshore_step(grid, 2 * (end + 1), &taken, error);
        if (status != SB_OK) return status;
        if (maps) sb_offshore_maps_step(maps, grid, taken);
    }
    return SB_OK;
}
