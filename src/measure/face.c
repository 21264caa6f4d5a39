/* The depth of the flow towards a body's faces in particle spacings. It decides whether the body's force is reliable.

   The flow is read before it is changed by the face: in a strip between one and two support radii before the face, so
   that the splash on the face does not count. Of the depths of all columns of the strip at all instants the mean is
   taken, weighted with their momentum flux towards the face. Water that a wall has thrown back stands or moves away,
   and hardly counts. */
#include "base/memory.h"
#include "measure/parts.h"

static sb_footprint footprint_of_one(const sb_model *model, size_t body)
{
    const sb_model_body *of = &model->bodies[body];
    sb_footprint footprint = {{0, 0, 0}, {0, 0, 0}};
    if (model->walls.divided) return (sb_footprint){of->low, of->high};
    for (size_t i = of->begin; i < of->begin + of->count; i++) {
        sb_vec3 p = model->wall_position[i];
        footprint.min = i == of->begin ? p : sb_min(footprint.min, p);
        footprint.max = i == of->begin ? p : sb_max(footprint.max, p);
    }
    return footprint;
}

sb_footprint sb_footprint_of(const sb_model *model, size_t body)
{
    sb_footprint all = footprint_of_one(model, body);
    const size_t plates = model->bodies[body].plate == 0 ? model->bodies[body].plates : 0;
    for (size_t b = body + 1; b < body + plates; b++) {
        const sb_footprint one = footprint_of_one(model, b);
        all = (sb_footprint){sb_min(all.min, one.min), sb_max(all.max, one.max)};
    }
    return all;
}

/* Columns of the strip are as wide as this, in spacings. */
#define PATCH 2.0

/* Water at rest counts as if it moved at the root of this times sqrt(g D). It matters only where no flow comes. */
#define AT_REST 1e-6

/* The water of one column of the strip. */
typedef struct column {
    double count, speed; /* particles; sum of their speeds towards the face, m/s */
} column;

/* Distributes the part `within` of a particle of width `size` at t (both in columns) over the columns that it covers.
   Counting whole particles would alias with the columns. */
static void distribute(column *columns, size_t count, double t, double size, double within, double speed)
{
    double first = t - size / 2, last = t + size / 2;
    for (size_t k = first > 0 ? (size_t)first : 0; k < count && (double)k < last; k++) {
        const double share = within * (count == 1 ? 1 : (fmin(last, (double)k + 1) - fmax(first, (double)k)) / size);
        columns[k].count += share;
        columns[k].speed += share * speed;
    }
}

/* One side of the footprint. along = 0: it lies along y at x = place; 1: along x at y = place. */
typedef struct side {
    int along;
    double place, from, to; /* m */
    double near, far;       /* m, the strip's distances from the boundary particles */
} side;

/* Adds the columns of particles with a total weight of N u^2 each, where u is their mean speed towards the face. */
static void add_columns(const sb_measure_view *view, const column *columns, size_t count, double area, sb_approach *sum)
{
    const double spacing = view->scene->resolution, volume = spacing * spacing;
    for (size_t k = 0; k < count; k++) {
        if (columns[k].count == 0) continue;
        const double layers = columns[k].count * volume / area, speed = fmax(columns[k].speed / columns[k].count, 0);
        const double weight =
            columns[k].count * (speed * speed + AT_REST * view->scene->fluid.gravity * layers * spacing);
        sum->weight += weight;
        sum->layers += weight * layers;
    }
}

/* Adds the water before one side. The strip lies on both sides of the boundary particles: outside of a building, inside
   of a tank. Only one of them is wet, so that the two cases need no distinction. */
static sb_status add_side(const sb_measure_view *view, const sb_footprint *f, const side *s, sb_approach *sum,
                          sb_error *error)
{
    const bool flat = view->scene->dimensions == 2;
    const double spacing = view->scene->resolution, length = flat ? 0 : s->to - s->from, patch = PATCH * spacing;
    const double range = s->far + 0.5 * spacing;
    sb_vec3 min = s->along ? sb_vec(s->from, s->place - range, 0) : sb_vec(s->place - range, s->from, 0);
    sb_vec3 max = s->along ? sb_vec(s->to, s->place + range, 0) : sb_vec(s->place + range, s->to, 0);
    min.z = fmin(view->min.z, f->min.z) - spacing;
    max.z = view->max.z + spacing;
    if (flat) {
        min.y = -spacing;
        max.y = spacing;
    }
    sb_status status = sb_cloud_query(view->cloud, view->sim, min, max, view->lag, error);
    if (status != SB_OK || view->cloud->count == 0) return status;
    const size_t count = length < patch ? 1 : (size_t)(length / patch);
    const double width = flat ? spacing : length < patch ? patch : length / (double)count;
    column *columns = sb_alloc(2 * count, sizeof *columns);
    if (!columns) return sb_fail_memory(error, "flow depth at faces");
    for (size_t i = 0; i < view->cloud->count; i++) {
        const sb_vec3 p = view->cloud->samples[i].position, v = view->cloud->samples[i].velocity;
        const double away = (s->along ? p.y : p.x) - s->place, speed = s->along ? v.y : v.x;
        const double begin = fmax(fabs(away) - 0.5 * spacing, s->near), end = fmin(fabs(away) + 0.5 * spacing, s->far);
        if (end <= begin) continue;
        distribute(columns + (away > 0 ? count : 0), count, flat ? 0 : ((s->along ? p.x : p.y) - s->from) / width,
                   spacing / width, (end - begin) / spacing, away > 0 ? -speed : speed);
    }
    add_columns(view, columns, 2 * count, width * (s->far - s->near), sum);
    sb_free(columns);
    return SB_OK;
}

sb_status sb_face_approach(const sb_measure_view *view, const sb_footprint *footprint, sb_vec3 displacement,
                           sb_approach *sum, sb_error *error)
{
    const sb_numerics *n = &view->scene->numerics;
    const double near = (n->wall_offset + n->support) * view->scene->resolution;
    const double far = near + n->support * view->scene->resolution;
    const sb_footprint f = {sb_add(footprint->min, displacement), sb_add(footprint->max, displacement)};
    const side sides[] = {{0, f.min.x, f.min.y, f.max.y, near, far},
                          {0, f.max.x, f.min.y, f.max.y, near, far},
                          {1, f.min.y, f.min.x, f.max.x, near, far},
                          {1, f.max.y, f.min.x, f.max.x, near, far}};
    sb_status status = SB_OK;
    for (int k = 0; k < (view->scene->dimensions == 3 ? 4 : 2) && status == SB_OK; k++)
        status = add_side(view, &f, &sides[k], sum, error);
    return status;
}
