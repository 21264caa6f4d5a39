/* The outgoing wave inside of a strip. Its characteristic u - 2 sqrt(g h) is that of the water there less that of the
   given water at the same place. A filter of second order makes of it the wave at the strip's inner edge. */
#include "physics/absorption/outgoing.h"
#include "sim/exchange/exchange.h"
#include "sim/sea/strip.h"

#include <math.h>

/* Sums are integers in these parts, so that they do not depend on the order: of a weight, and of weight times velocity
   over the wave speed. */
static const double PARTS = 0x1p30;

/* Samples of the given water across the length over which the water is averaged, and over its depth. */
enum { ACROSS = 7, OVER_DEPTH = 3 };
static const double gauss_at[OVER_DEPTH] = {0.1127016653792583, 0.5, 0.8872983346207417};
static const double gauss_weight[OVER_DEPTH] = {5 / 18.0, 8 / 18.0, 5 / 18.0};

/* A station with less water than LEAST_DEPTH spacings, or whose share would be beyond SHARE_MIN or its inverse, has no
   outgoing wave. */
static const double LEAST_DEPTH = 1.5, SHARE_MIN = 0.8;

/* Frequency over sqrt(g/h) of the filter for the wave at the line of a grid, which the measured water does not feel;
   least delay, in time steps. */
static const double AT_LINE = 4, LEAST_DELAY = 4;

/* Weight at a distance from the centre of the averaged length. */
static double weight_at(double distance, double reach)
{
    return fabs(distance) < reach ? 0.5 * (1 + cos(M_PI * distance / reach)) : 0;
}

static double reach_of(const sb_sim *sim)
{
    return sb_model_sea_reach(sim->model, sim->model->still_depth);
}

/* Weight along the side: falls to 0 at the neighbouring stations. */
static double share_along(const sb_sim *sim, const sb_strip_side *s, size_t station, double along)
{
    const double at = (along - s->station_from) / s->station_pitch, from = fabs(at - ((double)station + 0.5));
    const bool end = (station == 0 && at < 0.5) || (station + 1 == s->stations && at > (double)s->stations - 0.5);
    if (sim->constant.dimension == 2) return 1;
    return sb_strip_free_part(sim, s, along) * (end || s->stations == 1 ? 1 : fmax(1 - from, 0));
}

/* Adds a particle to the stations beside it. */
static void add_particle(sb_sim *sim, const sb_strip_side *s, size_t i)
{
    const sb_record at = sim->state.position[i];
    const double inwards = (double)sb_strip_inwards(s, at) * sim->space.quantum;
    const double reach = reach_of(sim), across = weight_at(inwards - s->strip - reach, reach);
    if (!(across > 0)) return;
    const double along = sb_strip_along(sim, s, at);
    const double scale = PARTS / (double)sim->constant.wave_speed;
    const size_t first =
        (size_t)fmin(fmax(floor((along - s->station_from) / s->station_pitch - 0.5), 0), (double)(s->stations - 1));
    for (size_t k = first; k < first + 2 && k < s->stations; k++) {
        const double w = across * share_along(sim, s, k, along);
        const sb_f4 v = sim->state.velocity[i];
        const double u = s->side % 2 ? -(double)v[s->axis] : (double)v[s->axis];
        const double terms[SB_STATION_SUMS] = {w * PARTS, w * u * scale};
        for (size_t n = 0; n < SB_STATION_SUMS; n++)
            __atomic_fetch_add(&s->sums[k * SB_STATION_SUMS + n], (uint64_t)(int64_t)nearbyint(terms[n]),
                               __ATOMIC_RELAXED);
    }
}

static void add_all(sb_sim *sim)
{
    const sb_strip *strip = sim->strip;
    const size_t n = sim->state.n;
    for (size_t k = 0; k < strip->count; k++)
        memset(strip->side[k].sums, 0, strip->side[k].stations * SB_STATION_SUMS * sizeof(int64_t));
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < strip->count; k++) {
            const sb_strip_side *s = &strip->side[k];
            const int64_t inwards = sb_strip_inwards(s, sim->state.position[i]);
            const double farthest = s->strip + 2 * reach_of(sim);
            if (inwards < s->width || (double)inwards * sim->space.quantum >= farthest) continue;
            add_particle(sim, s, i);
        }
    for (size_t k = 0; k < strip->count; k++)
        sim->exchange->count(sim, strip->side[k].sums, strip->side[k].stations * SB_STATION_SUMS);
}

