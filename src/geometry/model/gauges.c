/* Warns of gauges over still water that is too shallow to have a surface, and of gauges of reflections without water.
 */
#include "base/memory.h"
#include "geometry/model/parts.h"

#include <stdio.h>

/* In spacings: still water shallower than this (in 2D and in 3D) has too few connected particles for a gauge.
   AROUND: distance from a gauge within which it may use other particles. */
static const double THIN_FLAT = 0.7, THIN = 0.5, AROUND = 2;
/* In spacings: a gauge over shallower water stands on the shore. */
static const double DAMP = 0.05;

/* Returns the highest still-water level at a position; -INFINITY: the scene has no water there. */
static double level_over(const sb_scene *scene, double x, double y)
{
    double level = scene->sea.present ? scene->sea.level : -(double)INFINITY;
    for (size_t i = 0; i < scene->box_count; ++i) {
        const sb_fluid_box *box = &scene->boxes[i];
        if (x > box->min.x && x < box->max.x && (scene->dimensions == 2 || (y > box->min.y && y < box->max.y)))
            level = fmax(level, box->level);
    }
    return fmin(level, scene->domain.max.z);
}

/* Returns the depth from a water level to the solid below, m; 0: the level is inside a solid. */
static double depth_below(const sb_model *model, const sb_model_space *space, sb_vec3 at)
{
    double depth = at.z - model->min.z;
    for (size_t b = 0; b < space->count; ++b) {
        if (!space->solid[b] || model->bodies[b].mesh.triangle_count == 0) continue;
        if (sb_solid_contains(space->solid[b], at)) return 0;
        const double below = sb_solid_raycast(space->solid[b], at, sb_vec(0, 0, -1), depth);
        if (below > 0) depth = below;
    }
    return depth;
}

double sb_model_still_depth(const sb_scene *scene, const sb_model *model, const sb_model_space *space, double x,
                            double y)
{
    const double flat = scene->dimensions == 2 ? 0 : y, level = level_over(scene, x, flat);
    return level > model->min.z ? depth_below(model, space, sb_vec(x, flat, level)) : 0;
}

/* A place, and the particles in the columns around it. */
typedef struct surroundings {
    const sb_model *model;
    double x, y;
    size_t count;
} surroundings;

static void count_around(void *context, const sb_water_piece *piece)
{
    surroundings *s = context;
    const double range = AROUND * s->model->spacing;
    for (size_t i = 0; i < piece->count; ++i) {
        const sb_vec3 at = piece->position[i];
        s->count += fabs(at.x - s->x) < range && (s->model->dimensions == 2 || fabs(at.y - s->y) < range);
    }
}

/* Finds the mean depth of the water around a position, m. */
static sb_status depth_around(const sb_model_space *space, const sb_model *model, double x, double y, double *depth,
                              sb_error *error)
{
    surroundings s = {model, x, y, 0};
    const sb_status status = sb_model_visit_water(space, model, count_around, &s, error);
    *depth = (double)s.count * model->spacing / (2 * AROUND) / (model->dimensions == 2 ? 1 : 2 * AROUND);
    return status;
}

/* Finds the still-water depth at a gauge if it is too shallow for it, m; else, or without water, 0. */
static sb_status thin_depth(const sb_scene *scene, const sb_model_space *space, const sb_model *model,
                            const sb_gauge *gauge, double *thin, sb_error *error)
{
    const bool flat = scene->dimensions == 2;
    const double x = gauge->x, y = flat ? 0 : gauge->y, level = level_over(scene, x, y);
    const double least = (flat ? THIN_FLAT : THIN) * model->spacing;
    if (!(level > model->min.z) || x < model->min.x || x > model->max.x ||
        (!flat && (y < model->min.y || y > model->max.y)))
        return SB_OK;
    const double depth = depth_below(model, space, sb_vec(x, y, level));
    if (!(depth > DAMP * model->spacing && depth < least)) return SB_OK;
    double around = 0;
    const sb_status status = depth_around(space, model, x, y, &around, error);
    if (around < least) *thin = depth;
    return status;
}

