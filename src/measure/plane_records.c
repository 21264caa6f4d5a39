/* The record of a plane: surface, bed and velocities over depth at points along it, from which a later run can take its
   water. */
#include "base/memory.h"
#include "measure/state.h"

/* Width of the horizontal weight in spacings, as in gauge.c. */
static const double STRETCH = 2;

typedef struct point {
    double x, y, bed;
    sb_floors floors;
} point;

struct sb_plane_record {
    uint64_t every; /* intervals between two rows */
    size_t count;
    point *points; /* in the middles of equal parts of the plane */
};

static sb_status place_points(sb_plane_record *made, const sb_scene *scene, const sb_model *model,
                              const sb_flow_plane *plane, sb_error *error)
{
    const bool flat = scene->dimensions == 2;
    const double length = hypot(plane->bx - plane->ax, plane->by - plane->ay);
    made->count = flat ? 1 : (size_t)fmax(round(length / plane->record_spacing), 1);
    made->points = sb_alloc(made->count, sizeof *made->points);
    if (!made->points) return sb_fail_memory(error, plane->name);
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < made->count; i++) {
        point *p = &made->points[i];
        const double part = ((double)i + 0.5) / (double)made->count;
        p->x = plane->ax + part * (plane->bx - plane->ax);
        p->y = flat ? 0 : plane->ay + part * (plane->by - plane->ay);
        status = sb_floors_find(scene, model, p->x, p->y, &p->floors, error);
        p->bed = p->floors.count > 0 ? p->floors.z[p->floors.count - 1] : model->min.z; /* the ground below all decks */
    }
    return status;
}

static void destroy(sb_plane_record *record)
{
    if (!record) return;
    for (size_t i = 0; record->points && i < record->count; i++) sb_floors_free(&record->points[i].floors);
    sb_free(record->points);
    sb_free(record);
}

sb_status sb_plane_records_create(sb_measure *measure, sb_error *error)
{
    const sb_measure_settings *settings = &measure->scene->measure;
    bool any = false;
    for (size_t i = 0; i < settings->plane_count; i++) any = any || settings->planes[i].record;
    if (!any) return SB_OK;
    measure->records = sb_alloc(settings->plane_count, sizeof(sb_plane_record *));
    if (!measure->records) return sb_fail_memory(error, "the records of planes");
    for (size_t i = 0; i < settings->plane_count; i++) {
        const sb_flow_plane *plane = &settings->planes[i];
        if (!plane->record) continue;
        sb_plane_record *made = measure->records[i] = sb_alloc(1, sizeof *made);
        if (!made) return sb_fail_memory(error, plane->name);
        made->every = (uint64_t)fmax(round(plane->record_interval / settings->interval), 1);
        sb_status status = place_points(made, measure->scene, measure->model, plane, error);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}

void sb_plane_records_destroy(sb_measure *measure)
{
    for (size_t i = 0; measure->records && i < measure->scene->measure.plane_count; i++) destroy(measure->records[i]);
    sb_free(measure->records);
}

size_t sb_plane_records_points(const sb_measure *measure, size_t plane, uint64_t row)
{
    const sb_plane_record *record = measure->records ? measure->records[plane] : NULL;
    return record && row % record->every == 0 ? record->count : 0;
}

/* Weighted sums for a line a + b (z - middle) through the velocities of the particles about a layer. */
typedef struct layer_sums {
    double weight, z, zz;
    sb_vec3 v, zv;
} layer_sums;

/* The velocity at the middle of a layer; NaN without particles. One layer of particles has no slope. */
static sb_vec3 velocity_of(const layer_sums *s, double reach)
{
    if (!(s->weight > 1e-3)) return sb_vec((double)NAN, (double)NAN, (double)NAN);
    const double determinant = s->weight * s->zz - s->z * s->z;
    if (!(determinant > 1e-3 * s->weight * s->weight * reach * reach)) return sb_scale(s->v, 1 / s->weight);
    return sb_scale(sb_sub(sb_scale(s->v, s->zz), sb_scale(s->zv, s->z)), 1 / determinant);
}

static sb_vec3 layer_velocity(const sb_measure_view *view, const point *p, double middle, double reach)
{
    const double width = STRETCH * view->scene->resolution;
    const bool flat = view->scene->dimensions == 2;
    layer_sums s = {0};
    for (size_t i = 0; i < view->cloud->count; i++) {
        const sb_fluid_sample *sample = &view->cloud->samples[i];
        const double z = sample->position.z - middle;
        const double weight = sb_bspline(z / reach) * sb_bspline((sample->position.x - p->x) / width) *
                              (flat ? 1 : sb_bspline((sample->position.y - p->y) / width));
        s.weight += weight;
        s.z += weight * z;
        s.zz += weight * z * z;
        s.v = sb_madd(s.v, weight, sample->velocity);
        s.zv = sb_madd(s.zv, weight * z, sample->velocity);
    }
    return velocity_of(&s, reach);
}

sb_status sb_plane_records_read(const sb_measure *measure, const sb_measure_view *view, size_t plane, size_t index,
                                double time, sb_water_record *row, sb_error *error)
{
    const point *p = &measure->records[plane]->points[index];
    const double spacing = view->scene->resolution, range = 2 * STRETCH * spacing;
    const double side = view->scene->dimensions == 2 ? spacing : range;
    double water;
    *row = (sb_water_record){.plane = plane, .time = time, .x = p->x, .y = p->y, .bed = p->bed};
    sb_status status = sb_gauge_read(view, p->x, p->y, &p->floors, &row->surface, &water, error);
    for (int j = 0; j < SB_RECORD_LAYERS; j++) row->velocity[j] = sb_vec((double)NAN, (double)NAN, (double)NAN);
    if (status != SB_OK || !(row->surface > p->bed)) return status;
    status = sb_cloud_query(view->cloud, view->sim, sb_vec(p->x - range, p->y - side, p->bed - spacing),
                            sb_vec(p->x + range, p->y + side, row->surface + spacing), view->lag, error);
    const double height = (row->surface - p->bed) / SB_RECORD_LAYERS, reach = fmax(spacing, 0.5 * height);
    for (int j = 0; status == SB_OK && j < SB_RECORD_LAYERS; j++)
        row->velocity[j] = layer_velocity(view, p, p->bed + (j + 0.5) * height, reach);
    return status;
}
