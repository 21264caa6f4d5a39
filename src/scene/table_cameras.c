/* The keys of cameras: fixed, along a path, following the water, on a circle, or close to a body. */
#include "scene/table_cameras.h"

#include <math.h>

static const char *const ease_names[] = {"smooth", "linear", "in", "out", NULL};
static const char *const follow_names[] = {"crest", NULL};

/* clang-format off */
static const sb_key path_keys[] = {
    {.name = "time", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera_key, time), .unit = "s",
     SB_KEY_NOT_NEGATIVE, .flags = SB_KEY_REQUIRED,
     .doc = "Time at which the camera is at this place; later than the previous entry."},
    {.name = "eye", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_camera_key, eye), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED | SB_KEY_FULL, .doc = "Position of the camera."},
    {.name = "target", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_camera_key, target), .unit = "m",
     SB_KEY_ANY, .flags = SB_KEY_REQUIRED | SB_KEY_FULL, .doc = "Point at which the camera looks."},
    {.name = "fov", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera_key, fov), .unit = "deg", .min = 1,
     .max = 170, .fallback = "45", .doc = "Vertical angle of view."},
    {.name = "ease", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_camera_key, ease), .words = ease_names, .fallback = "smooth",
     .doc = "Motion from this place to the next one: `smooth`, without a jump of the velocity at either end; `linear`, "
            "with constant velocity; `in`, from rest; `out`, to rest."},
};
/* clang-format on */

static sb_status finish_view(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_camera_key *key = item;
    if (sb_norm(sb_sub(key->target, key->eye)) > 0) return SB_OK;
    return sb_reader_fail(reader, map, "target", "is the same point as eye, expected a different point");
}

static const sb_table path_table = {SB_KEY_ROWS(path_keys), .size = sizeof(sb_camera_key), .finish = finish_view};
/* Eye and target of a fixed camera. */
static const sb_table view_table = {.keys = path_keys + 1, .count = 2, .size = sizeof(sb_camera_key)};

enum { GIVEN_PERIOD = 1, GIVEN_TURNS = 2 };

/* A written scene has the period only, so that its circle does not depend on a duration that is changed later. */
static unsigned orbit_variant(const void *item, const sb_yaml *map)
{
    (void)item;
    return map && sb_yaml_child(map, "turns") ? GIVEN_TURNS : GIVEN_PERIOD;
}

/* clang-format off */
static const sb_key orbit_keys[] = {
    {.name = "target", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_orbit, target), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED | SB_KEY_FULL, .doc = "Point at which the camera looks; the circle's axis passes it."},
    {.name = "radius", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_orbit, radius), .unit = "m", SB_KEY_POSITIVE | SB_KEY_REQUIRED,
     .doc = "Radius of the circle."},
    {.name = "height", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_orbit, height), .unit = "m", SB_KEY_ANY, .fallback = "0",
     .doc = "Height of the circle above the target."},
    {.name = "period", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_orbit, period), .unit = "s", SB_KEY_ANY,
     .applies = GIVEN_PERIOD, .flags = SB_KEY_REQUIRED, .only = "an orbit without turns",
     .doc = "Time of one turn, not 0; counter-clockwise seen from above, or clockwise if it is negative."},
    {.name = "turns", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_orbit, turns), SB_KEY_ANY, .applies = GIVEN_TURNS,
     .flags = SB_KEY_REQUIRED, .only = "an orbit without period",
     .doc = "Number of turns in the run's duration, not 0, instead of the period. A run with another duration has "
            "another circle, so it cannot be resumed to a later end."},
    {.name = "from", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_orbit, from), .unit = "deg", SB_KEY_ANY, .fallback = "0",
     .doc = "Direction from the target to the camera at t = 0: 0 is +x, 90 is +y."},
};
/* clang-format on */

static sb_status finish_orbit(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_orbit *orbit = item;
    const bool turns = orbit_variant(orbit, map) == GIVEN_TURNS;
    const char *key = turns ? "turns" : "period";
    if (!(fabs(turns ? orbit->turns : orbit->period) > 0))
        return sb_reader_fail(reader, map, key, "0, expected another number");
    if (turns) orbit->period = reader->scene->duration / orbit->turns;
    orbit->turns = 0; /* the period says it all: what is written and read again is the same */
    if (!isfinite(orbit->period)) return sb_reader_fail(reader, map, key, "too small, expected a larger number");
    return SB_OK;
}

