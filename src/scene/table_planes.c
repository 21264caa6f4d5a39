#include "scene/table_planes.h"

#include "physics/records/eurotop.h"

#include <math.h>

sb_status sb_table_refuse_outside(sb_reader *reader, const sb_yaml *map, const char *key)
{
    return sb_reader_fail(reader, map, key, "is outside of the domain, expected inside");
}

/* Whether two intervals are disjoint. */
static bool disjoint(double a0, double a1, double b0, double b1)
{
    return !(fmax(a0, a1) >= b0 && fmin(a0, a1) <= b1);
}

bool sb_table_meets_domain(const sb_scene *scene, double ax, double ay, double bx, double by)
{
    const sb_domain *d = &scene->domain;
    return !disjoint(ax, bx, d->min.x, d->max.x) && (scene->dimensions == 2 || !disjoint(ay, by, d->min.y, d->max.y));
}

/* Shortens the plane, in 3D, to the part within an interval of one axis: water appears once more beyond periodic sides,
   and none is beyond walls. a, b: the ends along the axis; other_a, other_b: along the other one. */
static void clip(double low, double high, double *a, double *b, double *other_a, double *other_b)
{
    const double a0 = *a, b0 = *b, o0 = *other_a, p0 = *other_b;
    if (a0 == b0) return;
    const double from = (fmin(fmax(a0, low), high) - a0) / (b0 - a0), to = (fmin(fmax(b0, low), high) - a0) / (b0 - a0);
    *a = fmin(fmax(a0, low), high);
    *b = fmin(fmax(b0, low), high);
    *other_a = o0 + from * (p0 - o0);
    *other_b = to < 1 ? o0 + to * (p0 - o0) : p0;
}

enum { RECORDED = 1 };

static unsigned plane_variant(const void *item, const sb_yaml *map)
{
    (void)map;
    return ((const sb_flow_plane *)item)->record ? RECORDED : 0;
}

/* clang-format off */
static const sb_key eurotop_keys[] = {
    {.name = "height", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_eurotop_settings, height), .unit = "m",
     SB_KEY_NOT_NEGATIVE, .fallback = "0",
     .doc = "Significant height H_m0 of the incoming waves at the structure's toe; 0: the rate is not compared."},
    {.name = "crest", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_eurotop_settings, crest), .unit = "m", SB_KEY_ANY,
     .derived = "z_min of the plane", .doc = "z of the structure's crest, above water.level."},
    {.name = "slope", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_eurotop_settings, slope), .min = 0, .max = 20,
     .fallback = "0", .doc = "Tangent of the structure's smooth slope; 0: a vertical wall."},
    {.name = "period", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_eurotop_settings, period), .unit = "s",
     SB_KEY_NOT_NEGATIVE, .fallback = "0",
     .doc = "Spectral period T_m-1,0 of the waves, which is shorter than the peak period (0.91 of it for JONSWAP with "
            "gamma 3.3, 0.86 for Pierson-Moskowitz); needed for slopes up to 1:2."},
    {.name = "start", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_eurotop_settings, start), .unit = "s",
     SB_KEY_NOT_NEGATIVE, .fallback = "0", .doc = "Time from which the rate is the mean."},
};
/* clang-format on */

static const sb_table eurotop_table = {SB_KEY_ROWS(eurotop_keys), .size = sizeof(sb_eurotop_settings)};

