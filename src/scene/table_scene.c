#include "scene/reader.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *const sb_side_names[SB_SIDES] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

static const char *const side_kind_names[] = {"wall", "open", "periodic", "sea", NULL};

#define SIDE(index, side, fallback_, doc_)                                                                             \
    {                                                                                                                  \
        .name = side, .type = SB_KEY_CHOICE, .offset = (index) * sizeof(sb_side_kind), .words = side_kind_names,       \
        .fallback = fallback_, .doc = doc_                                                                             \
    }

/* clang-format off */
static const sb_key side_keys[] = {
    SIDE(SB_X_MIN, "x_min", "wall", "The side at the smallest x."),
    SIDE(SB_X_MAX, "x_max", "wall", "The side at the largest x."),
    SIDE(SB_Y_MIN, "y_min", "wall", "The side at the smallest y; has no effect in 2D."),
    SIDE(SB_Y_MAX, "y_max", "wall", "The side at the largest y; has no effect in 2D."),
    SIDE(SB_Z_MIN, "z_min", "wall", "The floor."),
    SIDE(SB_Z_MAX, "z_max", "open", "The lid."),
};
/* clang-format on */

static sb_status finish_sides(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_side_kind *side = item;
    for (size_t i = 0; i < SB_SIDES; i++) {
        const size_t other = i ^ 1;
        if (side[i] == SB_SIDE_SEA && (i == SB_Z_MIN || i == SB_Z_MAX))
            return sb_reader_fail(reader, map, side_keys[i].name,
                                  "sea, but water comes in through vertical sides only, expected wall or open");
        if (side[i] != SB_SIDE_PERIODIC || (reader->scene->dimensions == 2 && (i == SB_Y_MIN || i == SB_Y_MAX)))
            continue;
        if (i == SB_Z_MIN || i == SB_Z_MAX)
            return sb_reader_fail(reader, map, side_keys[i].name,
                                  "z cannot be periodic, because water would fall without end, expected wall "
                                  "or open");
        if (side[other] != SB_SIDE_PERIODIC)
            return sb_reader_fail(reader, map, side_keys[i].name,
                                  "periodic, but %s is %s, expected both periodic or neither", side_keys[other].name,
                                  side_kind_names[side[other]]);
    }
    return SB_OK;
}

static const sb_table side_table = {SB_KEY_ROWS(side_keys), .finish = finish_sides};

/* clang-format off */
static const sb_key domain_keys[] = {
    {.name = "min", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_domain, min), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "Corner with the smallest coordinates."},
    {.name = "max", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_domain, max), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "Corner with the largest coordinates."},
    {.name = "sides", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_domain, side), .table = &side_table,
     .doc = "Type of each side of the domain: `wall`, `open`, `periodic` or `sea`; see below."},
};
/* clang-format on */

/* Distance from 0 in spacings at which neighbouring doubles are a millionth of a spacing apart. */
static const double FARTHEST = 1e-6 * 0x1p52;

static sb_status finish_domain(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_domain *domain = item;
    const sb_scene *scene = reader->scene;
    sb_vec3 size = sb_sub(domain->max, domain->min);
    const double extent[] = {size.x, size.y, size.z}, spacing = scene->resolution;
    for (size_t i = 0; i < 3; i++) {
        if (i == 1 && scene->dimensions == 2) continue;
        if (!(extent[i] > 0) || !isfinite(extent[i]))
            return sb_reader_fail(reader, map, "max", "%c is not above that of domain.min, expected min < max",
                                  "xyz"[i]);
        /* Cell numbers of the neighbour search have 21 bits per axis. */
        if (!(spacing > 0)) continue; /* a scene without particles */
        if (extent[i] / scene->resolution > 1e6)
            return sb_reader_fail(reader, map, "max",
                                  "%g m in %c is %.3g times the resolution of %g m, expected at "
                                  "most 1e+06 times",
                                  extent[i], "xyz"[i], extent[i] / scene->resolution, scene->resolution);
        const double least[] = {domain->min.x, domain->min.y, domain->min.z};
        const double farthest = fmax(fabs(least[i]), fabs(least[i] + extent[i]));
        if (farthest > FARTHEST * spacing)
            return sb_reader_fail(reader, map, "max",
                                  "%c extends to %g m, where numbers have steps larger than a millionth of the "
                                  "resolution of %g m, expected less than %g m from 0",
                                  "xyz"[i], farthest, spacing, FARTHEST * spacing);
    }
    return SB_OK;
}

