/* What can run beside sides of kind sea, but is probably not meant. */
#include "geometry/model/parts.h"

#include "offshore/offshore.h"

#include <math.h>

/* Part of the depth by which the theory's depth may differ from that at the side without a warning. */
static const double SAME_DEPTH = 0.05;

/* The same for the mean depth of a grid along a side: a step of this size reflects 2.6 % of a long wave. */
static const double OTHER_DEPTH = 0.1;

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

/* Warns of a grid that has a wave within the domain at t = 0, where the particles are at rest. */
static sb_status warn_within(const sb_scene *scene, const sb_offshore *grid, sb_model *model, sb_error *error)
{
    const double cell = scene->offshore.cell, level = scene->sea.level;
    const bool flat = model->dimensions == 2;
    double most = 0, surface = 0;
    sb_vec3 place = {0};
    for (double x = model->min.x + 0.5 * cell; x < model->max.x; x += cell)
        for (double y = flat ? 0 : model->min.y + 0.5 * cell; flat ? y == 0 : y < model->max.y; y += cell) {
            const sb_offshore_sample here = sb_offshore_at(grid, x, y);
            if (!here.wet[0] || !(here.bed < level) || fabs(here.water[0].surface - level) <= most) continue;
            most = fabs(here.water[0].surface - level);
            surface = here.water[0].surface;
            place = sb_vec(x, y, 0);
        }
    if (!(most > model->spacing)) return SB_OK;
    return sb_model_warn(model, error,
                         "sea: at t = 0 the grid's surface within the domain is at %.4g m, near (%g, %g), and the "
                         "particles begin at rest at %g m: this part of the wave is lost; expected a later sea.start, "
                         "before the wave reaches the domain",
                         surface, place.x, place.y, level);
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
    const sb_given_source source = scene->given.source;
    const char *level = source == SB_GIVEN_OFFSHORE ? "offshore.level"
                        : source == SB_GIVEN_TABLE  ? "sea.datum"
                                                    : "sea.level";
    return sb_model_warn(model, error,
                         "sea: the given water begins %g m %s the still water of water.level: a bore enters at "
                         "once; expected another sea.start or %s",
                         fabs(f->height), f->height < 0 ? "below" : "above", level);
}

/* Whether a source leaves less than a spacing of water at time t on a column. */
static bool is_dry(const sb_model *model, const sb_sea_source *sea, int side, size_t column, double t, farthest *here)
{
    const sb_model_sea *ground = &model->sea[side];
    const double bed = ground->bed[column * ground->across];
    const sb_vec3 at = sb_model_sea_place(model, side, 0, ((double)column + 0.5) * ground->pitch);
    sb_sea_point water;
    sb_sea_at(sea, t, at.x, at.y, bed, bed, &water);
    *here = (farthest){.height = water.surface, .at = at, .bed = bed};
    return water.surface - bed < model->spacing;
}

/* Whether it does so on every column that has SB_SEA_DEEP layers at the start; *found: the lowest column, which is
   looked at first, and nearly always has water. */
static bool falls_dry(const sb_model *model, const sb_sea_source *sea, int side, double t, farthest *found)
{
    const sb_model_sea *ground = &model->sea[side];
    farthest here;
    size_t lowest = 0;
    for (size_t c = 0; c < ground->along; c++)
        if (ground->bed[c * ground->across] < ground->bed[lowest * ground->across]) lowest = c;
    if (!is_dry(model, sea, side, lowest, t, found)) return false;
    bool any = false;
    for (size_t c = 0; c < ground->along; c++) {
        (void)is_dry(model, sea, side, c, 0, &here);
        if (round((here.height - here.bed) / model->spacing) < SB_SEA_DEEP) continue;
        if (!is_dry(model, sea, side, c, t, &here)) return false;
        any = true;
    }
    return any;
}

/* Warns of a source that will dry a strip: the run ends there (sim/sea/inflow.c). */
static sb_status warn_dry(const sb_scene *scene, const sb_sea_source *sea, sb_model *model, sb_error *error)
{
    enum { TIMES = 10000 };
    for (int k = 1; k <= TIMES; k++)
        for (int side = 0; side < 4; side++) {
            const double t = scene->duration * k / TIMES;
            farthest f;
            if (!sb_scene_given_side(scene, side) || !falls_dry(model, sea, side, t, &f)) continue;
            return sb_model_warn(
                model, error,
                "sea: at %.4g s the given water at %s falls to %.4g m at (%g, %g), over ground at %g m, the lowest "
                "there: the strip would be dry, and the run ends there; expected at least one spacing of water, or a "
                "side in deeper water",
                t, sb_side_names[side], f.height, f.at.x, f.at.y, f.bed);
        }
    return SB_OK;
}

