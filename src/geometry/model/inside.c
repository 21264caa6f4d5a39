/* Finds points inside solids, independently of the boundary particles. */
#include "geometry/model/parts.h"

/* Returns the body that contains the point by more than tolerance, or SIZE_MAX. */
static size_t containing_body(const sb_model *model, const sb_model_space *space, sb_vec3 point,
                              const sb_vec3 *displacement, double tolerance)
{
    for (size_t b = 0; b < space->count; ++b) {
        sb_vec3 at = displacement ? sb_sub(point, displacement[b]) : point;
        if (model->dimensions == 2) at.y = 0;
        if (space->solid[b] && sb_solid_contains(space->solid[b], at) &&
            sb_solid_distance(space->solid[b], at, tolerance, NULL, NULL) >= tolerance &&
            !sb_solid_beside(space->solid[b], at))
            return b;
    }
    return SIZE_MAX;
}

static sb_vec3 point_at(const float *position, size_t i, sb_vec3 origin)
{
    return sb_add(origin, sb_vec((double)position[3 * i], (double)position[3 * i + 1], (double)position[3 * i + 2]));
}

sb_status sb_model_first_inside(const sb_model *model, const float *position, size_t count, sb_vec3 origin,
                                const sb_vec3 *displacement, double tolerance, sb_inside_report *report,
                                sb_error *error)
{
    sb_model_space space;
    sb_status status = sb_model_space_create(model, NULL, &space, error);
    if (status != SB_OK) return status;
    size_t found = 0, first = SIZE_MAX;
#pragma omp parallel for schedule(dynamic, 1024) reduction(+ : found) reduction(min : first)
    for (size_t i = 0; i < count; ++i) {
        size_t body = containing_body(model, &space, point_at(position, i, origin), displacement, tolerance);
        if (body == SIZE_MAX) continue;
        ++found;
        first = i < first ? i : first;
    }
    *report = (sb_inside_report){.count = found, .first = first, .body = SIZE_MAX};
    if (found > 0) {
        sb_vec3 at = point_at(position, first, origin);
        report->body = containing_body(model, &space, at, displacement, tolerance);
        if (displacement) at = sb_sub(at, displacement[report->body]);
        report->depth = sb_solid_distance(space.solid[report->body], at, 1e30, NULL, NULL);
    }
    sb_model_space_free(&space);
    return SB_OK;
}
