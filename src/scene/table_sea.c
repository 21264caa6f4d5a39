#include "physics/waves/breaking.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/solitary_exact.h"
#include "scene/reader.h"

#include <math.h>

static const char *const source_names[] = {"none", "theory", "table", "record", "offshore", NULL};
static const char *const given_wave_names[] = {"solitary", "regular", "components", NULL};
static const char *const order_names[] = {"auto", "linear", "second-order", "cnoidal", NULL};
static const char *const solitary_names[] = {"third-order", "boussinesq", "exact", NULL};
static const char *const given_side_names[] = {"given", "still", NULL};
static const char *const unit_names[] = {"m", "cm", "mm", "ft", NULL};

enum { SOLITARY = 1, REGULAR = 2, COMPONENTS = 4, TABLE = 8, RECORD = 16, THEORY = 32, GIVEN = 64 };

static unsigned variant(const void *item, const sb_yaml *map)
{
    (void)map;
    const sb_given_sea *given = item;
    switch (given->source) {
    case SB_GIVEN_NONE:
        return 0;
    case SB_GIVEN_THEORY:
        return GIVEN | THEORY | 1u << given->wave;
    case SB_GIVEN_TABLE:
        return GIVEN | TABLE;
    case SB_GIVEN_RECORD:
        return GIVEN | RECORD;
    case SB_GIVEN_OFFSHORE:
        break;
    }
    return GIVEN;
}

/* clang-format off */
static const sb_key component_keys[] = {
    {.name = "amplitude", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_component, amplitude), .unit = "m",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_REQUIRED | SB_KEY_ABOVE, .doc = "Amplitude, half of the height."},
    {.name = "period", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_component, period), .unit = "s",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_REQUIRED | SB_KEY_ABOVE, .doc = "Period."},
    {.name = "direction", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_component, direction), .unit = "deg",
     .min = -360, .max = 360, .fallback = "0", .doc = "Direction of travel, from +x towards +y."},
    {.name = "phase", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_component, phase), .unit = "deg", .min = -360,
     .max = 360, .fallback = "0", .doc = "Phase at the origin at `start`; 0: a crest."},
};
/* clang-format on */

static const sb_table component_table = {SB_KEY_ROWS(component_keys), .size = sizeof(sb_given_component)};

#define GIVEN_SIDE(index, side)                                                                                        \
    {                                                                                                                  \
        .name = side, .type = SB_KEY_CHOICE, .offset = (index) * sizeof(sb_given_side), .words = given_side_names,     \
        .fallback = "given", .doc = "The water at " side ", if it is of kind `sea`."                                   \
    }

static const sb_key given_side_keys[] = {GIVEN_SIDE(SB_X_MIN, "x_min"), GIVEN_SIDE(SB_X_MAX, "x_max"),
                                         GIVEN_SIDE(SB_Y_MIN, "y_min"), GIVEN_SIDE(SB_Y_MAX, "y_max")};
static const sb_table given_side_table = {SB_KEY_ROWS(given_side_keys)};

#define WAVE_NUMBER(key, unit_, bits, only_, doc_)                                                                     \
    {                                                                                                                  \
        .name = #key, .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_sea, key), .unit = unit_, .min = 0, .max = HUGE_VAL,   \
        .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED, .applies = bits, .only = only_, .doc = doc_                           \
    }

