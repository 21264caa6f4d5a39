/* The keys of pictures and films. */
#include "scene/table_cameras.h"

#include "base/nearest.h"

#include <string.h>

enum { INSETS_MAX = 4, STILLS_MAX = 1000 };

/* clang-format off */
static const sb_key still_keys[] = {
    {.name = "time", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_still, time), .unit = "s", SB_KEY_NOT_NEGATIVE,
     .flags = SB_KEY_REQUIRED, .doc = "Time of the picture; later than the previous entry."},
};
/* clang-format on */

static const sb_table still_table = {SB_KEY_ROWS(still_keys), .size = sizeof(sb_still), .plain = true};

enum { FORCE = 1, GAUGE = 2 };

static unsigned inset_variant(const void *item, const sb_yaml *map)
{
    if (map) return sb_yaml_child(map, "gauge") ? GAUGE : FORCE;
    return *((const sb_inset *)item)->gauge ? GAUGE : FORCE;
}

static const char *const axis_names[] = {"x", "y", "z", NULL};

/* clang-format off */
static const sb_key inset_keys[] = {
    /* Names of a list's first row must differ, so the body, which may have several plots, is the second. */
    {.name = "axis", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_inset, axis), .words = axis_names, .fallback = "x",
     .applies = FORCE, .only = "a plot without gauge", .doc = "Component of the force."},
    {.name = "force", .type = SB_KEY_NAME, SB_KEY_AT(sb_inset, force), .flags = SB_KEY_REQUIRED, .applies = FORCE,
     .only = "a plot without gauge", .doc = "Body whose force is plotted; one that has rows in forces.csv."},
    {.name = "gauge", .type = SB_KEY_NAME, SB_KEY_AT(sb_inset, gauge), .flags = SB_KEY_REQUIRED, .applies = GAUGE,
     .only = "a plot without force", .doc = "Gauge whose water level is plotted: eta, or z in a scene without a still-water level."},
};
/* clang-format on */

static sb_status finish_inset(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_inset *inset = item;
    const sb_scene *scene = reader->scene;
    const char *name = *inset->gauge ? inset->gauge : inset->force;
    if (*inset->gauge) {
        if (sb_scene_gauge(scene, name) < scene->measure.gauge_count) return SB_OK;
        sb_nearest nearest = sb_nearest_to(name);
        for (size_t g = 0; g < scene->measure.gauge_count; g++) sb_nearest_try(&nearest, scene->measure.gauges[g].name);
        return sb_reader_fail(reader, map, "gauge", "no gauge is named %s, %s%s%s", name,
                              nearest.found ? "did you mean " : "expected the name of a gauge",
                              nearest.found ? nearest.found : "", nearest.found ? "?" : "");
    }
    if (!sb_scene_may_have_body(scene, name)) return sb_reader_no_body(reader, map, "force", name);
    for (size_t b = 0; b < scene->body_count; b++)
        if (strcmp(scene->bodies[b].name, name) == 0 && !scene->bodies[b].report)
            return sb_reader_fail(reader, map, "force",
                                  "%s has no rows in forces.csv, expected a body with report: true", name);
    return SB_OK;
}

static const sb_table inset_table = {SB_KEY_ROWS(inset_keys), .size = sizeof(sb_inset), .variant = inset_variant,
                                     .finish = finish_inset};

