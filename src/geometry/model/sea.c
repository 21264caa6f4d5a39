/* The ground beside sides through which a given sea comes in. */
#include "geometry/model/parts.h"

#include "base/memory.h"
#include "geometry/grid/start.h"
#include "sea/sea.h"

/* Spacings by which the strip is wider than the support radius: a particle that is released at its inner edge has held
   water all around it for one more spacing. */
static const double SPARE = 1;

/* Half of the length over which the water inside of the strip is averaged: in spacings, and in depths. */
static const double LEAST_REACH = 3, REACH = 0.25;

/* Part of the depth by which the theory's depth may differ from that at the side without a warning. */
static const double SAME_DEPTH = 0.05;

double sb_model_sea_reach(const sb_model *model, double depth)
{
    return fmax(LEAST_REACH * model->spacing, REACH * depth);
}

/* z of the highest ground at (x, y). */
static double ground_at(const sb_model *model, const sb_model_space *space, double x, double y)
{
    const double from = model->max.z;
    double depth = from - model->min.z;
    for (size_t b = 0; b < space->count; b++) {
        if (!space->solid[b] || model->bodies[b].mesh.triangle_count == 0) continue;
        const double hit = sb_solid_raycast(space->solid[b], sb_vec(x, y, from), sb_vec(0, 0, -1), depth);
        if (hit > 0) depth = fmin(depth, hit);
    }
    return from - depth;
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
        sea->bed[c] = ground_at(model, space, at.x, at.y);
    }
    return 0;
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
        return sb_fail(error, SB_BAD_INPUT,
                       "domain.sides.%s: sea, but the lowest ground there is at %g m and the highest water at %g m, "
                       "expected at least one spacing of water",
                       sb_side_names[side], lowest, highest);
    if (length < (both ? 2 : 1) * sea->width)
        return sb_fail(error, SB_BAD_INPUT,
                       "domain.sides.%s: sea, but the domain is %g m long there, expected at least %g m: the strip of "
                       "given water and the water that is measured inside of it",
                       sb_side_names[side], length, (both ? 2 : 1) * sea->width);
    return SB_OK;
}

/* Where the given surface at t = 0 is farthest from the still level. */
typedef struct farthest {
    double height; /* m, over the still level; 0 where all sides are dry */
    sb_vec3 at;
    double bed;
    bool dry; /* the source has no water there */
} farthest;

static farthest first_height(const sb_scene *scene, const sb_model *model, const sb_sea_source *sea)
{
    farthest found = {0};
    for (int side = 0; side < 4; side++) {
        const sb_model_sea *ground = &model->sea[side];
        for (size_t c = 0; sb_scene_given_side(scene, side) && c < ground->along; c++) {
            const double bed = ground->bed[c * ground->across];
            const sb_vec3 at = sb_model_sea_place(model, side, 0, ((double)c + 0.5) * ground->pitch);
            sb_sea_point water;
            sb_sea_at(sea, 0, at.x, at.y, scene->sea.level, bed, &water);
            const double away = fmax(water.surface, bed) - fmax(scene->sea.level, bed);
            if (fabs(away) > fabs(found.height)) found = (farthest){away, at, bed, !(water.surface > bed)};
        }
    }
    return found;
}

/* The side whose deepest ground is nearest to the depth of the theory; that depth. */
static int nearest_depth(const sb_scene *scene, const sb_model *model, double *depth)
{
    int found = 0;
    for (int side = 0; side < 4; side++) {
        const sb_model_sea *ground = &model->sea[side];
        double lowest = (double)INFINITY;
        for (size_t c = 0; c < ground->along; c++) lowest = fmin(lowest, ground->bed[c * ground->across]);
        const double here = scene->given.level - lowest;
        if (!sb_scene_given_side(scene, side) || fabs(here - scene->given.depth) >= fabs(*depth - scene->given.depth))
            continue;
        *depth = here;
        found = side;
    }
    return found;
}

/* A table or a record is the water along one line. */
static sb_status warn_opposite(const sb_scene *scene, sb_model *model, sb_error *error)
{
    for (int side = 0; side < 4; side += 2)
        if (sb_scene_given_side(scene, side) && sb_scene_given_side(scene, side + 1))
            return sb_model_warn(model, error,
                                 "sea.sides: the water of the file is given at %s and at the opposite %s at the same "
                                 "time; expected still where waves only leave, such as {%s: still}",
                                 sb_side_names[side], sb_side_names[side + 1], sb_side_names[side + 1]);
    return SB_OK;
}

/* Warns of a source whose first water is not the still water. */
static sb_status warn_first(const sb_scene *scene, const farthest *f, sb_model *model, sb_error *error)
{
    if (sb_scene_nested(scene) && f->dry)
        return sb_model_warn(
            model, error,
            "sea: the grid has no water around (%g, %g), where the ground is at %g m, below water.level: "
            "the water there runs out through the side; expected a smaller offshore.cell than %g m, or a "
            "terrain that has this water",
            f->at.x, f->at.y, f->bed, scene->offshore.cell);
    return sb_model_warn(model, error,
                         "sea: the given water begins %g m from the still water of water.level: a bore enters at "
                         "once; expected another sea.start or sea.level",
                         f->height);
}

static sb_status warn_source(const sb_scene *scene, const sb_sea_source *sea, sb_model *model, sb_error *error)
{
    const bool still = scene->wave.kind == SB_INITIAL_NONE && scene->box_count == 0;
    const farthest first = still ? first_height(scene, model, sea) : (farthest){0};
    if (sb_sea_warning(sea)) return sb_model_warn(model, error, "%s", sb_sea_warning(sea));
    if (fabs(first.height) > model->spacing) return warn_first(scene, &first, model, error);
    if (scene->given.source == SB_GIVEN_NONE) return SB_OK;
    if (scene->given.source == SB_GIVEN_OFFSHORE) return SB_OK;
    if (scene->given.source != SB_GIVEN_THEORY) return warn_opposite(scene, model, error);
    double depth = (double)INFINITY;
    const int side = nearest_depth(scene, model, &depth);
    if (fabs(depth - scene->given.depth) <= fmax(SAME_DEPTH * scene->given.depth, model->spacing)) return SB_OK;
    return sb_model_warn(model, error,
                         "sea.depth: the wave is that of a depth of %g m, and the water at %s is at most %g m deep; "
                         "expected the depth at the side",
                         scene->given.depth, sb_side_names[side], depth);
}

sb_status sb_model_sea_sides(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    bool any = false;
    for (int side = 0; side < 4; side++) any |= sb_scene_sea_side(scene, side);
    if (!any) return SB_OK;
    if (!scene->sea.present)
        return sb_fail(error, SB_BAD_INPUT,
                       "domain.sides: a side of kind sea, but no water.level: expected the level "
                       "of the still water");
    sb_sea_source *sea = NULL;
    sb_status status = sb_scene_nested(scene) ? sb_grid_start_fill(scene, &model->grid, error) : SB_OK;
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
    }
    if (status == SB_OK) status = warn_source(scene, sea, model, error);
    sb_sea_destroy(sea);
    return status;
}