/* clang-format off */
static const sb_key plane_keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_flow_plane, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the plane."},
    {.name = "from", .type = SB_KEY_PLACE, SB_KEY_AT(sb_flow_plane, ax), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "One end of the plane's footprint, [x, y]; [x] in 2D. The part within the domain counts."},
    {.name = "to", .type = SB_KEY_PLACE, SB_KEY_AT(sb_flow_plane, bx), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED_3D, .derived = "as `from`",
     .doc = "The other end. Flow to the right, seen from the first end, is positive (+x in 2D)."},
    {.name = "z_min", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_flow_plane, z_min), .unit = "m",
     SB_KEY_ANY, .derived = "z of domain.min", .doc = "Lower edge of the plane."},
    {.name = "z_max", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_flow_plane, z_max), .unit = "m",
     SB_KEY_ANY, .derived = "z of domain.max", .doc = "Upper edge of the plane."},
    {.name = "eurotop", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_flow_plane, eurotop), .table = &eurotop_table,
     .doc = "Compares the mean rate of overtopping with EurOtop 2018, in `eurotop.csv` and `summary.json`."},
    {.name = "record", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_flow_plane, record), .fallback = "false",
     .doc = "Whether surface and velocities over depth along the plane are written to `record.csv`, for `sea.source: "
            "record`."},
    {.name = "record_interval", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_flow_plane, record_interval), .unit = "s",
     SB_KEY_POSITIVE, .applies = RECORDED, .only = "a plane that is recorded", .derived = "measure.interval",
     .doc = "Time between rows of the record, a multiple of measure.interval."},
    {.name = "record_spacing", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_flow_plane, record_spacing), .unit = "m",
     SB_KEY_POSITIVE, .applies = RECORDED, .only = "a plane that is recorded", .derived = "4 resolution",
     .doc = "Distance of the record's points along the plane; 2D has one point."},
};
/* clang-format on */

/* Rows of a record lie on rows of the other tables. */
static sb_status finish_record(sb_reader *reader, const sb_yaml *map, sb_flow_plane *plane)
{
    const sb_scene *scene = reader->scene;
    const double interval = scene->measure.interval, most = 10000;
    if (!sb_yaml_child(map, "record_interval")) plane->record_interval = interval;
    if (!sb_yaml_child(map, "record_spacing")) plane->record_spacing = 4 * scene->resolution;
    const double ratio = plane->record_interval / interval;
    if (!(ratio > 0.5 && fabs(ratio - round(ratio)) < 1e-6 * ratio))
        return sb_reader_fail(reader, map, "record_interval",
                              "%g s is not a multiple of measure.interval, expected %g s "
                              "or a multiple",
                              plane->record_interval, interval);
    const double points = hypot(plane->bx - plane->ax, plane->by - plane->ay) / plane->record_spacing;
    if (!(points <= most))
        return sb_reader_fail(reader, map, "record_spacing", "%g m makes %.0f points, expected at most %g",
                              plane->record_spacing, points, most);
    return SB_OK;
}

/* In 2D a plane is one metre wide in y, so that volumes are per metre. Only its x is used. */
static void flatten_plane(const sb_yaml *map, sb_flow_plane *plane)
{
    if (!sb_yaml_child(map, "to")) plane->bx = plane->ax;
    plane->ay = -0.5;
    plane->by = 0.5;
}

static sb_status finish_eurotop(sb_reader *reader, const sb_yaml *map, sb_flow_plane *plane)
{
    const sb_yaml *block = sb_yaml_child(map, "eurotop");
    sb_eurotop_settings *e = &plane->eurotop;
    const sb_sea *sea = &reader->scene->sea;
    if (!block) return SB_OK;
    if (!sb_yaml_child(block, "crest")) e->crest = plane->z_min;
    if (sb_yaml_child(block, "height") && e->height == 0) return SB_OK; /* not compared */
    if (!(e->height > 0))
        return sb_reader_fail(reader, map, "eurotop",
                              "height is missing, expected H_m0 of the incoming waves in metres");
    if (!sea->present)
        return sb_reader_fail(reader, map, "eurotop", "the freeboard is not known, expected water.level");
    if (!(e->crest >= sea->level))
        return sb_reader_fail(reader, map, "eurotop",
                              "a crest at %g m is below the still water at %g m, expected one above it", e->crest,
                              sea->level);
    if (!(e->crest >= plane->z_min && e->crest <= plane->z_max))
        return sb_reader_fail(reader, map, "eurotop",
                              "a crest at %g m is not at the height of the plane, expected %g to %g m", e->crest,
                              plane->z_min, plane->z_max);
    if (e->slope > 0 && e->slope <= SB_EUROTOP_STEEP && !(e->period > 0))
        return sb_reader_fail(reader, map, "eurotop",
                              "period is missing, expected T_m-1,0 of the waves in s for a slope up to 1:2");
    if (!(e->slope > 0 && e->slope <= SB_EUROTOP_STEEP) && e->period > 0)
        return sb_reader_fail(reader, map, "eurotop",
                              "period: %g s, but the rate at a %s does not depend on it, expected a slope up to 1:2, "
                              "or no period",
                              e->period, e->slope > 0 ? "steep slope" : "vertical wall");
    return SB_OK;
}

