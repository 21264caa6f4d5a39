/* Tables of measurements but planes and run-up lines (table_planes.c) and reflections (table_reflections.c). */
#include "scene/scene_waves.h"
#include "scene/table_planes.h"

#include <math.h>

static bool inside(double value, double min, double max)
{
    return value >= min && value <= max;
}

static const char *const gauge_water_names[] = {"particles", "grid", NULL};

enum { CHOSEN = 1 };

/* The key is there, or was found to be needed. */
static unsigned gauge_variant(const void *item, const sb_yaml *map)
{
    const sb_gauge *gauge = item;
    return (map ? sb_yaml_child(map, "water") != NULL : gauge->water == SB_GAUGE_GRID) ? CHOSEN : 0;
}

/* clang-format off */
static const sb_key gauge_keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_gauge, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the gauge."},
    {.name = "x", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_gauge, x), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "Position, inside the domain, or of the grid that is its sea."},
    {.name = "y", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_gauge, y), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED_3D, .fallback = "0", .doc = "Position; 0 in 2D."},
    {.name = "water", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_gauge, water), .words = gauge_water_names,
     .applies = CHOSEN, .only = "particles and a grid", .derived = "particles within the domain, grid outside of it",
     .doc = "Whose water the gauge reads, with `sea.source: offshore`."},
};
/* clang-format on */

/* The key of the coordinate that is outside of the domain, or of the grid; NULL: none. */
static const char *gauge_outside(const sb_scene *scene, const sb_gauge *gauge, bool grid)
{
    const sb_domain *d = &scene->domain;
    const sb_offshore_settings *o = &scene->offshore;
    const bool x = grid ? inside(gauge->x, o->x_min, o->x_max) : inside(gauge->x, d->min.x, d->max.x);
    const bool y =
        grid ? scene->dimensions == 2 || inside(gauge->y, o->y_min, o->y_max) : inside(gauge->y, d->min.y, d->max.y);
    return !x ? "x" : !y ? "y" : NULL;
}

static sb_status finish_gauge(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_gauge *gauge = item;
    const sb_scene *scene = reader->scene;
    const bool chosen = sb_yaml_child(map, "water") != NULL;
    const char *of_domain = gauge_outside(scene, gauge, false), *of_grid = gauge_outside(scene, gauge, true);
    if (!sb_scene_nested(scene)) {
        if (chosen)
            return sb_reader_fail(reader, map, "water",
                                  "needs particles and a grid, expected a scene with sea: {source: offshore}");
        return of_domain ? sb_table_refuse_outside(reader, map, of_domain) : SB_OK;
    }
    if (!chosen) gauge->water = of_domain ? SB_GAUGE_GRID : SB_GAUGE_PARTICLES;
    if (gauge->water == SB_GAUGE_GRID && of_grid)
        return sb_reader_fail(reader, map, of_grid, "is outside of the domain and of the grid, expected inside");
    return gauge->water == SB_GAUGE_PARTICLES && of_domain ? sb_table_refuse_outside(reader, map, of_domain) : SB_OK;
}

static const sb_table gauge_table = {SB_KEY_ROWS(gauge_keys), .size = sizeof(sb_gauge), .variant = gauge_variant,
                                     .finish = finish_gauge};

/* clang-format off */
static const sb_key probe_keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_probe, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the probe."},
    {.name = "at", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_probe, at), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "Position, inside the domain."},
    {.name = "radius", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_probe, radius), .unit = "m",
     SB_KEY_NOT_NEGATIVE, .fallback = "0",
     .doc = "Radius within which particles are used; 0: the support radius, and two spacings for the pressure on a wall."},
};
/* clang-format on */

static sb_status finish_probe(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_vec3 at = ((const sb_probe *)item)->at;
    const sb_domain *domain = &reader->scene->domain;
    if (inside(at.x, domain->min.x, domain->max.x) && inside(at.y, domain->min.y, domain->max.y) &&
        inside(at.z, domain->min.z, domain->max.z))
        return SB_OK;
    return sb_table_refuse_outside(reader, map, "at");
}

static const sb_table probe_table = {SB_KEY_ROWS(probe_keys), .size = sizeof(sb_probe), .finish = finish_probe};

/* clang-format off */
static const sb_key map_keys[] = {
    {.name = "min", .type = SB_KEY_PLACE, SB_KEY_AT(sb_map, x_min), .unit = "m", SB_KEY_ANY,
     .derived = "that of the domain", .doc = "Corner with the smallest x and y; [x] in 2D."},
    {.name = "max", .type = SB_KEY_PLACE, SB_KEY_AT(sb_map, x_max), .unit = "m", SB_KEY_ANY,
     .derived = "that of the domain", .doc = "Corner with the largest x and y; [x] in 2D."},
    {.name = "cell", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_map, cell), .unit = "m", SB_KEY_POSITIVE,
     .derived = "2 resolution", .doc = "Edge length of a cell."},
    {.name = "threshold", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_map, threshold), .unit = "m",
     SB_KEY_POSITIVE, .derived = "resolution",
     .doc = "Depth at the start, or later rise above it, that counts as arrival."},
};
/* clang-format on */

