#include "physics/waves/breaking.h"
#include "scene/reader.h"

#include <math.h>

/* Checks min < max in all axes of the scene's dimensions. An error names the key max. */
static sb_status ordered(sb_reader *reader, const sb_yaml *map, sb_vec3 min, sb_vec3 max)
{
    bool flat = reader->scene->dimensions == 2;
    if (min.x < max.x && min.z < max.z && (flat || min.y < max.y)) return SB_OK;
    return sb_reader_fail(reader, map, "max", "is not above min, expected min < max");
}

/* Whether a point is in the domain or on its sides. */
static bool in_domain(const sb_scene *scene, sb_vec3 point)
{
    const sb_domain *domain = &scene->domain;
    return point.x >= domain->min.x && point.x <= domain->max.x && point.y >= domain->min.y &&
           point.y <= domain->max.y && point.z >= domain->min.z && point.z <= domain->max.z;
}

/* clang-format off */
static const sb_key box_keys[] = {
    {.name = "min", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_fluid_box, min), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "Corner with the smallest coordinates."},
    {.name = "max", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_fluid_box, max), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "Corner with the largest coordinates."},
    {.name = "level", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_fluid_box, level), .unit = "m",
     SB_KEY_ANY, .derived = "z of max",
     .doc = "Free surface of the water in this box, above z of min and at most z of max."},
    {.name = "velocity", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_fluid_box, velocity), .unit = "m/s",
     SB_KEY_ANY, .fallback = "[0, 0, 0]",
     .doc = "Velocity of the water in the box at the start; at most 100 sqrt(g H), with H the "
            "height of the domain."},
};
/* clang-format on */

static sb_status finish_box(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_fluid_box *box = item;
    sb_status status = ordered(reader, map, box->min, box->max);
    if (status != SB_OK) return status;
    const char *outside = !in_domain(reader->scene, box->min)   ? "min"
                          : !in_domain(reader->scene, box->max) ? "max"
                                                                : NULL;
    if (outside) return sb_reader_fail(reader, map, outside, "is outside of the domain, expected inside");
    if (!sb_yaml_child(map, "level")) box->level = box->max.z;
    const sb_key *key = &box_keys[2];
    if (!(box->level > box->min.z && box->level <= box->max.z))
        return sb_reader_fail(reader, map, key->name, "%g m is outside of the box, expected metres > %g and <= %g",
                              box->level, box->min.z, box->max.z);
    const double speed = sb_norm(box->velocity), limit = sb_scene_speed_limit(reader->scene);
    if (!(speed <= limit))
        return sb_reader_fail(reader, map, "velocity",
                              "%g m/s is above the speed limit of the scene, expected at most %.4g m/s, 100 times "
                              "sqrt(gravity * height of the domain)",
                              speed, limit);
    return SB_OK;
}

static const sb_table box_table = {SB_KEY_ROWS(box_keys), .size = sizeof(sb_fluid_box), .finish = finish_box};

static const char *const theory_names[] = {"third-order", "boussinesq", "serre", NULL};
static const char *const wave_names[] = {"none", "solitary", "standing", "regular", "components", NULL};
static const char *const order_names[] = {"linear", "second-order", "fifth-order", NULL};
enum {
    SOLITARY = 1 << SB_INITIAL_SOLITARY,
    STANDING = 1 << SB_INITIAL_STANDING,
    REGULAR_OF_LENGTH = 1 << SB_INITIAL_REGULAR,
    COMPONENTS = 1 << SB_INITIAL_COMPONENTS,
    REGULAR_OF_PERIOD = COMPONENTS << 1,
    REGULAR = REGULAR_OF_LENGTH | REGULAR_OF_PERIOD
};