/* The volume below a level at a station, weighted, and its derivative: the wet area. */
static double volume_below(const sb_sim *sim, const sb_strip_side *s, size_t station, double level, double *area)
{
    const sb_model_sea *g = &sim->model->sea[s->side];
    const double reach = reach_of(sim), cell = g->step * (sim->constant.dimension == 2 ? 1 : g->pitch);
    double volume = 0;
    *area = 0;
    for (size_t j = 0; j < g->along; j++) {
        const double along = share_along(sim, s, station, ((double)j + 0.5) * g->pitch);
        if (!(along > 0)) continue;
        for (size_t i = 0; i < g->across; i++) {
            const double w = along * weight_at(((double)i + 0.5) * g->step - s->strip - reach, reach) * cell;
            const double depth = level - g->bed[j * g->across + i];
            if (!(w > 0) || !(depth > 0)) continue;
            volume += w * depth;
            *area += w;
        }
    }
    return volume;
}

/* The level at which that volume is `wanted`, from a first guess. */
static double level_of(const sb_sim *sim, const sb_strip_side *s, size_t station, double guess, double wanted)
{
    enum { ROUNDS = 20 };
    const double enough = 1e-9 * sim->scene->resolution;
    double level = guess;
    for (int round = 0; round < ROUNDS; round++) {
        double area;
        const double off = wanted - volume_below(sim, s, station, level, &area);
        if (!(area > 0)) break;
        level += off / area;
        if (fabs(off) < enough * area) break;
    }
    return level;
}

/* Means of the given water over a station. */
typedef struct means {
    double surface, depth, inwards;
} means;

/* Velocities belong to times half a step before the positions to which they lead. */
static means given_means(const sb_sim *sim, const sb_strip_side *s, size_t station)
{
    const double now = sim->state.time, before = now - 0.5 * sim->state.time_step;
    const double reach = reach_of(sim), along = s->station_from + ((double)station + 0.5) * s->station_pitch;
    means m = {0};
    double all = 0;
    for (int k = 0; k < ACROSS; k++) {
        const double from = (2.0 * k + 1 - ACROSS) / ACROSS * reach, w = weight_at(from, reach);
        sb_vec3 at = sb_model_sea_place(sim->model, s->side, s->strip + reach + from, along);
        const double bed = sb_strip_bed(sim, s, s->strip + reach + from, along);
        sb_sea_point p;
        at.z = bed;
        sb_strip_source(sim, s, now, at, bed, &p);
        const double surface = p.surface, depth = fmax(surface - bed, 0);
        for (int n = 0; n < OVER_DEPTH; n++) {
            at.z = bed + gauss_at[n] * depth;
            sb_strip_source(sim, s, before, at, bed, &p);
            m.inwards += w * gauss_weight[n] * (s->side % 2 ? -p.velocity[s->axis] : p.velocity[s->axis]);
        }
        m.surface += w * surface;
        m.depth += w * depth;
        all += w;
    }
    return (means){m.surface / all, m.depth / all, m.inwards / all};
}

/* Advances x + lag x' + inertia x'' = input, which is that of the middle of the step, by the midpoint rule. Returns x''
   there. */
static double filter(double *value, double *rate, double input, double lag, double inertia, double dt)
{
    const double curvature = (input - *value - (lag + 0.5 * dt) * *rate) / (inertia + 0.5 * lag * dt + 0.25 * dt * dt);
    *value += dt * (*rate + 0.5 * dt * curvature);
    *rate += dt * curvature;
    return curvature;
}

/* The wave at the line of a grid, `far` seconds later. A Butterworth filter of its own gives derivatives that are
   smooth, and a part of the delay. The rest is Pade's approximation of second order, (1 - d/2 + d^2/12) / (1 + d/2 +
   d^2/12) with d = delay * d/dt: it changes no amplitude, where a series in the delay is wrong for waves that are
   shorter than the way. With x the wave divided by the denominator, the quotient is the wave less delay * dx/dt. */
