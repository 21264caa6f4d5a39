#include "scene/reader.h"

#include <math.h>
#include <string.h>

static const char *const shape_names[] = {"mesh", "grid", "box", "cylinder", "plane", "basin", NULL};
static const char *const role_names[] = {"solid", "terrain", NULL};
static const char *const positive_names[] = {"up", "down", "auto", NULL};
static const char *const voids_names[] = {"keep", "fill", NULL};
static const char *const up_names[] = {"z", "y", NULL};

enum {
    MESH = 1 << SB_SHAPE_MESH,
    GRID = 1 << SB_SHAPE_GRID,
    BOX = 1 << SB_SHAPE_BOX,
    CYLINDER = 1 << SB_SHAPE_CYLINDER,
    PLANE = 1 << SB_SHAPE_PLANE,
    BASIN = 1 << SB_SHAPE_BASIN,
    MOMENT = 1 << 8,
    COLOR = 1 << 9,
    ALONE = 1 << 10, /* a grid from one file */
    STACK = 1 << 11, /* a grid from several files */
    WINDOW = 1 << 12
};

static unsigned variant(const void *item, const sb_yaml *map)
{
    const sb_body *body = item;
    bool moment = map ? sb_yaml_child(map, "moment_point") != NULL : body->has_moment_point;
    bool color = map ? sb_yaml_child(map, "color") != NULL : body->color[0] >= 0;
    bool stack = map ? sb_yaml_child(map, "files") != NULL : body->file_count > 0;
    bool window = map ? sb_yaml_child(map, "window") != NULL : body->window.present;
    unsigned files = body->shape != SB_SHAPE_GRID ? 0u : (stack ? STACK : ALONE) | (window ? WINDOW : 0u);
    return 1u << body->shape | (moment ? MOMENT : 0u) | (color ? COLOR : 0u) | files;
}

/* clang-format off */
static const sb_key file_keys[] = {
    {.name = "file", .type = SB_KEY_FILE, SB_KEY_AT(sb_grid_file, file), .flags = SB_KEY_REQUIRED,
     .doc = "Heights, in a format of `bodies[].file`."},
    {.name = "crs", .type = SB_KEY_TEXT, SB_KEY_AT(sb_grid_file, crs), .fallback = "\"\"",
     .doc = "Coordinate system of the file, as `bodies[].crs`."},
    {.name = "datum", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_grid_file, datum), .unit = "m", SB_KEY_ANY,
     .fallback = "0", .doc = "Value added to the heights of this file, in addition to that of the body."},
};
static const sb_table file_table = {SB_KEY_ROWS(file_keys), .size = sizeof(sb_grid_file), .plain = true};

static const sb_key window_keys[] = {
    {.name = "min", .type = SB_KEY_PLACE, SB_KEY_AT(sb_window, x_min), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "Corner with the smallest coordinates."},
    {.name = "max", .type = SB_KEY_PLACE, SB_KEY_AT(sb_window, x_max), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED, .doc = "Corner with the largest coordinates."},
};

static sb_status finish_window(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_window *window = item;
    window->present = true;
    if (window->x_min < window->x_max && window->y_min < window->y_max) return SB_OK;
    return sb_reader_fail(reader, map, "max", "is not above min, expected min < max");
}

static const sb_table window_table = {SB_KEY_ROWS(window_keys), .size = sizeof(sb_window), .finish = finish_window};