/* Mean depths of still water along a side, m: of the particles, and of the grid. */
static void mean_depths(const sb_scene *scene, const sb_model *model, const sb_offshore *grid, int side,
                        double depth[2])
{
    const sb_model_sea *ground = &model->sea[side];
    depth[0] = depth[1] = 0;
    for (size_t c = 0; c < ground->along; c++) {
        const sb_vec3 at = sb_model_sea_place(model, side, 0, ((double)c + 0.5) * ground->pitch);
        const double bed[2] = {ground->bed[c * ground->across], sb_offshore_at(grid, at.x, at.y).bed};
        for (int k = 0; k < 2; k++) depth[k] += fmax(scene->sea.level - bed[k], 0) / (double)ground->along;
    }
}

/* Warns of a grid whose water is not as deep as that of the particles, as with another vertical datum. */
static sb_status warn_other_bed(const sb_scene *scene, const sb_offshore *grid, sb_model *model, sb_error *error)
{
    for (int side = 0; side < 4; side++) {
        double depth[2];
        if (!sb_scene_given_side(scene, side)) continue;
        mean_depths(scene, model, grid, side, depth);
        if (fabs(depth[1] - depth[0]) <= fmax(OTHER_DEPTH * depth[0], model->spacing)) continue;
        return sb_model_warn(
            model, error,
            "sea: at %s the water of the grid is %.4g m deep in the mean, and that of the particles %.4g m: a "
            "part of each wave is reflected there; expected the same ground; check datum, scale and positive "
            "of offshore.terrain, and offshore.cell",
            sb_side_names[side], depth[1], depth[0]);
    }
    return SB_OK;
}

/* Warns of a theory whose depth is not that at the side. */
static sb_status warn_depth(const sb_scene *scene, sb_model *model, sb_error *error)
{
    double depth = (double)INFINITY;
    const int side = nearest_depth(scene, model, &depth);
    if (fabs(depth - scene->given.depth) <= fmax(SAME_DEPTH * scene->given.depth, model->spacing)) return SB_OK;
    return sb_model_warn(model, error,
                         "sea.depth: the wave is that of a depth of %g m, and the water at %s is at most %g m deep; "
                         "expected the depth at the side",
                         scene->given.depth, sb_side_names[side], depth);
}

/* The largest part of a wave's direction, degrees from x, that is into the domain at a given side. */
static double inward_part(const sb_scene *scene, double direction)
{
    const double along[] = {cos(direction * M_PI / 180), sin(direction * M_PI / 180)};
    double most = -1;
    for (int side = 0; side < 4; side++)
        if (sb_scene_given_side(scene, side)) most = fmax(most, (side % 2 ? -1 : 1) * along[side / 2]);
    return most;
}

/* Warns of waves all of which run out of the sides at which they are given. */
static sb_status warn_direction(const sb_scene *scene, sb_model *model, sb_error *error)
{
    static const double LEAST = 0.01; /* along the side */
    const sb_given_sea *given = &scene->given;
    const bool sum = given->wave == SB_GIVEN_COMPONENTS;
    double most = -1;
    for (size_t c = 0; c < (sum ? given->component_count : 1); c++)
        most = fmax(most, inward_part(scene, sum ? given->components[c].direction : given->direction));
    if (most > LEAST) return SB_OK;
    return sb_model_warn(model, error,
                         "sea%s.direction: no wave runs into the domain at a side at which it is given: expected the "
                         "direction towards which it travels, in degrees, 0 along x and 90 along y",
                         sum ? ".components" : "");
}

sb_status sb_model_sea_warn(const sb_scene *scene, sb_sea_source *sea, sb_model *model, sb_error *error)
{
    const bool still = sb_scene_starts_still(scene);
    const farthest first = still ? first_height(scene, model, sea) : (farthest){0};
    sb_status status = SB_OK;
    if (sb_sea_warning(sea)) status = sb_model_warn(model, error, "%s", sb_sea_warning(sea));
    if (status == SB_OK && fabs(first.height) > model->spacing) status = warn_first(scene, &first, model, error);
    if (status != SB_OK) return status;
    switch (scene->given.source) {
    case SB_GIVEN_NONE:
        break;
    case SB_GIVEN_OFFSHORE:
        if (still && !first.dry) status = warn_within(scene, sb_sea_grid(sea), model, error);
        if (status == SB_OK) status = warn_other_bed(scene, sb_sea_grid(sea), model, error);
        break;
    case SB_GIVEN_TABLE:
    case SB_GIVEN_RECORD:
        status = warn_opposite(scene, model, error);
        if (status == SB_OK) status = warn_dry(scene, sea, model, error);
        break;
    case SB_GIVEN_THEORY:
        status = warn_depth(scene, model, error);
        if (status == SB_OK) status = warn_direction(scene, model, error);
        if (status == SB_OK) status = warn_dry(scene, sea, model, error);
        break;
    }
    return status;
}
