/* Run-up along a line: the highest point and the front of the water that is connected with the water at the line's
   start.

   Two particles are connected if a chain of particles with distances below the support radius h joins them: particles
   farther apart exert no forces on each other. The chain continues only from a particle that has at least as many
   others within h as half a layer of water has. A film too thin to be resolved (or drops that happen to fly in a row)
   therefore ends the run-up and counts as unconnected water. Otherwise the front would be erratic: a film of a quarter
   of a layer breaks and closes at random, and the front would jump by hundreds of spacings from row to row.

   The highest point is that of the water which wets something: of the particles at most 1.5 spacings from the ground or
   a wall, by the places of its boundary particles on the surface. Water that is thrown up at a wall beyond its crest,
   the crest of a wave in deeper water, and the upper layers of a flow over land are connected, but wet nothing.

   The connected water begins within h of the line's first end or before it, on the line's extension to the domain's
   side. On a line that starts on land the run-up is that of the sea before the line, and there is none until that water
   arrives. If there is no water before the line, for instance because the line starts behind a wave maker, the largest
   body of water along the line is used. */
#include "base/memory.h"
#include "measure/parts.h"

#include <stdlib.h>

/* Half-width of the strip in support radii within which connected water may flow around a gap in the line. */
static const double STRIP = 2;

/* Distance from the ground or a wall at which a particle wets it, in spacings. */
static const double WETS = 1.5;

/* The line in plan. */
typedef struct course {
    double ax, ay, length, ux, uy; /* first end, m, unit direction */
    double before;                 /* m from the first end back to the domain's side */
} course;

/* Distance from a point against the direction u to the side of [min, max]; HUGE_VAL if u is 0. */
static double back_to_side(double place, double u, double min, double max)
{
    if (u > 0) return (place - min) / u;
    return u < 0 ? (place - max) / u : HUGE_VAL;
}

static course line_of(const sb_scene *scene, const sb_runup_line *line)
{
    bool flat = scene->dimensions == 2;
    double dx = line->bx - line->ax, dy = flat ? 0 : line->by - line->ay, length = hypot(dx, dy);
    return (course){line->ax, flat ? 0 : line->ay, length, dx / length, dy / length, 0};
}

static course course_of(const sb_measure_view *view, const sb_runup_line *line)
{
    course c = line_of(view->scene, line);
    double before =
        fmin(back_to_side(c.ax, c.ux, view->min.x, view->max.x), back_to_side(c.ay, c.uy, view->min.y, view->max.y));
    c.before = fmax(before, 0); /* a line may start outside */
    return c;
}

/* Distance along the line from its first end, m. */
static double along(const course *c, sb_vec3 at)
{
    return (at.x - c->ax) * c->ux + (at.y - c->ay) * c->uy;
}

/* Distance along the line to its point nearest to `at`, limited to the part from `first` to the line's end. */
static double nearest_along(const course *c, sb_vec3 at, double first)
{
    return fmin(fmax(along(c, at), first), c->length);
}

static double distance_to(const course *c, sb_vec3 at, double first)
{
    double t = nearest_along(c, at, first);
    return hypot(at.x - c->ax - t * c->ux, at.y - c->ay - t * c->uy);
}

/* Adds the particles within `width` of the line whose nearest point, not before `first`, lies from `start` to `end`. */
static sb_status add_part(const sb_measure_view *view, const course *c, double first, double start, double end,
                          double width, sb_error *error)
{
    double x0 = c->ax + start * c->ux, x1 = c->ax + end * c->ux, y0 = c->ay + start * c->uy, y1 = c->ay + end * c->uy;
    double spacing = view->scene->resolution;
    sb_vec3 min = sb_vec(fmin(x0, x1) - width, fmin(y0, y1) - width, view->min.z - spacing);
    sb_vec3 max = sb_vec(fmax(x0, x1) + width, fmax(y0, y1) + width, view->max.z + spacing);
    sb_cloud *cloud = view->cloud;
    size_t kept = cloud->count;
    sb_status status = sb_cloud_add(cloud, view->sim, min, max, view->lag, error);
    if (status != SB_OK) return status;
    for (size_t i = kept; i < cloud->count; i++) {
        sb_vec3 place = cloud->samples[i].position;
        double t = nearest_along(c, place, first);
        bool here = t >= start && (t < end || end == c->length);
        if (here && distance_to(c, place, first) <= width) cloud->samples[kept++] = cloud->samples[i];
    }
    cloud->count = kept;
    return SB_OK;
}

/* Limits the part [*start, *end] of the line to what is within [min, max] in one direction. */
static void clip(double place, double u, double min, double max, double *start, double *end)
{
    if (u == 0) return;
    const double a = (min - place) / u, b = (max - place) / u;
    *start = fmax(*start, fmin(a, b));
    *end = fmin(*end, fmax(a, b));
}

