/* The given water in a strip: what the source says there, and the outgoing wave that passes. */
#include "sim/sea/strip.h"

#include <math.h>

/* Least depth with which wave speeds are computed, in spacings; steepest ground that the water follows. */
static const double SHALLOW = 1, STEEP = 1;

/* Spacings beside the strip of a neighbouring side over which the weight grows. */
static const double TAPER = 3;

/* Distance from a place beside a side to the strip of the nearest neighbouring side, and that side; negative: in the
 * strip. */
static double to_neighbour(const sb_sim *sim, const sb_strip_side *s, double along, int *side)
{
    const int low = 2 * s->other, high = low + 1;
    const sb_model_sea *sea = sim->model->sea;
    const double length = sea[s->side].pitch * (double)s->columns;
    const double from_low = sea[low].along > 0 ? along - sea[low].strip : HUGE_VAL;
    const double from_high = sea[high].along > 0 ? length - sea[high].strip - along : HUGE_VAL;
    *side = from_low <= from_high ? low : high;
    return fmin(from_low, from_high);
}

double sb_strip_free_part(const sb_sim *sim, const sb_strip_side *s, double along)
{
    const double within = TAPER * sim->scene->resolution;
    int side;
    if (sim->constant.dimension == 2) return 1;
    const double from = fmin(to_neighbour(sim, s, along, &side), within);
    return from <= 0 ? 0 : 0.5 * (1 - cos(M_PI * from / within));
}

/* Cell of a coordinate in cell lengths, and the fraction of the way to the centre of the next. */
static size_t cell_of(double at, size_t cells, double *fraction)
{
    const double place = fmin(fmax(at - 0.5, 0), (double)(cells - 1));
    const size_t cell = (size_t)fmin(floor(place), (double)(cells > 1 ? cells - 2 : 0));
    *fraction = cells > 1 ? place - (double)cell : 0;
    return cell;
}

/* The ground, and how it rises inwards and along the side. */
static double ground_at(const sb_sim *sim, const sb_strip_side *s, double inwards, double along, double slope[2])
{
    const sb_model_sea *g = &sim->model->sea[s->side];
    double a, b;
    const size_t i = cell_of(inwards / g->step, g->across, &a), j = cell_of(along / g->pitch, g->along, &b);
    const double *near = g->bed + j * g->across + i, *next = g->along > 1 ? near + g->across : near;
    const double rise[2] = {near[1] - near[0], next[1] - next[0]};
    const double low = near[0] + a * rise[0], high = next[0] + a * rise[1];
    slope[0] = inwards > 0 ? ((1 - b) * rise[0] + b * rise[1]) / g->step : 0;
    slope[1] = g->along > 1 ? (high - low) / g->pitch : 0;
    return low + b * (high - low);
}

double sb_strip_bed(const sb_sim *sim, const sb_strip_side *s, double inwards, double along)
{
    double slope[2];
    return ground_at(sim, s, inwards, along, slope);
}

/* The outgoing wave between two stations. In a corner of two seas there is none: what one side adds across it the other
   would have to add along it. */
static sb_outgoing outgoing_at(const sb_sim *sim, const sb_strip_side *s, double along)
{
    double f;
    const double free = sb_strip_free_part(sim, s, along);
    const size_t k = cell_of((along - s->station_from) / s->station_pitch, s->stations, &f);
    const sb_outgoing *a = &s->station[k], *b = s->stations > 1 ? a + 1 : a;
    return (sb_outgoing){.value = free * (a->value + f * (b->value - a->value)),
                         .rate = free * (a->rate + f * (b->rate - a->rate)),
                         .curvature = free * (a->curvature + f * (b->curvature - a->curvature)),
                         .late = {a->late.delay + f * (b->late.delay - a->late.delay),
                                  free * (a->late.value + f * (b->late.value - a->late.value)),
                                  free * (a->late.rate + f * (b->late.rate - a->late.rate)),
                                  free * (a->late.curvature + f * (b->late.curvature - a->late.curvature))}};
}

/* What the outgoing wave of a side adds at a place where long waves have this speed: m/s, and 1/s^n. */
typedef struct passing {
    double value, disperse; /* of u - 2 sqrt(g h), and the correction by dispersion */
    double gradient;        /* du/dn, n inwards */
    double curvature;       /* d2u/dn2 */
} passing;

/* The wave is measured farther inwards, so that it comes later here. */
static passing passing_at(const sb_strip_side *s, const sb_outgoing *w, double inwards, double depth, double g)
{
    const double speed = sqrt(g * depth);
    return (passing){.value = w->value - (s->strip - inwards) / speed * w->rate,
                     .disperse = depth / (12 * g) * w->curvature,
                     .gradient = 0.5 * w->rate / speed,
                     .curvature = 0.5 * w->curvature / (g * depth)};
}

/* Velocity inwards at a height above the ground. */
static double inward_velocity(const passing *p, double depth, double height)
{
    return 0.5 * (p->value + p->disperse) + p->curvature * (depth * depth / 6 - 0.5 * height * height);
}