static const sb_key keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_body, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the body; it appears in tables and channels."},
    {.name = "shape", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_body, shape), .words = shape_names,
     .flags = SB_KEY_REQUIRED, .doc = "Shape of the body; see above."},
    {.name = "role", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_body, role), .words = role_names,
     .derived = "terrain for a grid, otherwise solid",
     .doc = "`solid`: a closed surface, solid inside. `terrain`: a surface of the ground, solid "
            "everywhere below it (mesh, grid and plane only)."},
    {.name = "report", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_body, report),
     .derived = "true for a solid, false for terrain",
     .doc = "Whether forces.csv contains this body."},
    {.name = "moment_point", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_body, moment_point), .unit = "m",
     SB_KEY_ANY, .applies = MOMENT, .derived = "centre of the footprint at the body's lowest level; y = 0 in 2D",
     .only = "moments",
     .doc = "Point that moments are taken about. It does not move with the body."},
    {.name = "color", .type = SB_KEY_COLOR, SB_KEY_AT(sb_body, color), .min = 0, .max = 1,
     .applies = COLOR, .derived = "chosen by role", .only = "pictures",
     .doc = "Colour in pictures: [red, green, blue]."},
    {.name = "file", .type = SB_KEY_FILE, SB_KEY_AT(sb_body, file), .flags = SB_KEY_REQUIRED,
     .applies = MESH | ALONE, .only = "shape mesh, or grid without files",
     .doc = "Mesh (OBJ, STL, PLY, glTF/GLB, DAE), or heights (ESRI ASCII .asc, GeoClaw topotype 1 to 3, lines of x y z, "
            "GeoTIFF .tif, NetCDF .nc or .grd)."},
    {.name = "files", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_body, files, file_count), .table = &file_table,
     .applies = STACK, .only = "shape grid", .derived = "`file` alone",
     .doc = "Stack of grids: at each place the file with the smallest cells counts. Items are blocks of keys, or file "
            "names alone."},
    {.name = "crs", .type = SB_KEY_TEXT, SB_KEY_AT(sb_body, crs), .fallback = "\"\"", .applies = ALONE,
     .only = "shape grid without files",
     .doc = "Coordinate system of the file: `EPSG:<number>` or a PROJ string. Empty: as the file states; if it states "
            "none, metres."},
    {.name = "projection", .type = SB_KEY_TEXT, SB_KEY_AT(sb_body, projection), .fallback = "\"\"", .applies = GRID,
     .only = "shape grid",
     .doc = "Coordinate system of the ground, in metres. Empty: that of the first file in metres, or the UTM zone of "
            "the middle of the finest file in degrees."},
    {.name = "origin", .type = SB_KEY_PLACE, SB_KEY_AT(sb_body, origin), .unit = "m", SB_KEY_ANY,
     .fallback = "[0, 0]", .applies = GRID, .only = "shape grid",
     .doc = "Place in the projection that becomes (0, 0), before scale, rotation and translation."},
    {.name = "window", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_body, window), .table = &window_table, .applies = WINDOW,
     .only = "shape grid", .derived = "what the domain needs",
     .doc = "Part of the ground that is used, in metres of the projection."},
    {.name = "resample", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_body, resample), .unit = "m", SB_KEY_NOT_NEGATIVE,
     .fallback = "0", .applies = GRID, .only = "shape grid",
     .doc = "Distance between the nodes of the ground. 0: those of the file, or the smallest cells of the files if "
            "they are several or projected."},
    {.name = "voids", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_body, voids), .words = voids_names, .fallback = "keep",
     .applies = GRID, .only = "shape grid",
     .doc = "Missing heights: `keep` leaves holes in the ground, `fill` interpolates from the heights around them."},
    {.name = "up", .type = SB_KEY_LETTER, SB_KEY_AT(sb_body, up), .words = up_names,
     .fallback = "z", .applies = MESH, .only = "shape mesh", .doc = "The file's upward axis."},
    {.name = "scale", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_body, scale), .unit = "m",
     SB_KEY_POSITIVE, .fallback = "1", .applies = MESH | GRID, .only = "shape mesh or grid",
     .doc = "Length of one file unit."},
    {.name = "split", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_body, split), .fallback = "false",
     .applies = MESH, .only = "shape mesh",
     .doc = "Whether each named node of the file becomes a body of its own."},
    {.name = "positive", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_body, positive), .words = positive_names,
     .fallback = "auto", .applies = GRID, .only = "shape grid",
     .doc = "Direction of the file's numbers: `up` for heights, `down` for depths; `auto` as the attribute `positive` of a "
            "NetCDF file states, otherwise `up`."},
    {.name = "datum", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_body, datum), .unit = "m", SB_KEY_ANY,
     .fallback = "0", .applies = GRID, .only = "shape grid", .doc = "Value added to all heights."},
    {.name = "min", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_body, min), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED | SB_KEY_ANY_Y, .applies = BOX | BASIN, .only = "shape box or basin",
     .doc = "Corner with the smallest coordinates."},
    {.name = "max", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_body, max), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED | SB_KEY_ANY_Y, .applies = BOX | BASIN, .only = "shape box or basin",
     .doc = "Corner with the largest coordinates."},
    {.name = "center", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_body, center), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED | SB_KEY_ANY_Y, .applies = CYLINDER | PLANE,
     .only = "shape cylinder or plane",
     .doc = "Centre of a cylinder's base, or of a plane."},
    {.name = "radius", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_body, radius), .unit = "m", .min = 0,
     .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED, .applies = CYLINDER,
     .only = "shape cylinder", .doc = "Radius of the cylinder."},
    {.name = "height", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_body, height), .unit = "m", .min = 0,
     .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED, .applies = CYLINDER,
     .only = "shape cylinder", .doc = "Height of the upright cylinder."},
    {.name = "normal", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_body, normal), SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED | SB_KEY_UNIT, .applies = PLANE, .only = "shape plane",
     .doc = "Vector towards the water, of any length. The space behind the plane is solid."},
    {.name = "width", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_body, width), .unit = "m", .min = 0,
     .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED_3D, .applies = PLANE,
     .derived = "the slice's width", .only = "shape plane",
     .doc = "Horizontal extent of the plane."},
    {.name = "length", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_body, length), .unit = "m", .min = 0,
     .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED, .applies = PLANE,
     .only = "shape plane",
     .doc = "Extent of the plane along its slope, perpendicular to its width."},
    {.name = "rotate", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_body, rotate), .unit = "deg",
     .min = -360, .max = 360, .flags = SB_KEY_FULL, .fallback = "[0, 0, 0]",
     .doc = "Rotation about x, then y, then z, after scale and upward axis."},
    {.name = "translate", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_body, translate), .unit = "m",
     SB_KEY_ANY, .flags = SB_KEY_ANY_Y, .fallback = "[0, 0, 0]",
     .doc = "Translation, after the rotation."},
};
/* clang-format on */