/* Fills the cloud with the particles within `width` of the line from `first` on. The line is divided into parts with a
   box each, because a single box around an oblique line could contain most of the scene. Far beyond the domain there
   are none. */
static sb_status query_along(const sb_measure_view *view, const course *c, double first, double width, sb_error *error)
{
    const double parts = ceil((c->length - first) / (8 * width)), beyond = 2 * width;
    double start = first, end = c->length;
    clip(c->ax, c->ux, view->min.x - beyond, view->max.x + beyond, &start, &end);
    clip(c->ay, c->uy, view->min.y - beyond, view->max.y + beyond, &start, &end);
    const double part = (c->length - first) / parts, last = fmin(ceil((end - first) / part), parts);
    sb_status status = SB_OK;
    view->cloud->count = 0;
    for (double k = floor((start - first) / part); status == SB_OK && k < last; k++) {
        const double from = first + k / parts * (c->length - first);
        const double to = k + 1 < parts ? first + (k + 1) / parts * (c->length - first) : c->length;
        status = add_part(view, c, first, from, to, width, error);
    }
    return status;
}

/* Number of other particles within the support radius in half a layer: half of a disc of a lattice, in 2D of a line. */
static size_t half_a_layer(const sb_scene *scene)
{
    double s = scene->numerics.support;
    return (size_t)ceil(scene->dimensions == 2 ? s : M_PI / 2 * s * s) - 1;
}

/* Whether there is any water between the first end and the domain's side before it. Overwrites the cloud. */
static sb_status find_water_before(const sb_measure_view *view, const course *c, double width, bool *any,
                                   sb_error *error)
{
    course back = {c->ax, c->ay, c->before, -c->ux, -c->uy, 0};
    sb_status status = c->before > 0 ? query_along(view, &back, 0, width, error) : SB_OK;
    *any = false;
    for (size_t i = 0; status == SB_OK && c->before > 0 && i < view->cloud->count; i++)
        *any = *any || along(c, view->cloud->samples[i].position) <= 0;
    return status;
}

/* Fills the cloud with the water around the line and marks what is connected with the water at the line's start. */
static sb_status mark_connected(const sb_measure_view *view, const course *c, sb_error *error)
{
    sb_cloud *cloud = view->cloud;
    double spacing = view->scene->resolution, support = view->scene->numerics.support * spacing;
    double width = spacing + STRIP * support;
    bool any = false, before = false;
    sb_status status = query_along(view, c, -support, width, error);
    if (status == SB_OK) status = sb_cloud_unmark(cloud, error);
    for (size_t i = 0; status == SB_OK && i < cloud->count; i++) {
        cloud->marks[i] = along(c, cloud->samples[i].position) <= support;
        any = any || cloud->marks[i];
    }
    if (status != SB_OK || cloud->count == 0) return status;
    if (!any) {
        status = find_water_before(view, c, width, &before, error);
        if (status == SB_OK) status = query_along(view, c, -support, width, error); /* the cloud was overwritten */
        if (status == SB_OK) status = sb_cloud_unmark(cloud, error);
        if (status == SB_OK && !before) status = sb_cloud_mark_largest(cloud, SB_LINK * spacing, error);
    }
    return status == SB_OK ? sb_cloud_spread(cloud, support, half_a_layer(view->scene), error) : status;
}

/* A particle on the line: its distance along the line, m, and whether it is connected. */
typedef struct line_particle {
    double at;
    bool connected;
} line_particle;

static line_particle line_particle_of(const sb_fluid_sample *sample)
{
    return (line_particle){sample->pressure, sample->density > 0};
}

static int compare_along(const void *left, const void *right)
{
    const sb_fluid_sample *a = left, *b = right;
    return (a->pressure > b->pressure) - (a->pressure < b->pressure);
}

static int compare_points(const void *left, const void *right)
{
    const sb_shore_point *a = left, *b = right;
    return (a->along > b->along) - (a->along < b->along);
}

/* How far from the line particles count, and the surface beside these, m. */
static double shore_reach(const sb_scene *scene)
{
    return (1 + WETS) * scene->resolution;
}

sb_model_place sb_shore_place(const sb_scene *scene, const sb_runup_line *line)
{
    const course c = line_of(scene, line);
    const double more = scene->numerics.support * scene->resolution; /* before the first end, particles count, too */
    return (sb_model_place){.at = sb_vec(c.ax - more * c.ux, c.ay - more * c.uy, 0),
                            .to = sb_vec(c.ax + c.length * c.ux, c.ay + c.length * c.uy, 0),
                            .range = shore_reach(scene) + scene->numerics.wall_offset * scene->resolution,
                            .column = true};
}

