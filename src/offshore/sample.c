/* The water at a place. */
#include "offshore/state.h"

#include <math.h>

/* Cell below a coordinate in cells, and the fraction of the way to the next one; clamped to the grid. */
static size_t locate(double coordinate, size_t count, double *fraction)
{
    const double place = fmin(fmax(coordinate - 0.5, 0), (double)(count - 1));
    const size_t low = place >= (double)(count - 1) && count > 1 ? count - 2 : (size_t)place;
    *fraction = place - (double)low;
    return low;
}

sb_offshore_corners sb_offshore_around(const sb_offshore *offshore, double x, double y)
{
    const sb_offshore_options *o = &offshore->options;
    double fx, fy = 0;
    const size_t i = locate((x - o->x) / o->cell, o->columns, &fx);
    const size_t j = sb_offshore_flat(offshore) ? 0 : locate((y - o->y) / o->cell, o->rows, &fy);
    const size_t at = offshore->origin + j * offshore->stride + i;
    const size_t up = sb_offshore_flat(offshore) ? 0 : offshore->stride;
    return (sb_offshore_corners){.column = i,
                                 .row = j,
                                 .at = {at, at + 1, at + up, at + up + 1},
                                 .weight = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

/* Dry cells take part with the mean surface of the wet ones; where this is below the ground, the place is dry. Its
   surface is then this one, or `lowest` without a wet cell. */
static sb_offshore_water mix(const sb_offshore *offshore, const sb_offshore_level *level, const sb_offshore_corners *c,
                             double ground, double lowest, bool *wet)
{
    const double dry = offshore->options.dry_depth;
    sb_offshore_water sum = {0};
    double weight = 0, h = 0, hu = 0, hv = 0;
    for (int k = 0; k < 4; k++) {
        const size_t at = c->at[k];
        h += c->weight[k] * level->h[at];
        hu += c->weight[k] * level->hu[at];
        hv += c->weight[k] * level->hv[at];
        if (!(level->h[at] > dry)) continue;
        weight += c->weight[k];
        sum.surface += c->weight[k] * (level->h[at] + offshore->bed[at]);
    }
    *wet = weight > 0 && sum.surface / weight > ground;
    if (!*wet) return (sb_offshore_water){.surface = weight > 0 ? sum.surface / weight : lowest};
    return (sb_offshore_water){
        .surface = sum.surface / weight, .u = sb_offshore_velocity(hu, h, dry), .v = sb_offshore_velocity(hv, h, dry)};
}

static double bed_of(const sb_offshore *offshore, const sb_offshore_corners *c)
{
    double bed = 0;
    for (int k = 0; k < 4; k++) bed += c->weight[k] * offshore->bed[c->at[k]];
    return bed;
}

static sb_offshore_sample mix_both(const sb_offshore *offshore, const sb_offshore_corners *c, double bed, double ground)
{
    sb_offshore_sample sample = {.time = {offshore->before_time, offshore->time}, .bed = bed};
    const double lowest = fmin(ground, bed);
    sample.water[0] = mix(offshore, &offshore->before, c, ground, lowest, &sample.wet[0]);
    sample.water[1] = mix(offshore, &offshore->now, c, ground, lowest, &sample.wet[1]);
    return sample;
}

static void find_rate(sb_offshore_sample *s)
{
    const double dt = s->time[1] - s->time[0];
    if (dt > 0)
        s->rate = (sb_offshore_water){(s->water[1].surface - s->water[0].surface) / dt,
                                      (s->water[1].u - s->water[0].u) / dt, (s->water[1].v - s->water[0].v) / dt};
}

sb_offshore_sample sb_offshore_at(const sb_offshore *offshore, double x, double y)
{
    const sb_offshore_corners c = sb_offshore_around(offshore, x, y);
    const double bed = bed_of(offshore, &c);
    sb_offshore_sample sample = mix_both(offshore, &c, bed, bed);
    for (int k = 0; k < 2; k++)
        if (!sample.wet[k]) sample.water[k].surface = bed;
    find_rate(&sample);
    return sample;
}

sb_offshore_sample sb_offshore_over(const sb_offshore *offshore, double x, double y, double ground)
{
    const sb_offshore_corners c = sb_offshore_around(offshore, x, y);
    sb_offshore_sample sample = mix_both(offshore, &c, bed_of(offshore, &c), ground);
    find_rate(&sample);
    return sample;
}