/* clang-format off */
static const sb_key keys[] = {
    {.name = "source", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_given_sea, source), .words = source_names,
     .fallback = "none",
     .doc = "Where the given water comes from: `theory`, a `table`, the `record` of an earlier run, or the depth-averaged "
            "model of the block `offshore`; `none`: still water."},
    {.name = "level", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_sea, level), .unit = "m", SB_KEY_ANY,
     .applies = GIVEN, .only = "a source", .derived = "water.level",
     .doc = "Still-water level of the given water; with source offshore only of sides that are `still`: that of the "
            "grid is `offshore.level`."},
    {.name = "start", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_sea, start), .unit = "s", SB_KEY_ANY,
     .applies = GIVEN, .only = "a source", .fallback = "0",
     .doc = "Time of the run at which the source has 0 s. -600 begins a run at 600 s of a table."},
    {.name = "sides", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_given_sea, side), .table = &given_side_table,
     .applies = GIVEN, .only = "a source",
     .doc = "Sides of kind `sea` at which the water is that of the source (`given`), and those at which it is `still`, "
            "and only lets waves out."},
    {.name = "wave", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_given_sea, wave), .words = given_wave_names,
     .flags = SB_KEY_REQUIRED, .applies = THEORY, .only = "source theory",
     .doc = "Kind of wave: `solitary`, `regular`, or a sum of linear `components`."},
    WAVE_NUMBER(depth, "m", THEORY, "source theory", "Still-water depth of the theory."),
    WAVE_NUMBER(height, "m", SOLITARY | REGULAR, "a solitary or regular wave", "Wave height H, trough to crest."),
    WAVE_NUMBER(period, "s", REGULAR, "regular waves", "Wave period."),
    {.name = "order", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_given_sea, order), .words = order_names,
     .applies = REGULAR, .only = "regular waves", .fallback = "auto",
     .doc = "Theory of regular waves; `auto`: `second-order` where H L^2/d^3 < 26.3, otherwise `cnoidal`."},
    {.name = "theory", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_given_sea, theory), .words = solitary_names,
     .applies = SOLITARY, .only = "a solitary wave", .fallback = "exact",
     .doc = "Theory of a solitary wave: `exact`, the wave of the full equations, computed for H/h from 0.001 to 0.7, or "
            "`third-order` and `boussinesq` as in water.wave."},
    {.name = "direction", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_sea, direction), .unit = "deg", .min = -360,
     .max = 360, .applies = SOLITARY | REGULAR, .only = "a solitary or regular wave", .fallback = "0",
     .doc = "Direction of travel, from +x towards +y; 0 or 180 in 2D."},
    {.name = "components", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_given_sea, components, component_count),
     .table = &component_table, .applies = COMPONENTS, .only = "a sum of components",
     .doc = "Linear waves that are summed; at least one."},
    {.name = "origin", .type = SB_KEY_PLACE, SB_KEY_AT(sb_given_sea, origin), .unit = "m", SB_KEY_ANY,
     .applies = THEORY, .only = "source theory", .derived = "the corner of the domain that the wave meets first",
     .doc = "Place [x, y] where the wave is at `start`: a crest of regular waves, the front of a solitary wave; [x] in 2D."},
    {.name = "ramp", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_sea, ramp), .unit = "s", SB_KEY_NOT_NEGATIVE,
     .applies = THEORY, .only = "source theory", .derived = "two (longest) periods; 0 for a solitary wave",
     .doc = "Time after `start` in which the wave grows from nothing."},
    {.name = "file", .type = SB_KEY_FILE, SB_KEY_AT(sb_given_sea, file), .flags = SB_KEY_REQUIRED,
     .applies = TABLE | RECORD, .only = "source table or record",
     .doc = "Table of surface and velocity, or `record.csv` of an earlier run."},
    {.name = "units", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_given_sea, unit), .words = unit_names, .applies = TABLE,
     .only = "source table", .fallback = "m", .doc = "Unit of lengths in the table, also in its velocities; times are in seconds."},
    {.name = "datum", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_given_sea, datum), .unit = "m", SB_KEY_ANY,
     .applies = TABLE, .only = "source table", .derived = "`level`", .doc = "z of the table's surface 0."},
    {.name = "zero", .type = SB_KEY_PLACE, SB_KEY_AT(sb_given_sea, zero), .unit = "m", SB_KEY_ANY, .applies = TABLE,
     .flags = SB_KEY_LATER,
     .only = "source table", .derived = "[0, 0]",
     .doc = "Place [x, y] of the table that is (0, 0) of the scene, as `origin` of a terrain; [x] in 2D."},
    {.name = "plane", .type = SB_KEY_NAME, SB_KEY_AT(sb_given_sea, plane), .flags = SB_KEY_REQUIRED,
     .applies = RECORD, .only = "source record", .doc = "Name of the recorded plane."},
};
/* clang-format on */

static void fill_origin(const sb_domain *domain, double direction, double origin[2])
{
    const double turn = direction * M_PI / 180;
    origin[0] = cos(turn) >= 0 ? domain->min.x : domain->max.x;
    origin[1] = sin(turn) >= 0 ? domain->min.y : domain->max.y;
}

static double longest_period(const sb_given_sea *given)
{
    double longest = given->period;
    for (size_t i = 0; i < given->component_count; i++) longest = fmax(longest, given->components[i].period);
    return longest;
}

static bool across(double degrees)
{
    return fabs(remainder(degrees, 180)) > 1e-9;
}

static sb_status check_regular(sb_reader *reader, const sb_yaml *map, const sb_given_sea *given)
{
    sb_regular_wave wave;
    sb_error why = {0};
    if (sb_regular_wave_create(given->order, given->height, given->period, given->depth, reader->scene->fluid.gravity,
                               &wave, &why) == SB_OK)
        return SB_OK;
    return sb_reader_fail(reader, map, NULL, "%s", why.text);
}

/* Refuses components that break, each alone or all together. Those that are tides count for themselves, and may be
   as high as the water is deep. */