/* clang-format off */
static const sb_key render_keys[] = {
    {.name = "interval", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_render_settings, interval),
     .unit = "s", SB_KEY_NOT_NEGATIVE, .fallback = "0",
     .doc = "Simulated time between pictures; 0: no pictures."},
    {.name = "width", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_render_settings, width), .unit = "px",
     .min = 16, .max = 16384, .fallback = "1280", .doc = "Width of a picture."},
    {.name = "height", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_render_settings, height), .unit = "px",
     .min = 16, .max = 16384, .fallback = "720", .doc = "Height of a picture."},
    {.name = "speed_max", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_render_settings, speed_max),
     .unit = "m/s", SB_KEY_NOT_NEGATIVE, .fallback = "0",
     .doc = "Speed at the upper end of the colour map; 0: 2 sqrt(g D), or three times that of the scene's waves at the "
            "surface by linear theory, if regular or irregular waves are all that moves and this is less."},
    {.name = "video", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, video),
     .fallback = "true", .flags = SB_KEY_FREE,
     .doc = "Whether to join each camera's pictures to a film, if ffmpeg is installed."},
    {.name = "video_rate", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_render_settings, video_rate),
     .unit = "1/s", .min = 1, .max = 240, .fallback = "30", .flags = SB_KEY_FREE,
     .doc = "Pictures per second of the film."},
    {.name = "stills", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_render_settings, stills, still_count),
     .table = &still_table,
     .doc = "Times of pictures of a size of their own, by all cameras: [12.5, 20]. They need no `interval`."},
    {.name = "still_width", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_render_settings, still_width), .unit = "px",
     .min = 16, .max = 16384, .fallback = "1920", .doc = "Width of a still."},
    {.name = "still_height", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_render_settings, still_height), .unit = "px",
     .min = 16, .max = 16384, .fallback = "1080", .doc = "Height of a still."},
    {.name = "insets", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_render_settings, insets, inset_count),
     .table = &inset_table,
     .doc = "Plots in each picture of forces and water levels up to its time, at most 4, from the lower left upwards."},
    {.name = "shadows", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, shadows), .fallback = "true",
     .doc = "Whether bodies and water cast shadows."},
    {.name = "occlusion", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, occlusion), .fallback = "true",
     .doc = "Whether corners and gaps are darker, because near surfaces hide a part of the sky."},
    {.name = "wet_ground", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, wet_ground), .fallback = "false",
     .doc = "Whether ground and bodies at rest that the water has reached are darker; with `loads` terrain only."},
    {.name = "greatest_depth", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, greatest_depth),
     .fallback = "false", .doc = "Whether the greatest depth so far is painted on the same places, above the still water."},
    {.name = "loads", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, loads), .fallback = "false",
     .doc = "Whether the faces of bodies have the colour of the mean pressure on them; see [pictures](pictures.md#loads)."},
    {.name = "load_max", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_render_settings, load_max), .unit = "Pa",
     SB_KEY_NOT_NEGATIVE, .fallback = "0", .doc = "Mean pressure at the upper end of these colours; 0: rho g D / 10."},
    {.name = "scale_bar", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, scale_bar), .fallback = "true",
     .doc = "Whether a bar shows the length of an object at the camera's target."},
    {.name = "north", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_render_settings, north), SB_KEY_ANY,
     .flags = SB_KEY_FULL, .fallback = "[0, 0, 0]",
     .doc = "Direction of north, horizontal, for an arrow; [0, 0, 0]: no arrow."},
    {.name = "cameras", .type = SB_KEY_LIST,
     SB_KEY_ITEMS(sb_render_settings, cameras, camera_count), .table = &sb_camera_table,
     .doc = "Cameras. Each makes its own pictures and film."},
};
/* clang-format on */

static sb_status finish_render(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_render_settings *render = item;
    const bool draws = render->interval > 0 || render->still_count > 0;
    if (draws && render->camera_count == 0)
        return sb_reader_fail(reader, map, "cameras", "has no camera, expected at least one because render.%s",
                              render->interval > 0 ? "interval is not 0" : "stills is not empty");
    if (render->loads && reader->scene->dimensions == 2)
        return sb_reader_fail(reader, map, "loads",
                              "true in a scene of two dimensions, expected false: its bodies have no "
                              "faces");
    if (render->inset_count > INSETS_MAX)
        return sb_reader_fail(reader, map, "insets", "has %zu plots, expected at most %d", render->inset_count,
                              INSETS_MAX);
    if (render->still_count > STILLS_MAX)
        return sb_reader_fail(reader, map, "stills", "has %zu times, expected at most %d", render->still_count,
                              STILLS_MAX);
    for (size_t i = 1; i < render->still_count; i++)
        if (!(render->stills[i].time > render->stills[i - 1].time))
            return sb_reader_fail(reader, map, "stills",
                                  "%g s of entry %zu is not later than %g s of the entry before, expected increasing "
                                  "times",
                                  render->stills[i].time, i, render->stills[i - 1].time);
    if (render->north.z != 0)
        return sb_reader_fail(reader, map, "north", "has the height %g, expected a horizontal direction with z = 0",
                              render->north.z);
    return sb_reader_interval(reader, map, "interval", render->interval);
}

const sb_table sb_render_table = {SB_KEY_ROWS(render_keys), .size = sizeof(sb_render_settings),
                                  .finish = finish_render};
