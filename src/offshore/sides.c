/* The cells beyond the sides. */
#include "offshore/paddle.h"
#include "offshore/state.h"

#include <math.h>

/* The cells that one side needs at one place along it: the two nearest cells within, the two beyond. */
typedef struct edge {
    size_t within[SB_OFFSHORE_BEYOND], beyond[SB_OFFSHORE_BEYOND], around[SB_OFFSHORE_BEYOND];
    double outward; /* sign of the outward direction along the axis */
    double x, y;    /* m, middle of the face */
} edge;

/* State beyond from the outgoing invariant of the water within, u + 2 c, and the incoming one of the water given
   beyond, u - 2 c; the faster than c is taken whole from where it comes. See docs/offshore.md. */
static void radiate(const sb_offshore *offshore, double h, double normal, double given_h, double given_normal,
                    double *beyond_h, double *beyond_normal)
{
    const double g = offshore->options.gravity, c = sqrt(g * h), given_c = sqrt(g * given_h);
    if (h > 0 && normal >= c) { /* leaves faster than waves */
        *beyond_h = h;
        *beyond_normal = normal;
        return;
    }
    if (given_h > 0 && given_normal <= -given_c) { /* enters faster than waves */
        *beyond_h = given_h;
        *beyond_normal = given_normal;
        return;
    }
    /* Sums and differences that are exact in water at rest. */
    const double beyond_c = fmax(0, 0.5 * (c + given_c) + 0.25 * (normal - given_normal));
    *beyond_h = fmax(0, given_h + (beyond_c - given_c) * (beyond_c + given_c) / g);
    *beyond_normal = 0.5 * (normal + given_normal) + (c - given_c);
}

/* Fills the two cells beyond a side that waves pass. */
static void fill_passing(const sb_offshore *offshore, double *h, double *across, double *along, const edge *e, int side,
                         double time)
{
    const sb_offshore_options *o = &offshore->options;
    const size_t at = e->within[0];
    const double bed = offshore->bed[at], dry = o->dry_depth;
    sb_offshore_water water = {.surface = o->level};
    double given_normal = 0, given_along = 0;
    const bool given = o->side[side] == SB_OFFSHORE_GIVEN;
    if (given) {
        water = o->given(o->given_context, time, e->x, e->y);
        const bool across_x = side < SB_OFFSHORE_Y_MIN;
        given_normal = e->outward * (across_x ? water.u : water.v);
        given_along = across_x ? water.v : water.u;
    }
    double beyond_h, normal;
    radiate(offshore, h[at], e->outward * sb_offshore_velocity(across[at], h[at], dry), fmax(0, water.surface - bed),
            given_normal, &beyond_h, &normal);
    const double drift = normal > 0 || !given ? sb_offshore_velocity(along[at], h[at], dry) : given_along;
    for (int k = 0; k < SB_OFFSHORE_BEYOND; k++) {
        h[e->beyond[k]] = beyond_h;
        across[e->beyond[k]] = e->outward * normal * beyond_h;
        along[e->beyond[k]] = drift * beyond_h;
    }
}

/* Fills the two cells beyond a side that moves water: a mirror that moves with it, and the slope of the wave that it
   makes. */
static void fill_pushing(const sb_offshore *offshore, double *h, double *across, double *along, const edge *e)
{
    const sb_offshore_push *push = &offshore->push;
    const double dry = offshore->options.dry_depth;
    const double slope = sb_offshore_push_slope(push, h[e->within[0]]);
    for (int k = 0; k < SB_OFFSHORE_BEYOND; k++) {
        const size_t from = e->within[k], to = e->beyond[k];
        h[to] = fmax(h[from] - (2 * k + 1) * offshore->options.cell * slope, 0);
        across[to] = -across[from];
        along[to] = along[from];
        if (push->velocity == 0 && push->rate == 0) continue;
        across[to] = -h[to] * (2 * e->outward * push->velocity + sb_offshore_velocity(across[from], h[from], dry));
        along[to] = h[to] * sb_offshore_velocity(along[from], h[from], dry);
    }
}

static void fill(const sb_offshore *offshore, double *h, double *across, double *along, const edge *e, int side,
                 double time)
{
    const sb_offshore_side kind = offshore->options.side[side];
    if (kind == SB_OFFSHORE_OPEN || kind == SB_OFFSHORE_GIVEN) {
        fill_passing(offshore, h, across, along, e, side, time);
        return;
    }
    if (kind == SB_OFFSHORE_PADDLE) {
        fill_pushing(offshore, h, across, along, e);
        return;
    }
    const bool wall = kind == SB_OFFSHORE_WALL;
    for (int k = 0; k < SB_OFFSHORE_BEYOND; k++) {
        const size_t from = wall ? e->within[k] : e->around[k];
        h[e->beyond[k]] = h[from];
        across[e->beyond[k]] = wall ? -across[from] : across[from];
        along[e->beyond[k]] = along[from];
    }
}

/* The edge at position `place` along a side; `first` is the index of its cell in the first row or column, `step` from
   one cell to the next across the side, `count` the number of cells across. */
static edge edge_at(size_t first, size_t step, size_t count, bool high, double x, double y)
{
    edge e = {.outward = high ? 1 : -1, .x = x, .y = y};
    for (size_t k = 0; k < SB_OFFSHORE_BEYOND; k++) {
        const size_t low_within = first + k * step, high_within = first + (count - 1 - k) * step;
        e.within[k] = high ? high_within : low_within;
        e.around[k] = high ? low_within : high_within;
        e.beyond[k] = high ? first + (count + k) * step : first - (k + 1) * step;
    }
    return e;
}

void sb_offshore_fill_sides(const sb_offshore *offshore, const sb_offshore_level *level, double time)
{
    const sb_offshore_options *o = &offshore->options;
    const double width = (double)o->columns * o->cell, length = (double)o->rows * o->cell;
    for (int high = 0; high < 2; high++)
        for (size_t j = 0; j < o->rows; j++) {
            const edge e = edge_at(offshore->origin + j * offshore->stride, 1, o->columns, high,
                                   o->x + (high ? width : 0), o->y + ((double)j + 0.5) * o->cell);
            fill(offshore, level->h, level->hu, level->hv, &e, SB_OFFSHORE_X_MIN + high, time);
        }
    if (sb_offshore_flat(offshore)) return;
    for (int high = 0; high < 2; high++)
        for (size_t i = 0; i < o->columns; i++) {
            const edge e = edge_at(offshore->origin + i, offshore->stride, o->rows, high,
                                   o->x + ((double)i + 0.5) * o->cell, o->y + (high ? length : 0));
            fill(offshore, level->h, level->hv, level->hu, &e, SB_OFFSHORE_Y_MIN + high, time);
        }
}