static sb_status check_components(sb_reader *reader, const sb_yaml *map, const sb_given_sea *given)
{
    sb_sum_height all = {0};
    sb_error why = {0};
    for (size_t i = 0; i < given->component_count; i++) {
        const sb_given_component *c = &given->components[i];
        const double number = sb_wave_number(c->period, given->depth, reader->scene->fluid.gravity);
        const bool tide = sb_is_tide(2 * M_PI / number, given->depth);
        const double most = tide ? 2 * given->depth : sb_breaking_height(number, given->depth);
        if (2 * c->amplitude > most)
            return sb_reader_fail(reader, map, "components",
                                  "item %zu with an amplitude of %g m and a period of %g s on %g m %s, expected an "
                                  "amplitude of at most %.3g m",
                                  i, c->amplitude, c->period, given->depth, tide ? "uncovers the bed" : "breaks",
                                  sb_breaking_shown(0.5 * most));
        if (!tide) sb_sum_height_add(&all, c->amplitude, number);
    }
    if (sb_sum_height_check(&all, given->depth, &why) == SB_OK) return SB_OK;
    return sb_reader_fail(reader, map, "components", "%s", why.text);
}

static sb_status check_exact(sb_reader *reader, const sb_yaml *map, const sb_given_sea *given)
{
    const double lowest = SB_SOLITARY_EXACT_LOWEST * given->depth, highest = SB_SOLITARY_EXACT_HIGHEST * given->depth;
    if (given->height >= lowest && given->height <= highest) return SB_OK;
    return sb_reader_fail(reader, map, "height",
                          "%g m in a depth of %g m has no wave of `theory: exact`, expected metres from %g to %g, or "
                          "`theory: third-order`",
                          given->height, given->depth, lowest, highest);
}

static sb_status finish_theory(sb_reader *reader, const sb_yaml *map, sb_given_sea *given)
{
    const sb_scene *scene = reader->scene;
    const bool flat = scene->dimensions == 2, sum = given->wave == SB_GIVEN_COMPONENTS;
    if (sum && given->component_count == 0)
        return sb_reader_fail(reader, map, "components", "has no item, expected at least one");
    for (size_t i = 0; flat && i < given->component_count; i++)
        if (across(given->components[i].direction))
            return sb_reader_fail(reader, map, "components",
                                  "item %zu has a direction of %g deg, expected 0 or 180 in 2D", i,
                                  given->components[i].direction);
    if (flat && across(given->direction))
        return sb_reader_fail(reader, map, "direction", "%g deg leads out of the plane, expected 0 or 180 in 2D",
                              given->direction);
    if (!sb_yaml_child(map, "origin"))
        fill_origin(&scene->domain, sum ? given->components[0].direction : given->direction, given->origin);
    if (flat) given->origin[1] = 0;
    if (!sb_yaml_child(map, "ramp")) given->ramp = 2 * longest_period(given);
    if (given->wave == SB_GIVEN_SOLITARY && given->height > SB_SOLITARY_HIGHEST * given->depth * (1 + 1e-9))
        return sb_reader_fail(
            reader, map, "height",
            "%g m in a depth of %g m: a solitary wave cannot be higher than %g of its depth, expected "
            "at most %g m",
            given->height, given->depth, SB_SOLITARY_HIGHEST, SB_SOLITARY_HIGHEST * given->depth);
    if (given->wave == SB_GIVEN_SOLITARY && given->theory == SB_GIVEN_EXACT) return check_exact(reader, map, given);
    if (sum) return check_components(reader, map, given);
    return given->wave == SB_GIVEN_REGULAR ? check_regular(reader, map, given) : SB_OK;
}

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_given_sea *given = item;
    const sb_scene *scene = reader->scene;
    if (given->source == SB_GIVEN_NONE) return SB_OK;
    if (scene->offshore.present && given->source != SB_GIVEN_OFFSHORE)
        return sb_reader_fail(reader, map, "source",
                              "a scene with offshore has no particles to which this water could be given, expected no "
                              "block sea, or source: offshore");
    if (!sb_yaml_child(map, "level")) {
        if (!scene->sea.present)
            return sb_reader_fail(reader, map, "level", "missing, expected metres, or water.level");
        given->level = scene->sea.level;
    }
    if (!(given->level > scene->domain.min.z && given->level <= scene->domain.max.z))
        return sb_reader_fail(reader, map, "level", "%g m is outside of the domain, expected metres > %g and <= %g",
                              given->level, scene->domain.min.z, scene->domain.max.z);
    if (!sb_yaml_child(map, "datum")) given->datum = given->source == SB_GIVEN_TABLE ? given->level : 0;
    return given->source == SB_GIVEN_THEORY ? finish_theory(reader, map, given) : SB_OK;
}

const sb_table sb_given_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_given_sea), .variant = variant, .finish = finish};