/* A gauge without water, such as one in a paddle or behind it, is left out of a split. */
static sb_status warn_of_set(const sb_scene *scene, const sb_reflection_set *set, const sb_model_space *space,
                             sb_model *model, sb_error *error)
{
    const double least = (scene->dimensions == 2 ? THIN_FLAT : THIN) * model->spacing;
    for (size_t i = 0; i < set->gauge_count; ++i) {
        const sb_gauge *gauge = &scene->measure.gauges[sb_scene_gauge(scene, set->gauges[i].name)];
        double around = 0;
        if (gauge->water == SB_GAUGE_GRID || model->shallow[gauge - scene->measure.gauges]) continue;
        const sb_status status =
            depth_around(space, model, gauge->x, scene->dimensions == 2 ? 0 : gauge->y, &around, error);
        if (status != SB_OK) return status;
        if (around >= least) continue;
        return sb_model_warn(model, error,
                             "measure.reflections %s: no water is at gauge \"%s\" at t = 0, and a gauge without water "
                             "is left out of the split; expected gauges in the water",
                             set->name, gauge->name);
    }
    return SB_OK;
}

sb_status sb_model_warn_reflections(const sb_scene *scene, const sb_model_space *space, sb_model *model,
                                    sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t r = 0; r < scene->measure.reflection_count && status == SB_OK; ++r)
        status = warn_of_set(scene, &scene->measure.reflections[r], space, model, error);
    return status;
}

/* In spacings: a probe deeper inside of a body is on no face of it. */
static const double INSIDE = 0.5;

sb_status sb_model_warn_probes(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    const double deep = INSIDE * model->spacing;
    sb_status status = SB_OK;
    for (size_t i = 0; i < scene->measure.probe_count && status == SB_OK; ++i)
        for (size_t b = 0; b < space->count && status == SB_OK; ++b) {
            sb_vec3 at = scene->measure.probes[i].at;
            if (model->dimensions == 2) at.y = 0;
            if (!space->solid[b] || model->bodies[b].mesh.triangle_count == 0) continue;
            if (!sb_solid_contains(space->solid[b], at) ||
                sb_solid_distance(space->solid[b], at, deep, NULL, NULL) < deep)
                continue;
            status = sb_model_warn(model, error,
                                   "probe \"%s\" is inside of \"%s\", where no water comes: its values stay empty; "
                                   "expected a place in the water, or on a face",
                                   scene->measure.probes[i].name, model->bodies[b].name);
        }
    return status;
}

sb_status sb_model_warn_gauges(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    const sb_measure_settings *settings = &scene->measure;
    char others[600] = "", more[40] = "";
    size_t first = SIZE_MAX, left = 0, length = 0;
    double depth = 0;
    if (settings->gauge_count == 0) return SB_OK;
    model->shallow = sb_alloc(settings->gauge_count, sizeof *model->shallow);
    if (!model->shallow) return sb_fail_memory(error, "gauges");
    for (size_t i = 0; i < settings->gauge_count; ++i) {
        double here = 0;
        if (settings->gauges[i].water != SB_GAUGE_GRID) {
            const sb_status status = thin_depth(scene, space, model, &settings->gauges[i], &here, error);
            if (status != SB_OK) return status;
        }
        model->shallow[i] = here > 0;
        if (here > 0 && first == SIZE_MAX) {
            first = i;
            depth = here;
        } else if (here > 0 && length + SB_NAME_MAX + 32 < sizeof others) {
            length += (size_t)snprintf(others + length, sizeof others - length, "%s \"%s\" %.2g m",
                                       length == 0 ? "; likewise" : ",", settings->gauges[i].name, here);
        } else {
            left += here > 0;
        }
    }
    if (first == SIZE_MAX) return SB_OK;
    if (left > 0) snprintf(more, sizeof more, " and %zu more", left);
    return sb_model_warn(
        model, error,
        "gauge \"%s\": the still water there is %.2g m deep, less than the spacing of %g m: its values "
        "stay empty until the water is deeper; expected a resolution of %.2g m or less%s%s",
        settings->gauges[first].name, depth, model->spacing, depth, others, more);
}