/* clang-format off */
static const sb_key component_keys[] = {
    {.name = "amplitude", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_initial_component, amplitude), .unit = "m",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED, .doc = "Amplitude, half of the height."},
    {.name = "wavelength", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_initial_component, wavelength), .unit = "m",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED,
     .doc = "Wavelength, at least four particle spacings, and one that fits a domain which is periodic in x a whole number "
            "of times."},
    {.name = "phase", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_initial_component, phase), .unit = "deg", SB_KEY_ANY,
     .fallback = "0", .doc = "Phase at `position` at t = 0; 0: a crest. It is added to k (x - position), of waves towards -x to -k (x - position)."},
    {.name = "direction", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_initial_component, direction), .min = -1, .max = 1,
     .fallback = "1", .doc = "Direction of travel: 1 towards +x, -1 towards -x; 0 is an error."},
};
/* clang-format on */

static const sb_table initial_component_table = {SB_KEY_ROWS(component_keys), .size = sizeof(sb_initial_component)};

static unsigned wave_variant(const void *item, const sb_yaml *map)
{
    const sb_initial_wave_kind kind = ((const sb_initial_wave *)item)->kind;
    if (kind == SB_INITIAL_REGULAR && map && sb_yaml_child(map, "period")) return REGULAR_OF_PERIOD;
    return 1u << kind;
}

/* clang-format off */
static const sb_key wave_keys[] = {
    {.name = "kind", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_initial_wave, kind), .words = wave_names,
     .fallback = "none", .doc = "Wave that is on the water at the start."},
    {.name = "height", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_initial_wave, height), .unit = "m",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED,
     .applies = SOLITARY | STANDING | REGULAR, .only = "kind solitary, standing or regular",
     .doc = "Height H, trough to crest; of a solitary wave at most 0.8332 of its depth; amplitude of a standing "
            "wave, less than its depth."},
    {.name = "depth", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_initial_wave, depth), .unit = "m",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED,
     .applies = SOLITARY | STANDING | REGULAR | COMPONENTS, .only = "a wave",
     .doc = "Still-water depth for the wave theory."},
    {.name = "position", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_initial_wave, position), .unit = "m",
     SB_KEY_ANY, .fallback = "0", .applies = SOLITARY | STANDING | REGULAR | COMPONENTS,
     .only = "a wave", .doc = "x of a crest; of `components`, where their phases are given."},
    {.name = "wavelength", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_initial_wave, wavelength),
     .unit = "m", .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED,
     .applies = STANDING | REGULAR_OF_LENGTH, .only = "kind standing, or kind regular without period",
     .doc = "Wavelength: of a standing wave at least two particle spacings, of regular waves at least four, and one that "
            "fits a domain which is periodic in x a whole number of times."},
    {.name = "period", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_initial_wave, period), .unit = "s", SB_KEY_POSITIVE | SB_KEY_REQUIRED,
     .applies = REGULAR_OF_PERIOD, .only = "kind regular",
     .doc = "Period, instead of the wavelength, which follows from it, the height and the depth by the theory of `order`. "
            "The wave goes through water whose mean velocity at a fixed place below its troughs is 0."},
    {.name = "direction", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_initial_wave, direction), .min = -1,
     .max = 1, .fallback = "1", .applies = SOLITARY | REGULAR, .only = "kind solitary or regular",
     .doc = "Direction of travel: 1 towards +x, -1 towards -x; 0 is an error."},
    {.name = "theory", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_initial_wave, theory), .words = theory_names,
     .fallback = "third-order", .applies = SOLITARY, .only = "kind solitary",
     .doc = "Order of the theory in height over depth: `third-order`, valid to 0.4, or "
            "`boussinesq`, first order, as many experiments are defined; or `serre`, exact for `offshore` "
            "with dispersion, whatever the height. High `boussinesq` waves lose water at their tail for a "
            "hundred depths."},
    {.name = "order", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_initial_wave, order), .words = order_names,
     .fallback = "fifth-order", .applies = REGULAR, .only = "kind regular",
     .doc = "Order of the Stokes wave in its steepness. H L^2/d^3 is below 40 for `fifth-order`, below 26.3 for "
            "`second-order`."},
    {.name = "components", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_initial_wave, components, component_count),
     .table = &initial_component_table, .applies = COMPONENTS, .only = "kind components",
     .doc = "Linear waves that are summed; at least one."},
};
/* clang-format on */