sb_status sb_shore_find(const sb_scene *scene, const sb_model *model, const sb_runup_line *line, sb_shore *shore,
                        sb_error *error)
{
    const course c = line_of(scene, line);
    const double reach = shore_reach(scene), first = -scene->numerics.support * scene->resolution;
    const double offset = scene->numerics.wall_offset * scene->resolution;
    for (size_t b = 0; b < model->body_count && model->wall_normal; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (body->wavemaker >= 0) continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            const sb_vec3 at = sb_madd(model->wall_position[i], offset, model->wall_normal[i]);
            if (!(distance_to(&c, at, first) <= reach)) continue;
            if (sb_grow((void **)&shore->points, &shore->capacity, shore->count + 1, sizeof *shore->points) != 0)
                return sb_fail_memory(error, "the ground of run-up lines");
            shore->points[shore->count++] = (sb_shore_point){along(&c, at), at};
        }
    }
    if (shore->count > 1) qsort(shore->points, shore->count, sizeof *shore->points, compare_points);
    return SB_OK;
}

void sb_shore_free(sb_shore *shore)
{
    sb_free(shore->points);
    *shore = (sb_shore){0};
}

/* Whether a particle wets the ground or a wall: it is within `reach` of it. */
static bool wets(const sb_shore *shore, const course *c, sb_vec3 place, double reach)
{
    const double from = along(c, place) - reach;
    size_t low = 0, high = shore->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (shore->points[middle].along < from)
            low = middle + 1;
        else
            high = middle;
    }
    for (size_t i = low; i < shore->count && shore->points[i].along <= from + 2 * reach; i++) {
        const sb_vec3 d = sb_sub(place, shore->points[i].at);
        if (sb_dot(d, d) < reach * reach) return true;
    }
    return false;
}

/* The highest connected particle within one spacing of the line, which begins at `first`, that wets something; NaN:
   none. */
static sb_vec3 highest(const sb_measure_view *view, const course *c, const sb_shore *shore, double first)
{
    const sb_cloud *cloud = view->cloud;
    const double none = (double)NAN, spacing = view->scene->resolution;
    sb_vec3 best = sb_vec(none, none, none);
    for (size_t i = 0; i < cloud->count; i++) {
        const sb_vec3 place = cloud->samples[i].position;
        if (!cloud->marks[i] || !(distance_to(c, place, first) <= spacing) || place.z <= best.z) continue;
        if (!shore || wets(shore, c, place, WETS * spacing)) best = place;
    }
    return best;
}

/* Keeps the particles within one spacing of the line, sorted along it, in the form that line_particle_of reads. */
static void keep_line(sb_cloud *cloud, const course *c, double spacing)
{
    size_t kept = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        sb_fluid_sample sample = cloud->samples[i];
        if (!(distance_to(c, sample.position, 0) <= spacing)) continue;
        sample.pressure = along(c, sample.position);
        sample.density = cloud->marks[i] ? 1 : 0;
        cloud->samples[kept++] = sample;
    }
    cloud->count = kept;
    if (kept > 1) qsort(cloud->samples, kept, sizeof *cloud->samples, compare_along);
}

/* Length of the line, m, that unconnected particles cover and connected ones do not. Each particle covers `half` to
   both sides. */
static double length_apart(const sb_cloud *cloud, const course *c, double half)
{
    double sum = 0, covered = 0, last = -HUGE_VAL;
    size_t next = 0; /* index of the next connected particle */
    for (size_t i = 0; i < cloud->count; i++) {
        const line_particle w = line_particle_of(&cloud->samples[i]);
        if (w.connected) {
            last = w.at;
            continue;
        }
        while (next < cloud->count && (next <= i || !line_particle_of(&cloud->samples[next]).connected)) next++;
        double from = fmax(fmax(covered, w.at - half), last + half);
        double to = fmin(w.at + half, c->length);
        if (next < cloud->count) to = fmin(to, line_particle_of(&cloud->samples[next]).at - half);
        if (!(to > from)) continue;
        sum += to - from;
        covered = to;
    }
    return sum;
}

sb_status sb_runup_read(const sb_measure_view *view, const sb_runup_line *line, const sb_shore *shore,
                        sb_runup_record *record, sb_error *error)
{
    const double spacing = view->scene->resolution, half = 0.5 * spacing;
    const course c = course_of(view, line);
    sb_cloud *cloud = view->cloud;
    sb_status status = mark_connected(view, &c, error);
    if (status != SB_OK) return status;
    sb_vec3 place = highest(view, &c, shore, 0);
    if (isnan(place.z)) place = highest(view, &c, shore, -view->scene->numerics.support * spacing);
    keep_line(cloud, &c, spacing);
    double front = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        const line_particle p = line_particle_of(&cloud->samples[i]);
        if (p.connected) front = fmin(p.at + half, c.length);
    }
    record->place = sb_vec(place.x, place.y, place.z + half); /* the upper face of that particle's volume */
    record->front = cloud->count == 0 && isnan(place.z) ? (double)NAN : fmax(front, 0);
    record->apart = length_apart(cloud, &c, half);
    return SB_OK;
}