static const sb_table domain_table = {SB_KEY_ROWS(domain_keys), .finish = finish_domain};

/* clang-format off */
static const sb_key fluid_keys[] = {
    {.name = "density", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_fluid_properties, density),
     .unit = "kg/m3", SB_KEY_POSITIVE, .fallback = "1000", .doc = "Rest density."},
    {.name = "gravity", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_fluid_properties, gravity),
     .unit = "m/s2", SB_KEY_POSITIVE, .fallback = "9.81",
     .doc = "Magnitude of gravity; it points to -z."},
    {.name = "viscosity", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_fluid_properties, viscosity),
     .unit = "m2/s", SB_KEY_NOT_NEGATIVE, .fallback = "1e-6",
     .doc = "Kinematic viscosity of the fluid; 0 leaves the term out."},
    {.name = "surface_tension", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_fluid_properties, surface_tension),
     .unit = "N/m", .min = 0, .max = 2, .fallback = "0",
     .doc = "Surface tension of the fluid against air, 0.0728 for clean water at 20 degrees C; 0 leaves the term out. "
            "It acts on drops and waves of millimetres and limits the time step; `check` prints Bond and Weber "
            "numbers. Not with periodic sides, `solver: wcsph` or a scene of `offshore` alone."},
};
/* clang-format on */

static const sb_table fluid_table = {SB_KEY_ROWS(fluid_keys)};

enum { PARTICLES = 1, OFFSHORE = 2, GIVEN = 4 };

static unsigned scene_variant(const void *item, const sb_yaml *map)
{
    const sb_scene *scene = item;
    if (!map)
        return (scene->offshore.present ? OFFSHORE : 0) | (sb_scene_grid_alone(scene) ? 0 : PARTICLES) |
               (scene->given.source != SB_GIVEN_NONE ? GIVEN : 0);
    const sb_yaml *sea = sb_yaml_child(map, "sea"), *source = sea ? sb_yaml_child(sea, "source") : NULL;
    const bool offshore = sb_yaml_child(map, "offshore") != NULL;
    const bool nested = source && source->text && strcmp(source->text, "offshore") == 0;
    return (offshore ? OFFSHORE : 0) | (offshore && !nested ? 0 : PARTICLES) | (sea ? GIVEN : 0);
}

#define WITH_PARTICLES .applies = PARTICLES, .only = "a scene without offshore, or with sea.source: offshore"

/* clang-format off */
static const sb_key scene_keys[] = {
    {.name = "title", .type = SB_KEY_TEXT, SB_KEY_AT(sb_scene, title), .fallback = "\"\"",
     .doc = "Title of the scene, for pictures and reports."},
    {.name = "dimensions", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_scene, dimensions), .min = 2,
     .max = 3, .fallback = "3",
     .doc = "Number of dimensions: 3, or 2 for a vertical slice in x and z."},
    {.name = "resolution", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_scene, resolution), .unit = "m",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED, WITH_PARTICLES,
     .doc = "Particle spacing at rest. Smaller values resolve more detail and take longer."},
    {.name = "duration", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_scene, duration), .unit = "s",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED | SB_KEY_FREE,
     .doc = "Simulated time of the run."},
    {.name = "fluid", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, fluid), .table = &fluid_table,
     .doc = "Properties of the fluid."},
    {.name = "domain", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, domain), .table = &domain_table,
     .flags = SB_KEY_REQUIRED, .doc = "The box that contains the simulation."},
    {.name = "offshore", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, offshore), .table = &sb_offshore_table,
     .applies = OFFSHORE, .derived = "none", .only = "depth-averaged water",
     .doc = "Depth-averaged water on a grid: without particles, or beside them with `sea.source: offshore`; see [the "
            "depth-averaged model](offshore.md)."},
    {.name = "numerics", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, numerics),
     .table = &sb_numerics_table,
     .doc = "Numerical parameters; a preset sets the ones that are not given."},
    {.name = "water", .type = SB_KEY_BLOCK, .offset = 0, .table = &sb_water_table,
     .flags = SB_KEY_REQUIRED, WITH_PARTICLES, .doc = "The water at the start."},
    {.name = "sea", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, given), .table = &sb_given_table,
     .applies = GIVEN, .only = "given water", .derived = "still water",
     .doc = "Water that is given at the sides of kind `sea`; see [open sea](open-sea.md)."},
    {.name = "bodies", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_scene, bodies, body_count),
     .table = &sb_body_table, .doc = "Solids: terrain, buildings, paddles."},
    {.name = "wavemakers", .type = SB_KEY_LIST,
     SB_KEY_ITEMS(sb_scene, wavemakers, wavemaker_count), .table = &sb_wavemaker_table, WITH_PARTICLES,
     .doc = "Laws by which bodies move."},
    {.name = "sponges", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_scene, sponges, sponge_count),
     .table = &sb_sponge_table, WITH_PARTICLES,
     .doc = "Zones in which waves are damped; see [waves](waves.md)."},
    {.name = "foam", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, foam), .table = &sb_foam_table, WITH_PARTICLES,
     .doc = "Spray, foam and bubbles in pictures and files; see [pictures](pictures.md#foam-and-spray)."},
    {.name = "measure", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, measure),
     .table = &sb_measure_table, .doc = "Measurements, and their interval."},
    {.name = "render", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, render),
     .table = &sb_render_table, .doc = "Pictures and films."},
    {.name = "stream", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, stream),
     .table = &sb_stream_table, .flags = SB_KEY_FREE, .doc = "Live stream over LCM."},
    {.name = "control", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, control),
     .table = &sb_control_table, .flags = SB_KEY_FREE, .doc = "Commands to the run while it runs."},
    {.name = "output", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, output),
     .table = &sb_output_table, .doc = "Other files that a run writes."},
};
/* clang-format on */

