/* Checks that solids continue across periodic sides. */
#include "geometry/model/parts.h"

enum { PLACES_MAX = 256 };

/* In spacings: distance from the sides at which solids are looked for. */
static const double within = 1e-3;

/* Whether the point is inside a solid, without the domain's own walls. */
static bool is_solid(const sb_model *model, const sb_model_space *space, sb_vec3 at)
{
    for (size_t b = 0; b < space->count; ++b)
        if (space->solid[b] && model->bodies[b].mesh.triangle_count > 0 && sb_solid_contains(space->solid[b], at))
            return true;
    return false;
}

/* Returns the number of points across one extent, at least a spacing apart. */
static size_t places(double extent, double spacing)
{
    double count = ceil(extent / spacing - 1e-9);
    return count < 1 ? 1 : count > PLACES_MAX ? PLACES_MAX : (size_t)count;
}

/* Points on the two opposite sides along one axis, numbered i across and k up. */
typedef struct sides {
    const sb_model *model;
    int axis;
    size_t across, up;
} sides;

static sb_vec3 point_on(const sides *s, size_t i, size_t k, bool upper)
{
    sb_vec3 min = s->model->min, max = s->model->max;
    double margin = within * s->model->spacing;
    double share = ((double)i + 0.5) / (double)s->across;
    sb_vec3 at = {0, 0, min.z + ((double)k + 0.5) / (double)s->up * (max.z - min.z)};
    if (s->axis == 0) {
        at.x = upper ? max.x - margin : min.x + margin;
        at.y = s->model->dimensions == 2 ? 0 : min.y + share * (max.y - min.y);
    } else {
        at.x = min.x + share * (max.x - min.x);
        at.y = upper ? max.y - margin : min.y + margin;
    }
    return at;
}

static sb_status check_axis(const sb_model_space *space, sb_model *model, int axis, sb_error *error)
{
    sb_vec3 size = sb_sub(model->max, model->min);
    sides s = {model, axis, places(axis == 0 ? size.y : size.x, model->spacing), places(size.z, model->spacing)};
    if (axis == 0 && model->dimensions == 2) s.across = 1;
    size_t all = s.across * s.up, count = 0, first = all;
#pragma omp parallel for schedule(dynamic, 64) reduction(+ : count) reduction(min : first)
    for (size_t p = 0; p < all; ++p) {
        if (is_solid(model, space, point_on(&s, p % s.across, p / s.across, false)) ==
            is_solid(model, space, point_on(&s, p % s.across, p / s.across, true)))
            continue;
        ++count;
        first = p < first ? p : first;
    }
    if (count == 0) return SB_OK;
    bool upper = is_solid(model, space, point_on(&s, first % s.across, first / s.across, true));
    sb_vec3 at = point_on(&s, first % s.across, first / s.across, upper);
    return sb_model_warn(model, error,
                         "solids do not continue across the periodic sides in %c: at %zu of %zu "
                         "places, the first near (%g, %g, %g), one side is solid and the other is not",
                         "xy"[axis], count, all, at.x, at.y, at.z);
}

sb_status sb_model_check_sides(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (int axis = 0; axis < 2 && status == SB_OK; ++axis)
        if (sb_scene_repeats(scene, axis)) status = check_axis(space, model, axis, error);
    return status;
}
