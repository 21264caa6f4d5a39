/* Cuts the slabs of a domain into parts, each of which one rank samples. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"

/* Clips [*low, *high] to the domain and what is near it along an axis. Returns the fraction that is left. */
static double clip(const sb_sample_settings *settings, int axis, double *low, double *high)
{
    const double from = sb_sample_along(settings->min, axis) - settings->support;
    const double to = sb_sample_along(settings->max, axis) + settings->support, length = *high - *low;
    if (*low > to || *high < from) return 0;
    *low = fmax(*low, from);
    *high = fmin(*high, to);
    return length > 0 ? (*high - *low) / length : 1;
}

/* Adds to the slabs the areas of a triangle's parts in them, as if its area were even over its box. */
static void add_triangle(const sb_sample_settings *settings, const sb_slabs *slabs, const sb_vec3 corner[3],
                         double *weight)
{
    const sb_vec3 min = sb_min(sb_min(corner[0], corner[1]), corner[2]);
    const sb_vec3 max = sb_max(sb_max(corner[0], corner[1]), corner[2]);
    double area = sb_norm(sb_cross(sb_sub(corner[1], corner[0]), sb_sub(corner[2], corner[0]))), from = 0, to = 0;
    for (int axis = 0; axis < 3; ++axis) {
        double low = sb_sample_along(min, axis), high = sb_sample_along(max, axis);
        if (settings->dimensions == 2 && axis == 1) continue;
        area *= clip(settings, axis, &low, &high);
        if (axis == slabs->axis) from = low, to = high;
    }
    if (!(area > 0)) return;
    sb_vec3 at = {from, from, from};
    const uint32_t first = sb_slab_of(slabs, at);
    at = (sb_vec3){to, to, to};
    const uint32_t last = sb_slab_of(slabs, at);
    for (uint32_t k = first; k <= last; ++k) {
        const double begin = k == first ? from : slabs->from + k * slabs->width;
        const double end = k == last ? to : slabs->from + (k + 1) * slabs->width;
        weight[k] += to > from ? area * (end - begin) / (to - from) : area;
    }
}

sb_status sb_sample_divide(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count,
                           size_t parts, uint32_t *bounds, sb_error *error)
{
    sb_slabs slabs, rows;
    sb_slabs_choose(settings, &slabs, &rows);
    double *weight = sb_alloc(slabs.count, sizeof *weight), total = 0, before = 0;
    if (!weight) return sb_fail_memory(error, "slabs of surfaces");
    for (size_t s = 0; s < count; ++s) {
        const sb_mesh *mesh = sources[s].mesh;
        for (size_t t = 0; t < mesh->triangle_count && !sources[s].moving; ++t) {
            const uint32_t *of = mesh->triangles[t];
            const sb_vec3 corner[3] = {mesh->vertices[of[0]], mesh->vertices[of[1]], mesh->vertices[of[2]]};
            add_triangle(settings, &slabs, corner, weight);
        }
    }
    for (uint32_t k = 0; k < slabs.count; ++k) total += weight[k];
    size_t part = 0;
    bounds[0] = 0;
    for (uint32_t k = 0; k < slabs.count; ++k) {
        /* A slab is of the part in which its middle is. */
        const double middle = (before + 0.5 * weight[k]) / total;
        for (; part + 1 < parts && middle >= (double)(part + 1) / (double)parts; ++part) bounds[part + 1] = k;
        before += weight[k];
    }
    while (part < parts) bounds[++part] = slabs.count;
    sb_free(weight);
    return SB_OK;
}
