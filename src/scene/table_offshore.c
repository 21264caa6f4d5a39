#include "scene/reader.h"

#include <math.h>

static const char *const positive_names[] = {"up", "down", "auto", NULL};
static const char *const side_names[] = {"domain", "wall", "open", "periodic", "paddle", NULL};
static const char *const coupling_names[] = {"one-way", "two-way", NULL};

#define GRID_SIDE(index, side)                                                                                         \
    {                                                                                                                  \
        .name = side, .type = SB_KEY_CHOICE, .offset = (index) * sizeof(sb_grid_side), .words = side_names,            \
        .fallback = "domain",                                                                                          \
        .doc = "The grid's side " side "; `domain`: as that of the domain, or open where the grid extends beyond it."  \
    }

static const sb_key side_keys[] = {GRID_SIDE(SB_X_MIN, "x_min"), GRID_SIDE(SB_X_MAX, "x_max"),
                                   GRID_SIDE(SB_Y_MIN, "y_min"), GRID_SIDE(SB_Y_MAX, "y_max")};
static const sb_table side_table = {SB_KEY_ROWS(side_keys)};

#define GRID_KEYS                                                                                                      \
    {.name = "file",                                                                                                   \
     .type = SB_KEY_FILE,                                                                                              \
     SB_KEY_AT(sb_offshore_grid, file),                                                                                \
     .flags = SB_KEY_REQUIRED,                                                                                         \
     .doc = "Heights in metres: ESRI ASCII (.asc), GeoClaw topotype 1 to 3, lines of x y z, GeoTIFF .tif, or NetCDF "  \
            ".nc or .grd; a file in degrees that states so, or has `crs`, is projected to metres."},                   \
        {.name = "scale",                                                                                              \
         .type = SB_KEY_NUMBER,                                                                                        \
         SB_KEY_AT(sb_offshore_grid, scale),                                                                           \
         .unit = "m",                                                                                                  \
         SB_KEY_POSITIVE,                                                                                              \
         .fallback = "1",                                                                                              \
         .doc = "Length of one file unit."},                                                                           \
        {.name = "positive",                                                                                           \
         .type = SB_KEY_CHOICE,                                                                                        \
         SB_KEY_AT(sb_offshore_grid, positive),                                                                        \
         .words = positive_names,                                                                                      \
         .fallback = "auto",                                                                                           \
         .doc = "Direction of the file's numbers: `up` for heights, `down` for depths; `auto` as the attribute "       \
                "`positive` of a NetCDF file states, otherwise `up`."},                                                \
        {.name = "datum",                                                                                              \
         .type = SB_KEY_NUMBER,                                                                                        \
         SB_KEY_AT(sb_offshore_grid, datum),                                                                           \
         .unit = "m",                                                                                                  \
         SB_KEY_ANY,                                                                                                   \
         .fallback = "0",                                                                                              \
         .doc = "Value added to all heights."},                                                                        \
        {.name = "crs",                                                                                                \
         .type = SB_KEY_TEXT,                                                                                          \
         SB_KEY_AT(sb_offshore_grid, crs),                                                                             \
         .fallback = "\"\"",                                                                                           \
         .doc = "Coordinate system of the file, as `bodies[].crs`."},                                                  \
        {.name = "projection",                                                                                         \
         .type = SB_KEY_TEXT,                                                                                          \
         SB_KEY_AT(sb_offshore_grid, projection),                                                                      \
         .fallback = "\"\"",                                                                                           \
         .doc = "Coordinate system to which the grid is projected, in metres, such as `EPSG:32654`. Empty: that of "   \
                "the grids before it; for the first, that of a file in metres, or the UTM zone of the middle of a "    \
                "file in degrees. All grids need the same."},                                                          \
    {                                                                                                                  \
        .name = "shift", .type = SB_KEY_PLACE, SB_KEY_AT(sb_offshore_grid, x), .unit = "m", SB_KEY_ANY,                \
        .derived = "no shift", .doc = "Value added to x and y, after `scale`."                                         \
    }

static const sb_key grid_keys[] = {GRID_KEYS};

static const sb_table grid_table = {SB_KEY_ROWS(grid_keys), .size = sizeof(sb_offshore_grid), .plain = true};

enum { UPLIFT = 1, PADDLE = 2 };

static unsigned variant(const void *item, const sb_yaml *map)
{
    const sb_offshore_settings *o = item;
    const bool uplift = map ? sb_yaml_child(map, "uplift") != NULL : o->has_uplift;
    const bool paddle = map ? sb_yaml_child(map, "paddle") != NULL : o->has_paddle;
    return (uplift ? UPLIFT : 0) | (paddle ? PADDLE : 0);
}

