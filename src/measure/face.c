/* The flow depth at a body's faces in particle spacings. It decides whether the body's force is reliable. */
#include "base/memory.h"
#include "measure/parts.h"

sb_footprint sb_footprint_of(const sb_model *model, size_t body)
{
    const sb_model_body *of = &model->bodies[body];
    sb_footprint footprint = {{0, 0, 0}, {0, 0, 0}};
    for (size_t i = of->begin; i < of->begin + of->count; i++) {
        sb_vec3 p = model->wall_position[i];
        footprint.min = i == of->begin ? p : sb_min(footprint.min, p);
        footprint.max = i == of->begin ? p : sb_max(footprint.max, p);
    }
    return footprint;
}

/* The depth is taken in a strip that begins at the boundary particles, wall_offset behind the face: outside of a
   building, inside of a tank. Both sides are read, so that the two cases need no distinction. */
#define PATCH 2.0 /* spacings: width of the strip */

/* Distributes one particle of width `size` at t (both in patches) over the patches that it covers. Counting whole
   particles would alias with the patches. */
static void distribute(double *counts, size_t patches, double t, double size)
{
    double first = t - size / 2, last = t + size / 2;
    for (size_t k = first > 0 ? (size_t)first : 0; k < patches && (double)k < last; k++)
        counts[k] += patches == 1 ? 1 : (fmin(last, (double)k + 1) - fmax(first, (double)k)) / size;
}

/* Raises *layers to the depth of the deepest patch along one side. along = 0: the side lies along y at x = place; 1:
   along x at y = place. */
static sb_status side_layers(const sb_measure_view *view, const sb_footprint *f, int along, double place,
                             double *layers, sb_error *error)
{
    bool flat = view->scene->dimensions == 2;
    double spacing = view->scene->resolution, range = (view->scene->numerics.wall_offset + PATCH) * spacing;
    double from = along ? f->min.x : f->min.y, to = along ? f->max.x : f->max.y;
    sb_vec3 min = along ? sb_vec(from, place - range, f->min.z) : sb_vec(place - range, from, f->min.z);
    sb_vec3 max = along ? sb_vec(to, place + range, f->max.z) : sb_vec(place + range, to, f->max.z);
    min.z = view->min.z - spacing;
    max.z = view->max.z + spacing;
    if (flat) {
        min.y = -spacing;
        max.y = spacing;
        from = to = 0;
    }
    sb_cloud *cloud = view->cloud;
    sb_status status = sb_cloud_query(cloud, view->sim, min, max, view->lag, error);
    if (status != SB_OK || cloud->count == 0) return status;
    double patch = PATCH * spacing;
    size_t patches = flat || to - from < patch ? 1 : (size_t)((to - from) / patch);
    double width = flat ? spacing : to - from < patch ? patch : (to - from) / (double)patches;
    /* The two sides of the face are counted separately: only one of them is wet. */
    double *counts = sb_alloc(2 * patches, sizeof *counts);
    if (!counts) return sb_fail_memory(error, "flow depth at faces");
    for (size_t i = 0; i < cloud->count; i++) {
        sb_vec3 p = cloud->samples[i].position;
        size_t behind = (along ? p.y : p.x) > place;
        distribute(counts + behind * patches, patches, flat ? 0 : ((along ? p.x : p.y) - from) / width,
                   spacing / width);
    }
    for (size_t k = 0; k < 2 * patches; k++) *layers = fmax(*layers, counts[k] * spacing / (PATCH * width));
    sb_free(counts);
    return SB_OK;
}

sb_status sb_face_layers(const sb_measure_view *view, const sb_footprint *footprint, sb_vec3 displacement,
                         double *layers, sb_error *error)
{
    sb_footprint f = {sb_add(footprint->min, displacement), sb_add(footprint->max, displacement)};
    *layers = 0;
    sb_status status = side_layers(view, &f, 0, f.min.x, layers, error);
    if (status == SB_OK) status = side_layers(view, &f, 0, f.max.x, layers, error);
    if (status == SB_OK && view->scene->dimensions == 3) status = side_layers(view, &f, 1, f.min.y, layers, error);
    if (status == SB_OK && view->scene->dimensions == 3) status = side_layers(view, &f, 1, f.max.y, layers, error);
    return status;
}