/* The viscosity of a sponge would make implicit steps many times shorter, in the whole domain. */
static sb_status check_sponges(sb_reader *reader, const sb_yaml *map, const sb_scene *scene)
{
    const sb_yaml *list = sb_yaml_child(map, "sponges");
    for (size_t s = 0; s < scene->sponge_count && scene->numerics.solver != SB_SOLVER_WCSPH; s++) {
        if (scene->sponges[s].kind != SB_SPONGE_VISCOUS) continue;
        snprintf(reader->path, sizeof reader->path, "sponges[%zu]", s);
        return sb_reader_fail(reader, &list->items[s], "kind",
                              "viscous needs numerics.solver wcsph, expected damping, or that solver");
    }
    return SB_OK;
}

/* What explicit steps do not know. */
static sb_status check_explicit(sb_reader *reader, const sb_yaml *map, const sb_scene *scene)
{
    if (scene->numerics.solver != SB_SOLVER_WCSPH) return SB_OK;
    for (int side = 0; side < 4; side++)
        if (sb_scene_sea_side(scene, side))
            return sb_reader_fail(reader, map, "domain",
                                  "sides: a side of kind sea with numerics.solver wcsph, expected wall, open or "
                                  "periodic, or another solver");
    if (scene->fluid.surface_tension > 0)
        return sb_reader_fail(reader, map, "fluid",
                              "surface_tension: %g N/m with numerics.solver wcsph, expected 0, or another solver",
                              scene->fluid.surface_tension);
    if (scene->foam.enabled)
        return sb_reader_fail(reader, map, "foam",
                              "enabled: true with numerics.solver wcsph, expected false, or another solver");
    return SB_OK;
}

/* Given water needs particles, and a side. */
static sb_status check_sea(sb_reader *reader, const sb_yaml *map, const sb_scene *scene)
{
    const bool any = sb_scene_has_sea(scene);
    bool given = false;
    for (int side = 0; side < 4; side++) {
        given = given || sb_scene_given_side(scene, side);
        if (scene->given.side[side] == SB_GIVEN_STILL && !sb_scene_sea_side(scene, side))
            return sb_reader_fail(reader, map, "sea", "sides.%s: still, but domain.sides.%s is not sea, expected sea",
                                  sb_side_names[side], sb_side_names[side]);
    }
    if (any && sb_scene_grid_alone(scene))
        return sb_reader_fail(reader, map, "domain",
                              "sides: a side of kind sea needs particles, and a scene with offshore has none, expected "
                              "wall, open or periodic, or sea: {source: offshore}");
    if (given || scene->given.source == SB_GIVEN_NONE) return SB_OK;
    return sb_reader_fail(reader, map, "sea",
                          "the given water has no side to come in through, expected domain.sides with a side of kind "
                          "sea, such as {x_min: sea}, that is not still");
}

/* Cells of the grid that lie beyond a side of the domain through which its water comes in. */
static const double BEYOND = 8;