static const sb_table orbit_table = {SB_KEY_ROWS(orbit_keys), .size = sizeof(sb_orbit), .variant = orbit_variant,
                                     .finish = finish_orbit};

enum { FIXED = 1, PATH = 2, FOLLOW = 4, ORBIT = 8, CLOSEUP = 16, SLICED = 32 };

static unsigned kind_variant(const void *item, const sb_yaml *map)
{
    const sb_camera *camera = item;
    static const unsigned kinds[] = {
        [SB_CAMERA_FOLLOW] = FOLLOW, [SB_CAMERA_ORBIT] = ORBIT, [SB_CAMERA_CLOSEUP] = CLOSEUP};
    if (!map && camera->kind != SB_CAMERA_KEYS) return kinds[camera->kind];
    if (!map) return camera->key_count > 1 ? PATH : FIXED;
    if (sb_yaml_child(map, "path")) return PATH;
    if (sb_yaml_child(map, "orbit")) return ORBIT;
    if (sb_yaml_child(map, "closeup")) return CLOSEUP;
    return sb_yaml_child(map, "follow") ? FOLLOW : FIXED;
}

static unsigned camera_variant(const void *item, const sb_yaml *map)
{
    const sb_camera *camera = item;
    const bool sliced = map ? sb_yaml_child(map, "slice") != NULL : sb_norm(camera->slice.normal) > 0;
    return kind_variant(item, map) | (sliced ? SLICED : 0);
}

static const char *const style_words[] = {"surface", "particles", NULL};
static const char *const color_words[] = {"speed",         "pressure",      "vorticity", "depth",
                                          "momentum_flux", "density_error", NULL};

/* clang-format off */
static const sb_key slice_keys[] = {
    {.name = "point", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_slice, point), .unit = "m", SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED | SB_KEY_FULL, .doc = "A point of the plane."},
    {.name = "normal", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_slice, normal), SB_KEY_ANY,
     .flags = SB_KEY_REQUIRED | SB_KEY_FULL,
     .doc = "Direction across the plane, of any length but 0; [0, 0, 1] is a horizontal plane."},
    {.name = "behind", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_slice, behind), .fallback = "true",
     .doc = "Whether what lies behind the plane is drawn, or only the plane."},
    {.name = "field", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_slice, field), .words = color_words,
     .derived = "the camera's `color`", .doc = "Field that colours the cut water; one that is not `color` has a legend of its own."},
    {.name = "field_min", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_slice, field_min), SB_KEY_ANY,
     .derived = "`color_min`, or 0 with another field", .doc = "Value at the lower end of its colour map, in the field's unit."},
    {.name = "field_max", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_slice, field_max), SB_KEY_ANY,
     .derived = "`color_max`, or 0 with another field",
     .doc = "Value at the upper end, above field_min; 0 with field_min 0: chosen for the scene."},
    {.name = "vectors", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_slice, vectors), .unit = "m", SB_KEY_NOT_NEGATIVE,
     .fallback = "0", .doc = "Distance between arrows that show the velocity within the plane; 0: no arrows."},
    {.name = "vector_speed", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_slice, vector_speed), .unit = "m/s",
     SB_KEY_NOT_NEGATIVE, .fallback = "0", .doc = "Speed whose arrow is as long as the arrows are apart; 0: sqrt(g D) / 2."},
    {.name = "streamlines", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_slice, streamlines), .unit = "m",
     SB_KEY_NOT_NEGATIVE, .fallback = "0",
     .doc = "Distance between lines along the velocity within the plane; 0: no lines."},
};
/* clang-format on */

/* Refuses a distance that would need more than a million arrows or lines. */
static sb_status check_distance(sb_reader *reader, const sb_yaml *map, const char *key, double distance)
{
    const double least = 1e-3 * sb_norm(sb_sub(reader->scene->domain.max, reader->scene->domain.min));
    if (distance == 0 || distance >= least) return SB_OK;
    return sb_reader_fail(reader, map, key, "%g, expected 0 or at least %.3g m, 1/1000 of the domain's diagonal",
                          distance, least);
}

static sb_status finish_slice(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_slice *slice = item;
    if (!(sb_norm(slice->normal) > 0))
        return sb_reader_fail(reader, map, "normal", "has length 0, expected a direction");
    sb_status status = check_distance(reader, map, "vectors", slice->vectors);
    return status == SB_OK ? check_distance(reader, map, "streamlines", slice->streamlines) : status;
}

