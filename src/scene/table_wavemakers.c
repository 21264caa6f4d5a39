#include "base/nearest.h"
#include "scene/reader.h"

#include <math.h>
#include <string.h>

static const char *const start_names[] = {"command", NULL};
static const char *const after_names[] = {"stay", "return", NULL};

enum { RETURNS = 1 << 16 };

static unsigned variant(const void *item, const sb_yaml *map)
{
    (void)map;
    const sb_wavemaker_parameters *law = &((const sb_wavemaker_use *)item)->law;
    return (law->kind ? law->kind->needs : 0u) | (law->after == SB_AFTER_RETURN ? RETURNS : 0u);
}

#define LAW_NUMBER(key, unit_, bit, only_, doc_)                                                                       \
    {                                                                                                                  \
        .name = #key, .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wavemaker_use, law.key), .unit = unit_, .min = 0,            \
        .max = HUGE_VAL, .flags = SB_KEY_ABOVE | SB_KEY_REQUIRED, .applies = bit, .only = only_, .doc = doc_           \
    }

/* clang-format off */
static const sb_key keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_wavemaker_use, name),
     .flags = SB_KEY_REQUIRED, .doc = "Unique name of the wave maker."},
    {.name = "body", .type = SB_KEY_NAME, SB_KEY_AT(sb_wavemaker_use, body),
     .flags = SB_KEY_REQUIRED, .doc = "Name of the body that the wave maker moves."},
    {.name = "kind", .type = SB_KEY_LAW, SB_KEY_AT(sb_wavemaker_use, law.kind),
     .flags = SB_KEY_REQUIRED,
     .doc = "Law of the motion; `shorebreak list wavemakers` describes the laws."},
    {.name = "direction", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_wavemaker_use, direction),
     SB_KEY_ANY, .flags = SB_KEY_UNIT, .fallback = "[1, 0, 0]",
     .doc = "Direction of the motion, of any length."},
    {.name = "start", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wavemaker_use, law.start), .unit = "s",
     SB_KEY_NOT_NEGATIVE, .words = start_names, .fallback = "0",
     .doc = "Time at which the motion begins; `command`: when the command `trigger` is given."},
    LAW_NUMBER(height, "m", SB_WM_HEIGHT, "laws that need a wave height", "Wave height H."),
    LAW_NUMBER(depth, "m", SB_WM_DEPTH, "laws that need a depth",
           "Still-water depth at the paddle."),
    LAW_NUMBER(stroke, "m", SB_WM_STROKE, "laws that need a stroke",
           "Total displacement of the stroke."),
    LAW_NUMBER(speed, "m/s", SB_WM_SPEED, "laws that need a speed", "Top speed of the stroke."),
    {.name = "file", .type = SB_KEY_FILE, SB_KEY_AT(sb_wavemaker_use, law.file),
     .flags = SB_KEY_REQUIRED, .applies = SB_WM_FILE, .only = "laws that need a file",
     .doc = "Table of times and displacements."},
    {.name = "after", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_wavemaker_use, law.after),
     .words = after_names, .fallback = "stay",
     .doc = "Motion after the stroke: `stay` at its end, or `return` to the start."},
    LAW_NUMBER(return_time, "s", RETURNS, "after: return", "Duration of the return."),
};
/* clang-format on */

bool sb_scene_may_have_body(const sb_scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->body_count; i++)
        if (scene->bodies[i].split || strcmp(scene->bodies[i].name, name) == 0) return true;
    return false;
}

sb_status sb_reader_no_body(sb_reader *reader, const sb_yaml *map, const char *key, const char *name)
{
    sb_nearest nearest = sb_nearest_to(name);
    for (size_t i = 0; i < reader->scene->body_count; i++) sb_nearest_try(&nearest, reader->scene->bodies[i].name);
    return sb_reader_fail(reader, map, key, "no body is named %s, %s%s%s", name,
                          nearest.found ? "did you mean " : "expected the name of a body",
                          nearest.found ? nearest.found : "", nearest.found ? "?" : "");
}

/* A paddle must not move through periodic sides: it would enter again at the other side, into its own wake. */
static sb_status check_direction(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use)
{
    const double along[] = {use->direction.x, use->direction.y};
    for (int axis = 0; axis < 2; axis++)
        if (sb_scene_repeats(reader->scene, axis) && fabs(along[axis]) > 1e-9)
            return sb_reader_fail(reader, map, "direction",
                                  "leads through the periodic sides in %c, expected no motion "
                                  "along %c, or walls there",
                                  "xy"[axis], "xy"[axis]);
    return SB_OK;
}

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_wavemaker_use *use = item;
    const sb_scene *scene = reader->scene;
    if (!sb_scene_may_have_body(scene, use->body))
        return sb_reader_fail(reader, map, "body", "no body is named %s, expected the name of a body", use->body);
    for (const sb_wavemaker_use *other = scene->wavemakers; other < use; other++)
        if (strcmp(other->body, use->body) == 0)
            return sb_reader_fail(reader, map, "body", "%s is already moved by %s, expected one wave maker per body",
                                  use->body, other->name);
    sb_status status = check_direction(reader, map, use);
    if (status != SB_OK) return status;
    use->law.gravity = scene->fluid.gravity;
    sb_paddle paddle = {0};
    sb_error why = {0};
    status = sb_paddle_create(&use->law, &paddle, &why);
    if (status == SB_OK)
        sb_paddle_destroy(&paddle);
    else if (status == SB_BAD_INPUT)
        return sb_reader_fail(reader, map, NULL, "%s", why.text);
    else
        return sb_fail(reader->error, status, "%s", why.text);
    return SB_OK;
}

const sb_table sb_wavemaker_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_wavemaker_use), .variant = variant,
                                     .finish = finish};
