/* Where the non-hydrostatic pressure is left out: on dry land and at its shore, and where waves break. There the
   shallow- water equations form a bore, which loses the energy that a breaker loses. */
#include "offshore/dispersion.h"
#include "offshore/flux.h"
#include "offshore/jump.h"

#include <string.h>

/* A wave breaks where its surface rises faster than BEGINS sqrt(g h), and beside breaking water faster than
   CONTINUES sqrt(g h) [Smit, Zijlema & Stelling 2013]. */
static const double BEGINS = 0.6, CONTINUES = 0.3;

typedef struct line {
    const double *bed, *h, *hu, *hv, *before;
    double *breaking, *active;
    double gravity, scale, dry;
    ptrdiff_t up; /* 0 with one row */
} line;

/* scale: 1 / (2 cell). */
SB_MULTIVERSION static void find_breaking(line l, size_t count)
{
#pragma omp simd
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
        const double rise = -l.scale * (l.hu[i + 1] - l.hu[i - 1] + l.hv[i + l.up] - l.hv[i - l.up]);
        const double beside = l.before[i] + l.before[i - 1] + l.before[i + 1] + l.before[i - l.up] + l.before[i + l.up];
        const double limit = (beside > 0 ? CONTINUES : BEGINS) * sqrt(l.gravity * l.h[i]);
        l.breaking[i] = rise > limit ? 1 : 0;
    }
}

/* Ratio of depths of neighbouring cells below which the equations, whose waves are long, do not hold. */
static const double ABRUPT = 0.25;

SB_INLINE double smaller_of_four(const double *v, ptrdiff_t up)
{
    return least(least(v[1], v[-1]), least(v[up], v[-up]));
}

/* A cell has a pressure, 1, when neither it nor a neighbour breaks; otherwise 0. Beside dry cells, cliffs and abrupt
   changes of depth it has none and no force of its neighbours' pressures acts on it, -1. cliff: m from cell to cell. */
SB_MULTIVERSION static void find_active(line l, double cliff, size_t count)
{
#pragma omp simd
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
        const double lowest = smaller_of_four(l.h + i, l.up), *b = l.bed + i, *k = l.breaking + i;
        const double rise = most(most(b[1], b[-1]), most(b[l.up], b[-l.up])) - b[0];
        const double fall = b[0] - smaller_of_four(b, l.up);
        const double broken = k[0] + k[1] + k[-1] + k[l.up] + k[-l.up];
        const double held = broken > 0 ? 0 : 1;
        const double water = least(lowest, l.h[i]) > l.dry ? held : -1;
        const double even = lowest > ABRUPT * l.h[i] ? water : -1;
        l.active[i] = most(rise, fall) <= cliff ? even : -1;
    }
}

static line line_at(const sb_offshore *o, const sb_offshore_level *level, size_t j)
{
    const struct sb_offshore_dispersion *d = o->dispersion;
    const size_t at = o->origin + j * o->stride;
    return (line){.bed = o->bed + at,
                  .h = level->h + at,
                  .hu = level->hu + at,
                  .hv = level->hv + at,
                  .before = d->system.product + at,
                  .breaking = d->breaking + at,
                  .active = d->active + at,
                  .gravity = o->options.gravity,
                  .scale = 0.5 / o->options.cell,
                  .dry = 10 * o->options.dry_depth,
                  .up = sb_offshore_flat(o) ? 0 : (ptrdiff_t)o->stride};
}

/* Cells beside open and given sides in which the law of long waves at the side must find the equations of long waves.
   With 0, 1, 3 and 20 cells 11, 3.0, 2.5 and 2.5 % of a solitary wave of 0.3 of the depth come back. */
enum { STRIP = 3 };

static bool is_passed(sb_offshore_side side)
{
    return side == SB_OFFSHORE_OPEN || side == SB_OFFSHORE_GIVEN;
}

static void clear_sides(const sb_offshore *o)
{
    const size_t columns = o->options.columns, rows = o->options.rows;
    const size_t wide = columns < STRIP ? columns : STRIP, high = rows < STRIP ? rows : STRIP;
    double *active = o->dispersion->active + o->origin;
    for (int s = SB_OFFSHORE_X_MIN; s <= SB_OFFSHORE_X_MAX; s++)
        for (size_t j = 0; is_passed(o->options.side[s]) && j < rows; j++)
            for (size_t k = 0; k < wide; k++)
                active[j * o->stride + (s == SB_OFFSHORE_X_MIN ? k : columns - 1 - k)] = -1;
    for (int s = SB_OFFSHORE_Y_MIN; s <= SB_OFFSHORE_Y_MAX && rows > 1; s++)
        for (size_t k = 0; is_passed(o->options.side[s]) && k < high; k++)
            for (size_t i = 0; i < columns; i++)
                active[(s == SB_OFFSHORE_Y_MIN ? k : rows - 1 - k) * o->stride + i] = -1;
}

void sb_offshore_mark_active(sb_offshore *offshore, const sb_offshore_level *level, bool decide)
{
    const size_t rows = offshore->options.rows, count = offshore->options.columns;
    double *before = offshore->dispersion->system.product; /* free between two solves */
    if (decide) {
        memcpy(before, offshore->dispersion->breaking, offshore->cells * sizeof *before);
#pragma omp parallel for schedule(static) if (offshore->cells > 20000)
        for (size_t j = 0; j < rows; j++) find_breaking(line_at(offshore, level, j), count);
        sb_offshore_jump_breaking(offshore);
        sb_offshore_wrap(offshore, offshore->dispersion->breaking, 1);
    }
#pragma omp parallel for schedule(static) if (offshore->cells > 20000)
    for (size_t j = 0; j < rows; j++)
        find_active(line_at(offshore, level, j), SB_OFFSHORE_STEEPEST * offshore->options.cell, count);
    clear_sides(offshore);
    sb_offshore_wrap(offshore, offshore->dispersion->active, 0);
}