static const sb_table slice_table = {SB_KEY_ROWS(slice_keys), .size = sizeof(sb_slice), .finish = finish_slice};

/* clang-format off */
static const sb_key camera_keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_camera, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the camera; its folder and film have this name."},
    {.name = "path", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_camera, keys, key_count),
     .table = &path_table, .applies = PATH, .only = "a moving camera", .derived = "a fixed camera",
     .doc = "Path of a moving camera: two or more places with times."},
    {.type = SB_KEY_LIST, SB_KEY_ITEMS(sb_camera, keys, key_count), .table = &view_table,
     .applies = FIXED | FOLLOW, .only = "a camera without path, orbit or closeup"},
    {.name = "fov", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera, fov), .unit = "deg", .min = 1, .max = 170,
     .fallback = "45", .applies = FIXED | FOLLOW | ORBIT | CLOSEUP, .only = "a camera without path",
     .doc = "Vertical angle of view."},
    {.name = "follow", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_camera, follow.what), .words = follow_names,
     .applies = FOLLOW, .derived = "the camera does not follow", .only = "a camera without path, orbit or closeup",
     .doc = "`crest`: the target moves along a line with the highest water near it. `target` and `eye` are then those "
            "for a crest beside `target`."},
    {.name = "from", .type = SB_KEY_PLACE, SB_KEY_AT(sb_camera, follow.ax), .unit = "m", SB_KEY_ANY, .applies = FOLLOW,
     .derived = "x of domain.min, middle in y", .only = "a camera that follows", .doc = "One end of the line, [x, y]; [x] in 2D."},
    {.name = "to", .type = SB_KEY_PLACE, SB_KEY_AT(sb_camera, follow.bx), .unit = "m", SB_KEY_ANY, .applies = FOLLOW,
     .derived = "x of domain.max, middle in y", .only = "a camera that follows", .doc = "The other end."},
    {.name = "width", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera, follow.width), .unit = "m", SB_KEY_NOT_NEGATIVE,
     .fallback = "0", .applies = FOLLOW, .only = "a camera that follows",
     .doc = "Width of the strip along the line whose water counts; 0: all water beside the line."},
    {.name = "smoothing", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera, follow.smoothing), .unit = "s",
     SB_KEY_NOT_NEGATIVE, .applies = FOLLOW, .derived = "length of the line / (20 sqrt(g times the height of the domain))", .only = "a camera that follows",
     .doc = "Time within which the camera follows a change; 0: at once."},
    {.name = "travel", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_camera, follow.travel), .fallback = "false",
     .applies = FOLLOW, .only = "a camera that follows", .doc = "Whether the eye moves with the target; else it turns only."},
    {.name = "orbit", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_camera, orbit), .table = &orbit_table, .applies = ORBIT,
     .only = "a camera on a circle", .derived = "no circle",
     .doc = "Circle about a vertical axis along which the camera moves, instead of eye and target."},
    {.name = "closeup", .type = SB_KEY_NAME, SB_KEY_AT(sb_camera, body), .applies = CLOSEUP, .derived = "no close-up",
     .only = "a camera close to a body", .doc = "Body that fills the picture, instead of eye and target. The camera moves with it."},
    {.name = "direction", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_camera, direction), SB_KEY_ANY, .applies = CLOSEUP,
     .flags = SB_KEY_FULL, .fallback = "[-0.6, -0.7, 0.4]", .only = "a camera close to a body",
     .doc = "Direction from the body to the camera, of any length but 0."},
    {.name = "margin", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera, margin), .min = 1, .max = 100, .applies = CLOSEUP,
     .fallback = "1.4", .only = "a camera close to a body",
     .doc = "Distance of the camera, divided by that at which the body's box just fits into the picture."},
    {.name = "style", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_camera, style), .words = style_words,
     .fallback = "surface", .doc = "How the water is drawn: a smooth surface, or its particles as spheres."},
    {.name = "color", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_camera, color), .words = color_words,
     .fallback = "speed", .doc = "Field that colours the water; see [pictures](pictures.md#colours)."},
    {.name = "color_min", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera, color_min), SB_KEY_ANY, .fallback = "0",
     .doc = "Value at the lower end of the colour map, in the field's unit."},
    {.name = "color_max", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera, color_max), SB_KEY_ANY, .fallback = "0",
     .doc = "Value at the upper end, above color_min; 0 with color_min 0: chosen for the scene."},
    {.name = "slice", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_camera, slice), .table = &slice_table, .applies = SLICED,
     .derived = "no plane", .only = "a camera with a slice",
     .doc = "Plane through the water that shows a field on it. What lies between it and the eye is not drawn; see [pictures](pictures.md#slices)."},
};
/* clang-format on */

