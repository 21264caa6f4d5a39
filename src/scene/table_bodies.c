#include "scene/reader.h"

#include <math.h>
#include <string.h>

static const char *const shape_names[] = {"mesh", "grid", "box", "cylinder", "plane", "basin", NULL};
static const char *const role_names[] = {"solid", "terrain", NULL};
static const char *const positive_names[] = {"up", "down", NULL};
static const char *const up_names[] = {"z", "y", NULL};

enum {
    MESH = 1 << SB_SHAPE_MESH,
    GRID = 1 << SB_SHAPE_GRID,
    BOX = 1 << SB_SHAPE_BOX,
    CYLINDER = 1 << SB_SHAPE_CYLINDER,
    PLANE = 1 << SB_SHAPE_PLANE,
    BASIN = 1 << SB_SHAPE_BASIN,
    MOMENT = 1 << 8,
    COLOR = 1 << 9
};

static unsigned variant(const void *item, const sb_yaml *map)
{
    const sb_body *body = item;
    bool moment = map ? sb_yaml_child(map, "moment_point") != NULL : body->has_moment_point;
    bool color = map ? sb_yaml_child(map, "color") != NULL : body->color[0] >= 0;
    return 1u << body->shape | (moment ? MOMENT : 0u) | (color ? COLOR : 0u);
}

/* clang-format off */
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
     .applies = MESH | GRID, .only = "shape mesh or grid",
     .doc = "Mesh (OBJ, STL, PLY, glTF/GLB, DAE), or heights (ESRI ASCII .asc, GeoClaw topotype 1 to 3, lines of x y z)."},
    {.name = "up", .type = SB_KEY_LETTER, SB_KEY_AT(sb_body, up), .words = up_names,
     .fallback = "z", .applies = MESH, .only = "shape mesh", .doc = "The file's upward axis."},
    {.name = "scale", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_body, scale), .unit = "m",
     SB_KEY_POSITIVE, .fallback = "1", .applies = MESH | GRID, .only = "shape mesh or grid",
     .doc = "Length of one file unit."},
    {.name = "split", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_body, split), .fallback = "false",
     .applies = MESH, .only = "shape mesh",
     .doc = "Whether each named node of the file becomes a body of its own."},
    {.name = "positive", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_body, positive), .words = positive_names,
     .fallback = "up", .applies = GRID, .only = "shape grid",
     .doc = "Direction of the file's numbers: `up` for heights, `down` for depths."},
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