static sb_status finish_wave(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_initial_wave *wave = item;
    if (wave->kind == SB_INITIAL_SOLITARY && wave->direction == 0)
        return sb_reader_fail(reader, map, "direction", "0 is not a direction, expected 1 or -1");
    if (wave->kind == SB_INITIAL_SOLITARY && wave->height > SB_SOLITARY_HIGHEST * wave->depth * (1 + 1e-9))
        return sb_reader_fail(
            reader, map, "height",
            "%g m in a depth of %g m: a solitary wave cannot be higher than %g of its depth, expected at most %g m",
            wave->height, wave->depth, SB_SOLITARY_HIGHEST, SB_SOLITARY_HIGHEST * wave->depth);
    if (wave->kind == SB_INITIAL_STANDING && wave->height >= wave->depth)
        return sb_reader_fail(reader, map, "height", "%g m would uncover the bed, expected less than the depth of %g m",
                              wave->height, wave->depth);
    if (wave->kind == SB_INITIAL_STANDING && wave->wavelength < 2 * reader->scene->resolution)
        return sb_reader_fail(reader, map, "wavelength",
                              "%g m is too short to be resolved, expected at least two spacings, %g m",
                              wave->wavelength, 2 * reader->scene->resolution);
    const double steepest = SB_STANDING_STEEPEST * wave->wavelength * tanh(2 * M_PI * wave->depth / wave->wavelength);
    if (wave->kind == SB_INITIAL_STANDING && 2 * wave->height > steepest * (1 + 1e-9))
        return sb_reader_fail(reader, map, "height",
                              "a standing wave with an amplitude of %g m and a length of %g m on %g m breaks, expected "
                              "at most %.3g m",
                              wave->height, wave->wavelength, wave->depth, sb_breaking_shown(0.5 * steepest));
    return sb_initial_wave_finish(reader, map, wave);
}

const sb_table sb_wave_table = {SB_KEY_ROWS(wave_keys), .size = sizeof(sb_initial_wave), .variant = wave_variant,
                                .finish = finish_wave};

enum { SEA = 1 };

static unsigned water_variant(const void *item, const sb_yaml *map)
{
    bool sea = map ? sb_yaml_child(map, "level") != NULL : ((const sb_scene *)item)->sea.present;
    return sea ? SEA : 0;
}

/* clang-format off */
static const sb_key water_keys[] = {
    {.name = "level", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_scene, sea.level), .unit = "m",
     SB_KEY_ANY, .applies = SEA, .derived = "no sea", .only = "a sea",
     .doc = "Still-water level of the sea, inside the domain."},
    {.name = "seed", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_scene, sea.seed), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .applies = SEA, .only = "a sea, which needs water.level",
     .doc = "A point in the sea. The sea fills all space below the level that is connected with "
            "this point."},
    {.name = "boxes", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_scene, boxes, box_count),
     .table = &box_table, .doc = "Boxes of water, each with its own level."},
    {.name = "wave", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_scene, wave), .table = &sb_wave_table,
     .doc = "Wave at t = 0: surface and velocities by wave theory."},
};
/* clang-format on */

static sb_status finish_water(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_scene *scene = item;
    sb_sea *sea = &scene->sea;
    const sb_domain *domain = &scene->domain;
    sea->present = water_variant(scene, map) & SEA;
    if (!sea->present && scene->box_count == 0)
        return sb_reader_fail(reader, map, NULL, "contains no water, expected level and seed, or boxes");
    if (!sea->present) return SB_OK;
    if (!(sea->level > domain->min.z && sea->level <= domain->max.z))
        return sb_reader_fail(reader, map, "level", "%g m is outside of the domain, expected metres > %g and <= %g",
                              sea->level, domain->min.z, domain->max.z);
    if (!in_domain(scene, sea->seed))
        return sb_reader_fail(reader, map, "seed", "is outside of the domain, expected inside");
    if (!(sea->seed.z < sea->level))
        return sb_reader_fail(reader, map, "seed", "z %g m is not below the level, expected < %g", sea->seed.z,
                              sea->level);
    return SB_OK;
}

const sb_table sb_water_table = {SB_KEY_ROWS(water_keys), .size = sizeof(sb_scene), .variant = water_variant,
                                 .finish = finish_water};
