#include "base/nearest.h"
#include "scene/reader.h"

#include <math.h>
#include <string.h>

static const char *const start_names[] = {"command", NULL};
static const char *const after_names[] = {"stay", "return", NULL};
static const char *const lasts_names[] = {"forever", NULL};
static const char *const theory_names[] = {"auto", "linear", "second-order", "cnoidal", NULL};
static const char *const motion_names[] = {"piston", "flap", NULL};
static const char *const spectrum_names[] = {"jonswap", "pierson-moskowitz", NULL};

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
static const sb_key plate_keys[] = {
    {.name = "width", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_plate_settings, width), .unit = "m", SB_KEY_NOT_NEGATIVE,
     .fallback = "0", .doc = "About the width of one plate, at least 3 spacings; 0: the paddle is one. "
                              "At most 100 plates, of a box without `rotate` that moves along x or y."},
    {.name = "height", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_plate_settings, height), .unit = "m", SB_KEY_NOT_NEGATIVE,
     .fallback = "0", .flags = SB_KEY_LATER,
     .doc = "About the height of one plate; 0: that of the paddle. Plates above each other read the same surface and "
            "move as one, so that the height changes no motion."},
};
/* clang-format on */

static const sb_table plate_table = {SB_KEY_ROWS(plate_keys), .size = sizeof(sb_plate_settings)};