static sb_status finish_path(sb_reader *reader, const sb_yaml *map, const sb_camera *camera)
{
    if (camera->key_count < 2)
        return sb_reader_fail(reader, map, "path", "has %zu entries, expected at least 2, or eye and target instead",
                              camera->key_count);
    for (size_t i = 1; i < camera->key_count; i++)
        if (!(camera->keys[i].time > camera->keys[i - 1].time))
            return sb_reader_fail(reader, map, "path",
                                  "time %g s of entry %zu is not later than %g s of the entry before, "
                                  "expected increasing times",
                                  camera->keys[i].time, i, camera->keys[i - 1].time);
    return SB_OK;
}

static sb_status finish_follow(sb_reader *reader, const sb_yaml *map, sb_follow *follow)
{
    const sb_scene *scene = reader->scene;
    const sb_domain *domain = &scene->domain;
    const double y = 0.5 * (domain->min.y + domain->max.y);
    const bool from = sb_yaml_child(map, "from"), to = sb_yaml_child(map, "to");
    if (!from) follow->ax = domain->min.x;
    if (!from) follow->ay = y;
    if (!to) follow->bx = domain->max.x;
    if (!to) follow->by = y;
    const double length = hypot(follow->bx - follow->ax, follow->by - follow->ay);
    /* A twentieth of the time in which a long wave of this depth runs along the line. */
    const double speed = sqrt(scene->fluid.gravity * (domain->max.z - domain->min.z));
    if (!sb_yaml_child(map, "smoothing")) follow->smoothing = speed > 0 ? length / (20 * speed) : 0;
    if (length > scene->resolution) return SB_OK;
    return sb_reader_fail(reader, map, "to", "is within a spacing of `from`, expected the other end of a line");
}

/* The field on the plane is that of the water unless the scene gives another one. */
static sb_status finish_field(sb_reader *reader, const sb_yaml *map, sb_camera *camera)
{
    sb_slice *slice = &camera->slice;
    const sb_yaml *given = sb_yaml_child(map, "slice");
    if (!given) return SB_OK;
    if (!sb_yaml_child(given, "field")) slice->field = camera->color;
    if (slice->field == camera->color && !sb_yaml_child(given, "field_min")) slice->field_min = camera->color_min;
    if (slice->field == camera->color && !sb_yaml_child(given, "field_max")) slice->field_max = camera->color_max;
    const bool chosen = slice->field_min == 0 && slice->field_max == 0;
    if (chosen || slice->field_max > slice->field_min) return SB_OK;
    return sb_reader_fail(reader, map, "slice", "field_max is %g, expected more than field_min, %g", slice->field_max,
                          slice->field_min);
}

static sb_status finish_camera(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_camera *camera = item;
    const bool chosen = camera->color_min == 0 && camera->color_max == 0;
    if (!chosen && !(camera->color_max > camera->color_min))
        return sb_reader_fail(reader, map, "color_max", "is %g, expected more than color_min, %g", camera->color_max,
                              camera->color_min);
    sb_status status = finish_field(reader, map, camera);
    if (status != SB_OK) return status;
    const unsigned variant = kind_variant(camera, map);
    camera->kind = variant == FOLLOW    ? SB_CAMERA_FOLLOW
                   : variant == ORBIT   ? SB_CAMERA_ORBIT
                   : variant == CLOSEUP ? SB_CAMERA_CLOSEUP
                                        : SB_CAMERA_KEYS;
    if (variant == PATH) return finish_path(reader, map, camera);
    if (variant == CLOSEUP && !sb_scene_may_have_body(reader->scene, camera->body))
        return sb_reader_no_body(reader, map, "closeup", camera->body);
    if (variant == CLOSEUP && !(sb_norm(camera->direction) > 0))
        return sb_reader_fail(reader, map, "direction", "has length 0, expected a direction");
    if (camera->key_count == 0) return SB_OK;
    camera->keys->fov = camera->fov;
    status = finish_view(reader, map, camera->keys);
    return status == SB_OK && variant == FOLLOW ? finish_follow(reader, map, &camera->follow) : status;
}

const sb_table sb_camera_table = {SB_KEY_ROWS(camera_keys), .size = sizeof(sb_camera), .variant = camera_variant,
                                  .finish = finish_camera};