/* clang-format off */
static const sb_key keys[] = {
    {.name = "cell", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_offshore_settings, cell), .unit = "m", .min = 0,
     .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED, .doc = "Edge of a cell."},
    {.name = "min", .type = SB_KEY_PLACE, SB_KEY_AT(sb_offshore_settings, x_min), .unit = "m", SB_KEY_ANY,
     .derived = "that of the domain", .doc = "Corner of the grid with the smallest x and y; [x] in 2D."},
    {.name = "max", .type = SB_KEY_PLACE, SB_KEY_AT(sb_offshore_settings, x_max), .unit = "m", SB_KEY_ANY,
     .derived = "that of the domain",
     .doc = "Corner of the grid with the largest x and y; [x] in 2D. Each extent is a whole number of cells."},
    {.name = "terrain", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_offshore_settings, terrain, terrain_count),
     .table = &grid_table, .derived = "the bodies",
     .doc = "Grids of the bed, coarse ones first: where a later one has heights, these count; a file name alone is a "
            "grid without other keys. Together they cover the grid. Without it, the bed is the highest surface of the "
            "bodies, or else the domain's floor."},
    {.name = "level", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_offshore_settings, level), .unit = "m", SB_KEY_ANY,
     .derived = "`water.level`; 0 without particles",
     .doc = "Still-water level: all ground below it is under water at the start."},
    {.name = "manning", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_offshore_settings, manning), .unit = "s/m^(1/3)",
     .min = 0, .max = 1, .fallback = "0.025", .doc = "Manning's number of the bed; 0: no friction."},
    {.name = "dispersion", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_offshore_settings, dispersion), .fallback = "true",
     .doc = "Serre-Green-Naghdi equations, for waves whose length is not far above the depth; `false`: shallow-water "
            "equations, at less than half of the cost."},
    {.name = "threshold", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_offshore_settings, threshold), .unit = "m",
     SB_KEY_POSITIVE, .fallback = "0.05",
     .doc = "Rise that counts as arrival in the maps, and depth from which speed and inundation count."},
    {.name = "maps", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_offshore_settings, maps), .fallback = "true",
     .doc = "Maps of the greatest depth, speed and momentum flux, of arrival and of inundation, one value per cell."},
    {.name = "drawn", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_offshore_settings, drawn), .unit = "m", .min = 0,
     .max = HUGE_VAL, .flags = SB_KEY_FREE, .derived = "half of the domain's larger horizontal extent",
     .doc = "Beside particles: distance beyond the domain to which pictures show the grid's water; 0: not at all."},
    {.name = "uplift", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_offshore_settings, uplift), .table = &grid_table,
     .applies = UPLIFT, .only = "an uplift", .derived = "none",
     .doc = "Grid of heights that are added to the still surface at the start; 0 where it has none."},
    {.name = "wave", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_offshore_settings, wave), .table = &sb_wave_table,
     .doc = "Wave at t = 0 by wave theory: `solitary` or `standing`."},
    {.name = "sides", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_offshore_settings, side), .table = &side_table,
     .doc = "Kinds of the grid's sides."},
    {.name = "paddle", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_offshore_settings, paddle), .table = &sb_grid_paddle_table,
     .applies = PADDLE, .only = "a side of kind paddle", .derived = "none",
     .doc = "Law by which the side of kind `paddle` moves water inwards; keys as those of a [wave maker](#wavemakers)."},
    {.name = "paddle_at", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_offshore_settings, paddle_at), .unit = "m", SB_KEY_ANY,
     .applies = PADDLE, .only = "a side of kind paddle", .derived = "that of the side",
     .doc = "Coordinate of the paddle's face before its motion. The side of the grid stands still: put it where the "
            "motion ends, and state here where it begins."},
    {.name = "coupling", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_offshore_settings, coupling), .words = coupling_names,
     .fallback = "one-way",
     .doc = "With `sea.source: offshore`: `one-way` gives the grid's water to the particles; `two-way` also gives the "
            "waves that leave the particles back to the grid."},
};
/* clang-format on */

/* Fails unless an extent is a whole number of cells, at least 2. */
static sb_status check_extent(sb_reader *reader, const sb_yaml *map, char axis, double extent, double cell)
{
    const double count = extent / cell, most = 1e5;
    if (!(extent > 0)) return sb_reader_fail(reader, map, "max", "is not above min, expected min < max");
    if (fabs(count - round(count)) > 1e-6 * count || count < 1.5)
        return sb_reader_fail(reader, map, "cell",
                              "the extent of %g m along %c is %.6g cells of %g m, expected a whole "
                              "number, at least 2",
                              extent, axis, count, cell);
    if (count > most)
        return sb_reader_fail(reader, map, "cell",
                              "the extent of %g m along %c is %.0f cells of %g m, expected at most "
                              "%g",
                              extent, axis, count, cell, most);
    return SB_OK;
}