static sb_status check_cover(sb_reader *reader, const sb_yaml *map, const sb_scene *scene)
{
    const sb_offshore_settings *o = &scene->offshore;
    const double low[] = {o->x_min, o->y_min}, high[] = {o->x_max, o->y_max};
    const double from[] = {scene->domain.min.x, scene->domain.min.y}, to[] = {scene->domain.max.x, scene->domain.max.y};
    for (int side = 0; side < 2 * (scene->dimensions - 1); side++) {
        const int axis = side / 2;
        const double beyond = side % 2 ? high[axis] - to[axis] : from[axis] - low[axis];
        const double least = sb_scene_given_side(scene, side) ? BEYOND * o->cell : 0;
        if (beyond >= least - 1e-6 * o->cell) continue;
        return sb_reader_fail(reader, map, "offshore",
                              "the grid extends from %g to %g m along %c and the domain from %g to %g m, expected a "
                              "grid that contains the domain%s",
                              low[axis], high[axis], "xy"[axis], from[axis], to[axis],
                              least > 0 ? ", with eight cells beyond a side of kind sea" : "");
    }
    return SB_OK;
}

/* The grid beside the particles. */
static sb_status finish_nested(sb_reader *reader, const sb_yaml *map, sb_scene *scene)
{
    const sb_yaml *block = sb_yaml_child(map, "offshore");
    if (scene->given.source == SB_GIVEN_OFFSHORE && !scene->offshore.present)
        return sb_reader_fail(reader, map, "sea",
                              "source: offshore, but there is no block offshore, expected offshore: {cell: ...}");
    if (!sb_scene_nested(scene)) {
        if (scene->offshore.coupling == SB_COUPLING_ONE_WAY) return SB_OK;
        return sb_reader_fail(reader, map, "offshore",
                              "coupling: two-way needs particles, expected sea: {source: offshore}, or one-way");
    }
    if (!sb_yaml_child(block, "level")) scene->offshore.level = scene->sea.level;
    if (scene->given.start > 0)
        return sb_reader_fail(reader, map, "sea",
                              "start: %g s, expected at most 0 with source offshore: the grid begins before the "
                              "particles",
                              scene->given.start);
    return check_cover(reader, map, scene);
}

/* Surface tension needs particles, and does not know water beyond periodic sides. */
static sb_status check_tension(sb_reader *reader, const sb_yaml *map, const sb_scene *scene)
{
    if (!(scene->fluid.surface_tension > 0)) return SB_OK;
    if (sb_scene_grid_alone(scene))
        return sb_reader_fail(
            reader, map, "fluid",
            "surface_tension: %g N/m, but a scene with offshore alone has no particles on which it acts, expected 0",
            scene->fluid.surface_tension);
    if (sb_scene_repeats(scene, 0) || sb_scene_repeats(scene, 1))
        return sb_reader_fail(reader, map, "fluid",
                              "surface_tension: %g N/m, but domain.sides has periodic sides, at which water would end "
                              "as at air, expected "
                              "wall, open or sea, or 0",
                              scene->fluid.surface_tension);
    return SB_OK;
}

static sb_status finish_scene(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_scene *scene = item;
    if (scene->control.enabled) scene->stream.enabled = true; /* it has the run's id and sends the replies */
    sb_status status = check_explicit(reader, map, scene);
    if (status == SB_OK) status = check_sponges(reader, map, scene);
    if (status == SB_OK) status = check_sea(reader, map, scene);
    if (status == SB_OK) status = finish_nested(reader, map, scene);
    if (status == SB_OK) status = check_tension(reader, map, scene);
    if (status != SB_OK || sb_scene_grid_alone(scene)) return status;
    sb_vec3 size = sb_sub(scene->domain.max, scene->domain.min);
    double least = size.x < size.z ? size.x : size.z;
    if (scene->dimensions == 3 && size.y < least) least = size.y;
    double support = scene->numerics.support * scene->resolution;
    if (support > least)
        return sb_reader_fail(reader, map, "resolution",
                              "%g m is too coarse: the support radius is %g m and the domain is only "
                              "%g m wide, expected at most %g m",
                              scene->resolution, support, least, least / scene->numerics.support);
    return SB_OK;
}

const sb_table sb_scene_table = {SB_KEY_ROWS(scene_keys), .size = sizeof(sb_scene), .variant = scene_variant,
                                 .finish = finish_scene};
