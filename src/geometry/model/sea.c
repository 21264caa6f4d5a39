/* The ground beside sides through which a given sea comes in. */
#include "geometry/model/parts.h"

#include "base/memory.h"
#include "geometry/grid/start.h"

/* Spacings by which the strip is wider than the support radius: a particle that is released at its inner edge has held
   water all around it for one more spacing. */
static const double SPARE = 1;

/* Half of the length over which the water inside of the strip is averaged: in spacings, and in depths. */
static const double LEAST_REACH = 3, REACH = 0.25;

double sb_model_sea_reach(const sb_model *model, double depth)
{
    return fmax(LEAST_REACH * model->spacing, REACH * depth);
}

/* Distance from `at` up (1) or down (-1) to the first surface of the bodies, at most `limit`, which is returned if
   there is none; *body is that which has it. */
static double surface_from(const sb_model *model, const sb_model_space *space, sb_vec3 at, int up, double limit,
                           size_t *body)
{
    for (size_t b = 0; b < space->count; b++) {
        if (!space->solid[b] || model->bodies[b].mesh.triangle_count == 0) continue;
        const double hit = sb_solid_raycast(space->solid[b], at, sb_vec(0, 0, up), limit);
        if (!(hit > 0)) continue;
        limit = hit;
        if (body) *body = b;
    }
    return limit;
}

/* Whether a body is at a place; *top: where it ends above. */
static bool is_ground(const sb_model *model, const sb_model_space *space, sb_vec3 at, double *top)
{
    for (size_t b = 0; b < space->count; b++) {
        if (!space->solid[b] || model->bodies[b].mesh.triangle_count == 0) continue;
        if (!sb_solid_contains(space->solid[b], at)) continue;
        const double rest = model->max.z - at.z, hit = sb_solid_raycast(space->solid[b], at, sb_vec(0, 0, 1), rest);
        *top = hit > 0 ? at.z + hit : model->max.z;
        return true;
    }
    return false;
}

/* z of the ground at (x, y): below the still level, or the top of what is there. What hangs above the level is none. */
static double ground_at(const sb_model *model, const sb_model_space *space, double x, double y, double level)
{
    sb_vec3 at = sb_vec(x, y, fmin(level, model->max.z));
    double top;
    if (!is_ground(model, space, at, &top)) return at.z - surface_from(model, space, at, -1, at.z - model->min.z, NULL);
    /* Bodies may lie on each other. */
    const double step = 1e-6 * model->spacing;
    while (at.z = top + step, at.z < model->max.z && is_ground(model, space, at, &top)) continue;
    return fmin(at.z - step, model->max.z);
}

sb_vec3 sb_model_sea_place(const sb_model *model, int side, double inwards, double along)
{
    const bool upper = side % 2 == 1, flat = model->dimensions == 2;
    if (side < 2)
        return sb_vec(upper ? model->max.x - inwards : model->min.x + inwards, flat ? 0 : model->min.y + along, 0);
    return sb_vec(model->min.x + along, upper ? model->max.y - inwards : model->min.y + inwards, 0);
}

static int lay_out(const sb_scene *scene, const sb_model_space *space, const sb_model *model, int side, double depth,
                   sb_model_sea *sea)
{
    const sb_vec3 size = sb_sub(model->max, model->min);
    const double length = side < 2 ? size.y : size.x, dr = model->spacing;
    *sea = (sb_model_sea){.step = dr, .strip = (ceil(scene->numerics.support) + SPARE) * dr};
    sea->along = model->dimensions == 2 ? 1 : (size_t)fmax(round(length / dr), 1);
    sea->pitch = model->dimensions == 2 ? dr : length / (double)sea->along;
    sea->across = (size_t)ceil((sea->strip + 2 * sb_model_sea_reach(model, depth)) / dr) + 1;
    sea->width = (double)sea->across * dr;
    sea->bed = sb_alloc_untouched(sea->across * sea->along, sizeof *sea->bed);
    if (!sea->bed) return -1;
    const size_t cells = sea->across * sea->along;
#pragma omp parallel for schedule(static)
    for (size_t c = 0; c < cells; c++) {
        const double inwards = ((double)(c % sea->across) + 0.5) * sea->step;
        const sb_vec3 at = sb_model_sea_place(model, side, inwards, ((double)(c / sea->across) + 0.5) * sea->pitch);
        sea->bed[c] = ground_at(model, space, at.x, at.y, scene->sea.level);
    }
    return 0;
}