/* clang-format off */
static const sb_key keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_wavemaker_use, name),
     .flags = SB_KEY_REQUIRED, .doc = "Unique name of the wave maker."},
    {.name = "body", .type = SB_KEY_NAME, SB_KEY_AT(sb_wavemaker_use, body),
     .flags = SB_KEY_REQUIRED, .doc = "Name of the body that the wave maker moves."},
    {.name = "direction", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_wavemaker_use, direction),
     SB_KEY_ANY, .flags = SB_KEY_UNIT, .fallback = "[1, 0, 0]",
     .doc = "Direction of the motion, of any length; of wave trains and `absorber` horizontal, from the paddle's flat face "
            "into the water."},
    {.name = "kind", .type = SB_KEY_LAW, SB_KEY_AT(sb_wavemaker_use, law.kind),
     .flags = SB_KEY_REQUIRED,
     .doc = "Law of the motion; `shorebreak list wavemakers` describes the laws."},
    {.name = "start", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wavemaker_use, law.start), .unit = "s",
     SB_KEY_NOT_NEGATIVE, .words = start_names, .fallback = "0",
     .doc = "Time at which the motion begins; `command`: when the command `trigger` is given."},
    LAW_NUMBER(height, "m", SB_WM_HEIGHT, "laws that need a wave height",
           "Wave height H, trough to crest; the significant height of `irregular`, twice the crest of `focused`."),
    LAW_NUMBER(depth, "m", SB_WM_DEPTH, "laws that need a depth",
           "Still-water depth at the paddle."),
    LAW_NUMBER(stroke, "m", SB_WM_STROKE, "laws that need a stroke",
           "Total displacement of the stroke."),
    LAW_NUMBER(speed, "m/s", SB_WM_SPEED, "laws that need a speed", "Top speed of the stroke."),
    {.name = "file", .type = SB_KEY_FILE, SB_KEY_AT(sb_wavemaker_use, law.file),
     .flags = SB_KEY_REQUIRED, .applies = SB_WM_FILE, .only = "laws that need a file",
     .doc = "Table of times and displacements; of waves for `components`; of times and surfaces for `signal`, whose first row is at `start`, whatever its time."},
    LAW_NUMBER(period, "s", SB_WM_PERIOD, "laws that need a period", "Wave period; of a spectrum, that of its peak."),
    LAW_NUMBER(distance, "m", SB_WM_DISTANCE, "focused and signal",
           "Distance ahead of the paddle at which the waves focus, or have the surface of the file."),
    LAW_NUMBER(focus, "s", SB_WM_FOCUS, "focused", "Time after `start` at which the waves focus."),
    {.name = "theory", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_wavemaker_use, law.theory), .words = theory_names,
     .applies = SB_WM_THEORY, .only = "regular waves", .fallback = "auto",
     .doc = "Theory of the paddle; `auto`: `second-order` where H L^2/d^3 < 26.3, otherwise `cnoidal`."},
    {.name = "motion", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_wavemaker_use, law.motion), .words = motion_names,
     .applies = SB_WM_TRAIN, .only = "wave trains", .fallback = "piston",
     .doc = "`piston`: the same motion at all heights; `flap`: a box that turns about the bed, in rows of 2 spacings."},
    {.name = "spectrum", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_wavemaker_use, law.spectrum), .words = spectrum_names,
     .applies = SB_WM_SPECTRUM, .only = "irregular and focused", .fallback = "jonswap", .doc = "Form of the spectrum."},
    {.name = "gamma", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wavemaker_use, law.gamma), .min = 1, .max = 20,
     .applies = SB_WM_SPECTRUM, .only = "irregular and focused", .fallback = "3.3",
     .doc = "Peak enhancement of `jonswap`."},
    {.name = "components", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_wavemaker_use, law.components), .min = 20, .max = 10000,
     .applies = SB_WM_SPECTRUM, .only = "irregular and focused", .fallback = "200",
     .doc = "Number of linear waves, from 0.5 to 3 times the peak's frequency, by which the spectrum is represented."},
    {.name = "seed", .type = SB_KEY_SEED, SB_KEY_AT(sb_wavemaker_use, law.seed), .max = 0x1p64,
     .applies = SB_WM_SEED, .only = "irregular", .fallback = "1",
     .doc = "Seed of the phases, and of the frequencies within their bands."},
    {.name = "ramp", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wavemaker_use, law.ramp), .unit = "s", SB_KEY_NOT_NEGATIVE,
     .applies = SB_WM_TRAIN, .only = "wave trains", .derived = "two periods; 0 for `signal`",
     .doc = "Time in which the motion grows from rest, and in which it ends."},
    {.name = "lasts", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wavemaker_use, law.lasts), .unit = "s",
     .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE, .words = lasts_names,
     .applies = SB_WM_TRAIN, .only = "wave trains", .fallback = "forever",
     .doc = "Time after `start` at which the motion ends; that of `signal` ends with its file at the latest."},
    {.name = "absorb", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_wavemaker_use, law.absorb),
     .applies = SB_WM_TRAIN, .only = "wave trains", .derived = "false; true for `absorber`",
     .doc = "Whether the paddle also moves so that waves which come back are not reflected."},
    {.name = "reach", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_wavemaker_use, law.reach), .unit = "m", SB_KEY_POSITIVE,
     .applies = SB_WM_TRAIN, .only = "wave trains", .derived = "half of the depth",
     .doc = "Farthest that an absorbing paddle moves from its law to absorb."},
    {.name = "after", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_wavemaker_use, law.after),
     .words = after_names, .fallback = "stay",
     .doc = "Motion after the stroke: `stay` at its end, or `return` to the start."},
    LAW_NUMBER(return_time, "s", RETURNS, "after: return", "Duration of the return."),
    {.name = "plates", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_wavemaker_use, plates), .table = &plate_table,
     .applies = SB_WM_TRAIN, .only = "wave trains",
     .doc = "Push-plates side by side, into which an absorbing paddle is divided: each absorbs on its own. 3D only."},
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

/* Keys that do not act together with the values of others. A key with its default is accepted: scenes that a run has
   written have every default. */
static sb_status check_unused(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_parameters *law)
{
    const double usual = 0.5 * law->depth;
    if (law->kind->needs & SB_WM_SPECTRUM && law->spectrum != SB_SPECTRUM_JONSWAP && fabs(law->gamma - 3.3) > 1e-9)
        return sb_reader_fail(reader, map, "gamma",
                              "%g with spectrum pierson-moskowitz, which has no peak enhancement, expected spectrum: "
                              "jonswap, or no gamma",
                              law->gamma);
    if (!(law->kind->needs & SB_WM_TRAIN)) return SB_OK;
    if (strcmp(law->kind->name, "absorber") == 0 && (law->start > 0 || isfinite(law->lasts)))
        return sb_reader_fail(reader, map, law->start > 0 ? "start" : "lasts",
                              "an absorber absorbs from the beginning to the end of the run, expected no such key");
    if (strcmp(law->kind->name, "absorber") == 0 && law->ramp >= 0 && fabs(law->ramp - 2 * law->period) > 1e-9)
        return sb_reader_fail(reader, map, "ramp",
                              "an absorber makes no waves, whose motion would grow, expected no such key");
    if (!law->absorb && fabs(law->reach - usual) > 1e-9 * usual)
        return sb_reader_fail(reader, map, "reach",
                              "%g m, but the paddle does not absorb, expected absorb: true, or no reach", law->reach);
    if (law->after == SB_AFTER_RETURN)
        return sb_reader_fail(reader, map, "after",
                              "return, but the motion of a wave train ends where it began, expected stay");
    return SB_OK;
}

