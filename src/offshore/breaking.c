/* Where the non-hydrostatic pressure is left out: on dry land and at its shore, and where waves break. There the shallow-
   water equations form a bore, which loses the energy that a breaker loses. */
#include "offshore/dispersion.h"
#include "offshore/flux.h"

#include <string.h>

/* A wave breaks where its surface rises faster than BEGINS sqrt(g h), and beside breaking water faster than
   CONTINUES sqrt(g h) [Smit, Zijlema & Stelling 2013]. */
static const double BEGINS = 0.6, CONTINUES = 0.3;

typedef struct line {
    const double *h, *hu, *hv, *before;
    double *breaking, *active;
    double gravity, scale, dry;
    ptrdiff_t up; /* 0 with one row */
} line;

/* scale: 1 / (2 cell). */
SB_MULTIVERSION static void find_breaking(line l, size_t count)
{
#pragma omp simd
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
        const double rise =
            -l.scale * (l.hu[i + 1] - l.hu[i - 1] + l.hv[i + l.up] - l.hv[i - l.up]);
        const double beside =
            l.before[i] + l.before[i - 1] + l.before[i + 1] + l.before[i - l.up] + l.before[i + l.up];
        const double limit = (beside > 0 ? CONTINUES : BEGINS) * sqrt(l.gravity * l.h[i]);
        l.breaking[i] = rise > limit ? 1 : 0;
    }
}

/* A cell has a pressure when it and its neighbours have water and do not break. */
SB_MULTIVERSION static void find_active(line l, size_t count)
{
#pragma omp simd
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
        const double shallowest =
            least(least(l.h[i], least(l.h[i - 1], l.h[i + 1])), least(l.h[i - l.up], l.h[i + l.up]));
        const double broken =
            l.breaking[i] + l.breaking[i - 1] + l.breaking[i + 1] + l.breaking[i - l.up] + l.breaking[i + l.up];
        l.active[i] = shallowest > l.dry && !(broken > 0) ? 1 : 0;
    }
}

static line line_at(const sb_offshore *o, const sb_offshore_level *level, size_t j)
{
    const struct sb_offshore_dispersion *d = o->dispersion;
    const size_t at = o->origin + j * o->stride;
    return (line){.h = level->h + at,
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

void sb_offshore_mark_active(sb_offshore *offshore, const sb_offshore_level *level, bool decide)
{
    const size_t rows = offshore->options.rows, count = offshore->options.columns;
    double *before = offshore->dispersion->system.product; /* free between two solves */
    if (decide) {
        memcpy(before, offshore->dispersion->breaking, offshore->cells * sizeof *before);
#pragma omp parallel for schedule(static) if (offshore->cells > 20000)
        for (size_t j = 0; j < rows; j++) find_breaking(line_at(offshore, level, j), count);
        sb_offshore_wrap(offshore, offshore->dispersion->breaking, 1);
    }
#pragma omp parallel for schedule(static) if (offshore->cells > 20000)
    for (size_t j = 0; j < rows; j++) find_active(line_at(offshore, level, j), count);
    sb_offshore_wrap(offshore, offshore->dispersion->active, 0);
}