static void fill_map(const sb_scene *scene, const sb_yaml *map, sb_map *grid)
{
    if (!sb_yaml_child(map, "min")) {
        grid->x_min = scene->domain.min.x;
        grid->y_min = scene->domain.min.y;
    }
    if (!sb_yaml_child(map, "max")) {
        grid->x_max = scene->domain.max.x;
        grid->y_max = scene->domain.max.y;
    }
    if (!sb_yaml_child(map, "cell")) grid->cell = 2 * scene->resolution;
    if (!sb_yaml_child(map, "threshold")) grid->threshold = scene->resolution;
    if (scene->dimensions == 2) { /* one row of cells */
        grid->y_min = -0.5 * grid->cell;
        grid->y_max = 0.5 * grid->cell;
    }
}

static sb_status finish_map(sb_reader *reader, const sb_yaml *map, void *item)
{
    const double most = 2e7;
    sb_map *grid = item;
    fill_map(reader->scene, map, grid);
    grid->present = true;
    double width = grid->x_max - grid->x_min, height = grid->y_max - grid->y_min;
    if (!(width > 0 && height > 0)) return sb_reader_fail(reader, map, "max", "is not above min, expected min < max");
    if (!(ceil(width / grid->cell) * ceil(height / grid->cell) <= most))
        return sb_reader_fail(reader, map, "cell", "%g m would make more than %g cells, expected larger cells",
                              grid->cell, most);
    return sb_table_meets_domain(reader->scene, grid->x_min, grid->y_min, grid->x_max, grid->y_max)
               ? SB_OK
               : sb_table_refuse_outside(reader, map, "min");
}

static const sb_table map_table = {SB_KEY_ROWS(map_keys), .size = sizeof(sb_map), .finish = finish_map};

/* clang-format off */
static const sb_key waves_keys[] = {
    {.name = "start", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wave_settings, start), .unit = "s", SB_KEY_NOT_NEGATIVE,
     .fallback = "0", .doc = "Time from which rows are used: when the waves have passed the gauges."},
    {.name = "period", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wave_settings, period), .unit = "s", SB_KEY_NOT_NEGATIVE,
     .derived = "that of the scene's regular waves, or 0", .doc = "Period of the first of five harmonics; 0: no harmonics."},
};
/* clang-format on */

static sb_status finish_waves(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_wave_settings *settings = item;
    const sb_scene_waves waves = sb_scene_waves_of(reader->scene);
    settings->present = true;
    if (!sb_yaml_child(map, "period") && waves.regular) settings->period = waves.period;
    return SB_OK;
}

static const sb_table waves_table = {SB_KEY_ROWS(waves_keys), .size = sizeof(sb_wave_settings), .finish = finish_waves};

enum { MAP = 1, WAVES = 2 };

static unsigned measure_variant(const void *item, const sb_yaml *map)
{
    bool present = map ? sb_yaml_child(map, "map") != NULL : ((const sb_measure_settings *)item)->map.present;
    bool waves = map ? sb_yaml_child(map, "waves") != NULL : ((const sb_measure_settings *)item)->waves.present;
    return (present ? MAP : 0) | (waves ? WAVES : 0);
}

/* clang-format off */
static const sb_key measure_keys[] = {
    {.name = "interval", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_measure_settings, interval),
     .unit = "s", SB_KEY_POSITIVE, .fallback = "0.1",
     .doc = "Time between rows of forces, gauges and probes. Forces are means over the interval, "
            "and peaks in `summary.json` are the largest of these means. An incomplete last "
            "interval has no row."},
    {.name = "gauges", .type = SB_KEY_LIST,
     SB_KEY_ITEMS(sb_measure_settings, gauges, gauge_count), .table = &gauge_table,
     .doc = "Gauges of the water surface's elevation: above the still-water level `water.level` (empty without one), and "
            "absolute."},
    {.name = "probes", .type = SB_KEY_LIST,
     SB_KEY_ITEMS(sb_measure_settings, probes, probe_count), .table = &probe_table,
     .doc = "Probes of velocity and pressure at a point. On a wall the pressure is a mean over the interval."},
    {.name = "planes", .type = SB_KEY_LIST,
     SB_KEY_ITEMS(sb_measure_settings, planes, plane_count), .table = &sb_plane_table,
     .doc = "Vertical planes through which volumes are measured, for example overtopping."},
    {.name = "runups", .type = SB_KEY_LIST,
     SB_KEY_ITEMS(sb_measure_settings, runups, runup_count), .table = &sb_runup_table,
     .doc = "Lines along which run-up and front are measured, of the water that is connected with the water at the "
            "line's first end. Other water on the line is measured separately."},
    {.name = "reflections", .type = SB_KEY_LIST,
     SB_KEY_ITEMS(sb_measure_settings, reflections, reflection_count), .table = &sb_reflection_table,
     .doc = "Sets of gauges from which incident and reflected waves are found."},
    {.name = "map", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_measure_settings, map), .table = &map_table,
     .applies = MAP, .only = "maps", .derived = "no maps",
     .doc = "Maps of greatest depth, speed, momentum flux and of arrival time on a horizontal "
            "grid; `map: {}` uses all defaults."},
    {.name = "waves", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_measure_settings, waves), .table = &waves_table,
     .flags = SB_KEY_FREE, .applies = WAVES, .only = "waves at gauges", .derived = "none",
     .doc = "Heights and periods of the waves at all gauges by zero crossings, at the end of the run; `waves: {}` uses "
            "all rows."},
};
/* clang-format on */

static sb_status finish_measure(sb_reader *reader, const sb_yaml *map, void *item)
{
    return sb_reader_interval(reader, map, "interval", ((const sb_measure_settings *)item)->interval);
}

const sb_table sb_measure_table = {SB_KEY_ROWS(measure_keys), .size = sizeof(sb_measure_settings),
                                   .variant = measure_variant, .finish = finish_measure};