/* Rows of the body before and after those of the law. */
enum { PLACE_ROWS = 3, PLATE_ROWS = 1 };

/* Checks the law by making a paddle. A side of a grid has no body. */
static sb_status finish_law(sb_reader *reader, const sb_yaml *map, sb_wavemaker_use *use)
{
    use->law.gravity = reader->scene->fluid.gravity;
    if (use->law.kind->needs & SB_WM_TRAIN) {
        if (!sb_yaml_child(map, "ramp")) use->law.ramp = -1;
        if (!sb_yaml_child(map, "absorb")) use->law.absorb = strcmp(use->law.kind->name, "absorber") == 0;
        if (!sb_yaml_child(map, "reach")) use->law.reach = 0.5 * use->law.depth;
    }
    sb_status status = check_unused(reader, map, &use->law);
    if (status == SB_OK && use->body[0]) status = sb_plates_check(reader, map, use);
    if (status == SB_OK && use->body[0]) status = sb_piston_check(reader, map, use);
    if (status != SB_OK) return status;
    sb_paddle paddle = {0};
    sb_error why = {0};
    sb_absorbing_filter filter;
    status = sb_paddle_create(&use->law, &paddle, &why);
    if (status == SB_OK && use->law.absorb) {
        status =
            sb_paddle_fit_absorption(&use->law, &paddle, SB_ABSORB_DISTANCE * reader->scene->resolution, &filter, &why);
        if (status != SB_OK) sb_paddle_destroy(&paddle);
    }
    if (status == SB_OK) {
        if (use->law.kind->facts) use->law.ramp = use->law.kind->facts(paddle.state)->ramp;
        sb_paddle_destroy(&paddle);
        return SB_OK;
    }
    if (status == SB_BAD_INPUT) return sb_reader_fail(reader, map, NULL, "%s", why.text);
    return sb_fail(reader->error, status, "%s", why.text);
}

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_wavemaker_use *use = item;
    const sb_scene *scene = reader->scene;
    if (!sb_scene_may_have_body(scene, use->body)) return sb_reader_no_body(reader, map, "body", use->body);
    for (const sb_wavemaker_use *other = scene->wavemakers; other < use; other++)
        if (strcmp(other->body, use->body) == 0)
            return sb_reader_fail(reader, map, "body", "%s is already moved by %s, expected one wave maker per body",
                                  use->body, other->name);
    const sb_status status = check_direction(reader, map, use);
    return status == SB_OK ? finish_law(reader, map, use) : status;
}

const sb_table sb_wavemaker_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_wavemaker_use), .variant = variant,
                                     .finish = finish};

/* A side of a grid stands still and has no filter of what comes back. */
static sb_status finish_grid_paddle(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_wavemaker_use *use = item;
    if (strcmp(use->law.kind->name, "gate") == 0)
        return sb_reader_fail(reader, map, "kind", "gate moves upwards, expected a law of a piston");
    if (isinf(use->law.start))
        return sb_reader_fail(reader, map, "start", "command: a side of a grid takes no commands, expected seconds");
    if (use->law.motion == SB_PADDLE_FLAP)
        return sb_reader_fail(reader, map, "motion", "a side of a grid moves water as a piston, expected piston");
    if (use->law.absorb || strcmp(use->law.kind->name, "absorber") == 0)
        return sb_reader_fail(reader, map, "absorb",
                              "a side of a grid does not absorb, expected false, or a side of "
                              "kind open");
    return finish_law(reader, map, use);
}

const sb_table sb_grid_paddle_table = {.keys = keys + PLACE_ROWS,
                                       .count = sizeof keys / sizeof *keys - PLACE_ROWS - PLATE_ROWS,
                                       .size = sizeof(sb_wavemaker_use),
                                       .variant = variant,
                                       .finish = finish_grid_paddle};