static bool extents_ordered(const sb_body *body)
{
    return body->min.x < body->max.x && body->min.y < body->max.y && body->min.z < body->max.z;
}

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_body *body = item;
    const sb_scene *scene = reader->scene;
    unsigned present = variant(body, map), shape = 1u << body->shape;
    body->has_moment_point = present & MOMENT;
    if (!(present & COLOR)) body->color[0] = body->color[1] = body->color[2] = -1;
    if (!sb_yaml_child(map, "role")) body->role = body->shape == SB_SHAPE_GRID ? SB_ROLE_TERRAIN : SB_ROLE_SOLID;
    if (body->role == SB_ROLE_TERRAIN && !(shape & (MESH | GRID | PLANE)))
        return sb_reader_fail(reader, map, "role", "a %s cannot be terrain, expected solid", shape_names[body->shape]);
    if (body->role == SB_ROLE_SOLID && body->shape == SB_SHAPE_GRID)
        return sb_reader_fail(reader, map, "role",
                              "a grid is a surface of the ground and cannot be solid, expected terrain");
    if (present & STACK && body->file_count == 0)
        return sb_reader_fail(reader, map, "files", "has no items, expected one file or more");
    if (!sb_yaml_child(map, "report")) body->report = body->role == SB_ROLE_SOLID;
    /* Bodies that are given by x and z only extend across the slice at y = 0. */
    double half_width = 2 * scene->numerics.support * scene->resolution;
    if (scene->dimensions == 2 && shape & (BOX | BASIN) && body->min.y == 0 && body->max.y == 0) {
        body->min.y = -half_width;
        body->max.y = half_width;
    }
    if (scene->dimensions == 2 && shape & PLANE && !sb_yaml_child(map, "width")) body->width = 2 * half_width;
    if (shape & (BOX | BASIN) && !extents_ordered(body))
        return sb_reader_fail(reader, map, "max", "is not above min, expected min < max");
    return SB_OK;
}

const sb_table sb_body_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_body), .variant = variant, .finish = finish};