/* Water follows the ground where it rises. */
static double along_ground(const double velocity[3], const sb_strip_side *s, const double slope[2])
{
    const double sign = s->side % 2 ? -1 : 1;
    return sign * velocity[s->axis] * fmin(fmax(slope[0], -STEEP), STEEP) +
           velocity[s->other] * fmin(fmax(slope[1], -STEEP), STEEP);
}

void sb_strip_total(const sb_sim *sim, const sb_strip_side *s, double later, double inwards, double along,
                    sb_column *water)
{
    const double g = (double)sim->constant.gravity, depth_in = fmax(water->depth, SHALLOW * sim->scene->resolution);
    const sb_late w = outgoing_at(sim, s, along).late;
    const double long_wave = sqrt(g * depth_in), line = s->strip - s->far;
    /* Over the few cells beside the line the wave goes with the speed of its crest: that of a solitary wave with
       dispersion, and of a simple wave without. */
    const double crest = fmax(long_wave - (sim->scene->offshore.dispersion ? 0.25 : 0.75) * w.value, 0.5 * long_wave);
    const double delay = (line - inwards) / crest + s->far / long_wave - w.delay - later;
    const passing p = {.value = w.value - delay * w.rate + 0.5 * delay * delay * w.curvature,
                       .disperse = depth_in / (12 * g) * w.curvature};
    const double speed = fmax(sqrt(g * depth_in) - 0.25 * (p.value - p.disperse), 0);
    water->depth = speed * speed / g;
    water->inwards += 0.5 * (p.value + p.disperse);
    water->pressure = -depth_in * depth_in / 6 * sqrt(depth_in / g) * w.curvature;
}

void sb_strip_source(const sb_sim *sim, const sb_strip_side *s, double t, sb_vec3 at, double bed, sb_sea_point *out)
{
    if (sim->scene->given.source == SB_GIVEN_NONE || sb_scene_given_side(sim->scene, s->side))
        sb_sea_at(sim->strip->sea, t, at.x, at.y, at.z, bed, out);
    else
        *out = (sb_sea_point){.surface = sim->scene->given.level};
}

static double between(double a, double b, double share)
{
    return a + share * (b - a);
}

/* The source's water beside a side. Where a still side meets a given one, the water in the corner is the given one: a
   wave that comes in through the given side is there, too, and none is measured in a corner. */
static void source_at(const sb_sim *sim, const sb_strip_side *s, double t, sb_vec3 at, double along, double bed,
                      sb_sea_point *out)
{
    const double free = sb_strip_free_part(sim, s, along);
    int side;
    sb_sea_point given;
    sb_strip_source(sim, s, t, at, bed, out);
    if (free >= 1 || sb_scene_given_side(sim->scene, s->side)) return;
    to_neighbour(sim, s, along, &side);
    if (!sb_scene_given_side(sim->scene, side)) return;
    sb_sea_at(sim->strip->sea, t, at.x, at.y, at.z, bed, &given);
    out->surface = between(given.surface, out->surface, free);
    for (int k = 0; k < 3; k++) {
        out->velocity[k] = between(given.velocity[k], out->velocity[k], free);
        out->acceleration[k] = between(given.acceleration[k], out->acceleration[k], free);
    }
}

void sb_strip_given(const sb_sim *sim, const sb_strip_side *s, double t, double inwards, double along, double z,
                    sb_given *out)
{
    const double g = (double)sim->constant.gravity, least = SHALLOW * sim->scene->resolution;
    double slope[2];
    const double bed = ground_at(sim, s, inwards, along, slope);
    sb_vec3 at = sb_model_sea_place(sim->model, s->side, inwards, along);
    sb_sea_point in, top;
    at.z = z;
    source_at(sim, s, t, at, along, bed, &in);
    at.z = in.surface;
    source_at(sim, s, t, at, along, bed, &top);
    const double depth_in = fmax(in.surface - bed, least);
    const sb_outgoing w = outgoing_at(sim, s, along);
    const passing p = passing_at(s, &w, inwards, depth_in, g);
    const double speed = fmax(sqrt(g * depth_in) - 0.25 * (p.value - p.disperse), 0), depth = speed * speed / g;
    const double height = fmin(fmax(z - bed, 0), depth);
    *out = (sb_given){.velocity = {in.velocity[0], in.velocity[1], in.velocity[2]}, .bed = bed};
    out->velocity[s->axis] += (s->side % 2 ? -1 : 1) * inward_velocity(&p, depth, height);
    out->velocity[2] -= height * p.gradient;
    out->velocity[2] += depth > 0 ? (1 - height / depth) * along_ground(out->velocity, s, slope) : 0;
    if (sim->constant.dimension == 2) out->velocity[1] = 0;
    out->surface = in.surface > bed || depth > 2 * least ? bed + depth : in.surface;
    /* The vertical acceleration grows linearly with the height above the ground. */
    const double lift = top.acceleration[2] - depth * p.curvature * sqrt(g * depth_in);
    const double added = depth > 0 ? lift * (depth * depth - height * height) / (2 * depth) : 0;
    out->pressure = fmax(sim->scene->fluid.density * (g * (depth - height) + added), 0);
}