/* The side of kind paddle; SB_SIDES: none. */
static int paddle_side(const sb_offshore_settings *o)
{
    int side = 0;
    while (side < 4 && o->side[side] != SB_GRID_SIDE_PADDLE) side++;
    return side < 4 ? side : SB_SIDES;
}

static sb_status finish_paddle(sb_reader *reader, const sb_yaml *map, sb_offshore_settings *o)
{
    const int side = paddle_side(o);
    const double at[] = {o->x_min, o->x_max, o->y_min, o->y_max};
    if (side == SB_SIDES && o->has_paddle)
        return sb_reader_fail(reader, map, "paddle", "no side is moved by it, expected sides: {x_min: paddle}");
    if (side == SB_SIDES) return SB_OK;
    if (reader->scene->dimensions == 2 && side >= SB_Y_MIN)
        return sb_reader_fail(reader, map, "sides", "%s: has no effect in 2D, expected a paddle at x_min or x_max",
                              sb_side_names[side]);
    if (!o->has_paddle)
        return sb_reader_fail(reader, map, "sides",
                              "%s: paddle, but there is no block offshore.paddle, expected its law, such as paddle: "
                              "{kind: goring-rayleigh, height: 1, depth: 10}",
                              sb_side_names[side]);
    for (int other = side + 1; other < 4; other++)
        if (o->side[other] == SB_GRID_SIDE_PADDLE)
            return sb_reader_fail(reader, map, "sides", "%s and %s are paddles, expected one", sb_side_names[side],
                                  sb_side_names[other]);
    if (!sb_yaml_child(map, "paddle_at")) o->paddle_at = at[side];
    return SB_OK;
}

/* Whether a side of the grid continues at the opposite one, by its own kind or by that of the domain. */
static bool is_periodic(const sb_scene *scene, const sb_offshore_settings *o, int side)
{
    const bool domain = o->side[side] == SB_GRID_SIDE_DOMAIN && scene->domain.side[side] == SB_SIDE_PERIODIC;
    return domain || o->side[side] == SB_GRID_SIDE_PERIODIC;
}

/* Refuses a periodic side without its opposite one, and a standing wave that does not fit periodic sides. */
static sb_status finish_periodic(sb_reader *reader, const sb_yaml *map, const sb_offshore_settings *o)
{
    const int last = reader->scene->dimensions == 2 ? SB_X_MAX : SB_Y_MAX;
    for (int side = SB_X_MIN; side <= last; side++)
        if (is_periodic(reader->scene, o, side) && !is_periodic(reader->scene, o, side ^ 1))
            return sb_reader_fail(reader, map, "sides", "%s is periodic, expected %s: periodic, too",
                                  sb_side_names[side], sb_side_names[side ^ 1]);
    if (o->wave.kind != SB_INITIAL_STANDING || !is_periodic(reader->scene, o, SB_X_MIN)) return SB_OK;
    return sb_initial_wave_fits(reader, map, "wave", o->wave.wavelength, "grid", o->x_max - o->x_min);
}

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_offshore_settings *o = item;
    const sb_domain *domain = &reader->scene->domain;
    o->present = true;
    o->has_uplift = variant(item, map) & UPLIFT;
    o->has_paddle = variant(item, map) & PADDLE;
    if (!(reader->scene->resolution > 0)) reader->scene->resolution = o->cell; /* there are no particles */
    if (!sb_yaml_child(map, "min")) {
        o->x_min = domain->min.x;
        o->y_min = domain->min.y;
    }
    if (!sb_yaml_child(map, "max")) {
        o->x_max = domain->max.x;
        o->y_max = domain->max.y;
    }
    if (o->wave.kind == SB_INITIAL_REGULAR || o->wave.kind == SB_INITIAL_COMPONENTS)
        return sb_reader_fail(reader, map, "wave",
                              "regular waves and components are for particles, expected solitary or standing");
    if (!sb_yaml_child(map, "drawn"))
        o->drawn = 0.5 * fmax(domain->max.x - domain->min.x, domain->max.y - domain->min.y);
    sb_status status = check_extent(reader, map, 'x', o->x_max - o->x_min, o->cell);
    if (status == SB_OK && reader->scene->dimensions == 3)
        status = check_extent(reader, map, 'y', o->y_max - o->y_min, o->cell);
    if (status == SB_OK) status = finish_periodic(reader, map, o);
    return status == SB_OK ? finish_paddle(reader, map, o) : status;
}

const sb_table sb_offshore_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_offshore_settings), .variant = variant,
                                    .finish = finish};