static sb_status finish_plane(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_flow_plane *plane = item;
    const sb_scene *scene = reader->scene;
    if (!sb_yaml_child(map, "z_min")) plane->z_min = scene->domain.min.z;
    if (!sb_yaml_child(map, "z_max")) plane->z_max = scene->domain.max.z;
    if (!(plane->z_min < plane->z_max))
        return sb_reader_fail(reader, map, "z_max", "%g m is not above z_min, expected > %g", plane->z_max,
                              plane->z_min);
    if (scene->dimensions == 2) flatten_plane(map, plane);
    if (scene->dimensions == 2 && plane->ax != plane->bx)
        return sb_reader_fail(reader, map, "to",
                              "x differs from that of from, expected the same "
                              "in 2D");
    if (plane->ax == plane->bx && plane->ay == plane->by)
        return sb_reader_fail(reader, map, "to", "is the same point as from, expected a different point");
    if (disjoint(plane->z_min, plane->z_max, scene->domain.min.z, scene->domain.max.z))
        return sb_table_refuse_outside(reader, map, sb_yaml_child(map, "z_min") ? "z_min" : "z_max");
    if (!sb_table_meets_domain(scene, plane->ax, plane->ay, plane->bx, plane->by))
        return sb_table_refuse_outside(reader, map, "from");
    const sb_vec3 low = scene->domain.min, high = scene->domain.max;
    if (scene->dimensions == 3) {
        clip(low.x, high.x, &plane->ax, &plane->bx, &plane->ay, &plane->by);
        if (disjoint(plane->ay, plane->by, low.y, high.y)) return sb_table_refuse_outside(reader, map, "from");
        clip(low.y, high.y, &plane->ay, &plane->by, &plane->ax, &plane->bx);
        if (plane->ax == plane->bx && plane->ay == plane->by) return sb_table_refuse_outside(reader, map, "from");
    }
    sb_status status = finish_eurotop(reader, map, plane);
    return status == SB_OK && plane->record ? finish_record(reader, map, plane) : status;
}

const sb_table sb_plane_table = {SB_KEY_ROWS(plane_keys), .size = sizeof(sb_flow_plane), .variant = plane_variant,
                                 .finish = finish_plane};

/* clang-format off */
static const sb_key runup_keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_runup_line, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the line."},
    {.name = "from", .type = SB_KEY_PLACE, SB_KEY_AT(sb_runup_line, ax), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED,
     .doc = "First end of the line, [x, y]; [x] in 2D: in the sea, or on land. The front is the distance from this "
            "point."},
    {.name = "to", .type = SB_KEY_PLACE, SB_KEY_AT(sb_runup_line, bx), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "The other end of the line."},
};
/* clang-format on */

static sb_status finish_runup(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_runup_line *line = item;
    const sb_scene *scene = reader->scene;
    if (line->ax == line->bx && (scene->dimensions == 2 || line->ay == line->by))
        return sb_reader_fail(reader, map, "to", "%s, expected a different point",
                              scene->dimensions == 2 ? "has the same x as from" : "is the same point as from");
    return sb_table_meets_domain(scene, line->ax, line->ay, line->bx, line->by)
               ? SB_OK
               : sb_table_refuse_outside(reader, map, "from");
}

const sb_table sb_runup_table = {SB_KEY_ROWS(runup_keys), .size = sizeof(sb_runup_line), .finish = finish_runup};