static void delay_wave(sb_outgoing *o, double far, double crossing, double dt)
{
    const double time = crossing / AT_LINE, lag = sqrt(2) * time, delay = fmax(far - lag, LEAST_DELAY * dt);
    const double curvature = filter(&o->smooth, &o->smooth_rate, o->value, lag, time * time, dt);
    const double second = filter(&o->part, &o->part_rate, o->smooth, 0.5 * delay, delay * delay / 12, dt);
    const double third = 12 / (delay * delay) * (o->smooth_rate - o->part_rate - 0.5 * delay * second);
    o->late = (sb_late){lag + delay, o->smooth - delay * o->part_rate, o->smooth_rate - delay * second,
                        curvature - delay * third};
}

/* Times that waves need, s: over one depth, and from the strip to the line of a grid (0: there is none). */
typedef struct times {
    double crossing, far;
} times;

/* Advances a station by a step. The wave travels at c - u, c and u those of the water: `pace` is that speed over the c
   of the law. Time for what is between the measured water and the strip runs by this factor, and stands still where no
   wave gets out. rate and curvature are derivatives in this time, so that rate / c is the wave's gradient. */
static void advance(sb_outgoing *o, double now, double pace, const sb_outgoing_law *law, const times *t, double dt)
{
    o->curvature = filter(&o->filtered, &o->rate, now, law->lag, law->inertia, pace * dt);
    /* The boundary adds the dispersion, h/(12 g) of the curvature, which the law's velocity contains. The lead passes
       what is fast at once; less of it counts where the wave takes longer. */
    o->value = o->filtered + fmin(pace, 1) * (law->lead - t->crossing * t->crossing / 12) * o->curvature;
    if (t->far > 0) delay_wave(o, t->far, t->crossing, dt);
}

static void measure_station(sb_sim *sim, const sb_strip_side *s, size_t station)
{
    sb_outgoing *o = &s->station[station];
    const int64_t *sums = (const int64_t *)s->sums + station * SB_STATION_SUMS;
    const double g = (double)sim->constant.gravity, dr = sim->scene->resolution, dt = sim->state.time_step;
    const double particle = sim->constant.dimension == 2 ? dr * dr : dr * dr * dr;
    const double count = (double)sums[0] / PARTS, volume = count * particle;
    const means in = given_means(sim, s, station);
    double area;
    const double still = volume_below(sim, s, station, sim->scene->sea.level, &area), reach = reach_of(sim);
    if (o->share == 0) {
        o->share = sim->strip->still && volume > 0 ? still / volume : 1;
        o->share = o->share > SHARE_MIN && o->share < 1 / SHARE_MIN ? o->share : 1;
    }
    const double water = fmax(in.depth, dr);
    const sb_outgoing_law law = sb_outgoing_law_make(water, reach, 0.25 * dt, g);
    const times t = {sqrt(water / g), s->far / sqrt(g * water)};
    if (!(volume > LEAST_DEPTH * dr * area)) {
        advance(o, 0, 1, &law, &t, dt);
        return;
    }
    const double level = level_of(sim, s, station, in.surface, volume * o->share);
    const double depth = fmax(in.depth + level - in.surface, 0), scale = (double)sim->constant.wave_speed;
    const double u = (double)sums[1] / (double)sums[0] * scale;
    const double now = u - in.inwards - 2 * (sqrt(g * depth) - sqrt(g * in.depth));
    /* Froude number of the flow that comes in. The faster it is, the more of what is measured is the strip's own, which
       must not come back to it: the share 1 - F^2 is from within (docs/decisions/0092). */
    const double c = sqrt(g * fmax(depth, dr)), froude = fmin(fmax(u / c, 0), 1);
    advance(o, now * (1 - froude * froude), fmax(c - u, 0) / sqrt(g * water), &law, &t, dt);
}

sb_status sb_strip_measure(sb_sim *sim, sb_error *error)
{
    (void)error;
    add_all(sim);
    for (size_t k = 0; k < sim->strip->count; k++) {
        const sb_strip_side *s = &sim->strip->side[k];
        const size_t stations = s->stations;
#pragma omp parallel for schedule(static)
        for (size_t station = 0; station < stations; station++) measure_station(sim, s, station);
    }
    return SB_OK;
}