/* Refuses what hangs over a strip lower than its highest water, which would be born within it. */
static sb_status check_above(const sb_scene *scene, const sb_model_space *space, const sb_model *model, int side,
                             double highest, sb_error *error)
{
    const sb_model_sea *sea = &model->sea[side];
    const double level = scene->sea.level, most = highest - level;
    for (size_t c = 0; most > 0 && c < sea->across * sea->along; c++) {
        const double inwards = ((double)(c % sea->across) + 0.5) * sea->step;
        if (inwards > sea->strip || !(sea->bed[c] < level)) continue;
        sb_vec3 at = sb_model_sea_place(model, side, inwards, ((double)(c / sea->across) + 0.5) * sea->pitch);
        at.z = level;
        size_t body = 0;
        const double free = surface_from(model, space, at, 1, most, &body);
        if (free < most)
            return sb_fail(
                error, SB_BAD_INPUT,
                "%.300s: domain.sides.%s: body \"%s\" hangs over the given water there, at %g m near (%g, %g), and "
                "the highest water is at %g m; expected it above this, or %g m inside of the side",
                scene->path ? scene->path : "the scene", sb_side_names[side], model->bodies[body].name, level + free,
                at.x, at.y, highest, sea->strip);
    }
    return SB_OK;
}

/* Refuses a side that no water reaches, and a domain without room for the strip. */
static sb_status check(const sb_scene *scene, const sb_model *model, int side, double highest, sb_error *error)
{
    const sb_model_sea *sea = &model->sea[side];
    const double length = side < 2 ? model->max.x - model->min.x : model->max.y - model->min.y;
    const bool both = sb_scene_sea_side(scene, side ^ 1);
    double lowest = (double)INFINITY;
    for (size_t c = 0; c < sea->along; c++) lowest = fmin(lowest, sea->bed[c * sea->across]);
    if (!(lowest < highest - model->spacing))
        return sb_fail(
            error, SB_BAD_INPUT,
            "%.300s: domain.sides.%s: sea, but the lowest ground there is at %g m and the highest water at %g m, "
            "expected at least one spacing of water",
            scene->path ? scene->path : "the scene", sb_side_names[side], lowest, highest);
    if (length < (both ? 2 : 1) * sea->width)
        return sb_fail(
            error, SB_BAD_INPUT,
            "%.300s: domain.sides.%s: sea, but the domain is %g m long there, expected at least %g m: the strip of "
            "given water and the water that is measured inside of it",
            scene->path ? scene->path : "the scene", sb_side_names[side], length, (both ? 2 : 1) * sea->width);
    return SB_OK;
}

sb_status sb_model_sea_sides(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    if (!sb_scene_has_sea(scene)) return SB_OK;
    if (!scene->sea.present)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.300s: domain.sides: a side of kind sea, but no water.level: expected the level "
                       "of the still water",
                       scene->path ? scene->path : "the scene");
    sb_sea_source *sea = NULL;
    sb_status status = sb_scene_nested(scene) ? sb_grid_start_fill(scene, &model->grid, error) : SB_OK;
    for (size_t w = 0; w < model->grid.told.warning_count && status == SB_OK; w++)
        status = sb_model_warn(model, error, "%s", model->grid.told.warnings[w]);
    if (status == SB_OK) status = sb_sea_create(scene, &model->grid, &sea, error);
    if (status != SB_OK) return status;
    const double highest = sb_sea_greatest_surface(sea);
    for (int side = 0; side < 4 && status == SB_OK; side++) {
        if (!sb_scene_sea_side(scene, side)) continue;
        const double depth = fmax(highest, scene->sea.level) - (scene->sea.level - model->still_depth);
        model->sea_depth = fmax(model->sea_depth, depth);
        if (lay_out(scene, space, model, side, model->still_depth, &model->sea[side]) != 0)
            status = sb_fail_memory(error, "the ground beside a sea");
        else
            status = check(scene, model, side, highest, error);
        if (status == SB_OK) status = check_above(scene, space, model, side, highest, error);
    }
    if (status == SB_OK) status = sb_model_sea_warn(scene, sea, model, error);
    sb_sea_destroy(sea);
    return status;
}
