#include "scene/reader.h"

#include <limits.h>
#include <math.h>
#include <string.h>
#include <strings.h>

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
};
/* clang-format on */

static sb_status finish_view(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_camera_key *key = item;
    if (sb_norm(sb_sub(key->target, key->eye)) > 0) return SB_OK;
    return sb_reader_fail(reader, map, "target", "is the same point as eye, expected a different point");
}

static const sb_table path_table = {SB_KEY_ROWS(path_keys), .size = sizeof(sb_camera_key), .finish = finish_view};
/* The keys of a fixed camera: the same without the time. */
static const sb_table view_table = {
    .keys = path_keys + 1, .count = sizeof path_keys / sizeof *path_keys - 1, .size = sizeof(sb_camera_key)};

enum { FIXED = 1, PATH = 2 };

static unsigned camera_variant(const void *item, const sb_yaml *map)
{
    bool path = map ? sb_yaml_child(map, "path") != NULL : ((const sb_camera *)item)->key_count > 1;
    return path ? PATH : FIXED;
}

static const char *const style_words[] = {"surface", "particles", NULL};
static const char *const color_words[] = {"speed", "pressure", "vorticity", "depth", "momentum_flux", NULL};

/* clang-format off */
static const sb_key camera_keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_camera, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the camera; its folder and film have this name."},
    {.name = "path", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_camera, keys, key_count),
     .table = &path_table, .applies = PATH, .only = "a moving camera", .derived = "a fixed camera",
     .doc = "Path of a moving camera: two or more places with times, connected smoothly."},
    {.type = SB_KEY_LIST, SB_KEY_ITEMS(sb_camera, keys, key_count), .table = &view_table,
     .applies = FIXED, .only = "a camera without path"},
    {.name = "style", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_camera, style), .words = style_words,
     .fallback = "surface", .doc = "How the water is drawn: a smooth surface, or its particles as spheres."},
    {.name = "color", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_camera, color), .words = color_words,
     .fallback = "speed", .doc = "Field that colours the water; see [pictures](pictures.md#colours)."},
    {.name = "color_min", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera, color_min), SB_KEY_ANY, .fallback = "0",
     .doc = "Value at the lower end of the colour map, in the field's unit."},
    {.name = "color_max", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_camera, color_max), SB_KEY_ANY, .fallback = "0",
     .doc = "Value at the upper end, above color_min; 0 with color_min 0: chosen for the scene."},
};
/* clang-format on */

static sb_status finish_camera(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_camera *camera = item;
    const bool chosen = camera->color_min == 0 && camera->color_max == 0;
    if (!chosen && !(camera->color_max > camera->color_min))
        return sb_reader_fail(reader, map, "color_max", "is %g, expected more than color_min, %g", camera->color_max,
                              camera->color_min);
    if (!(camera_variant(camera, map) & PATH)) return finish_view(reader, map, camera->keys);
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

static const sb_table camera_table = {SB_KEY_ROWS(camera_keys), .size = sizeof(sb_camera), .variant = camera_variant,
                                      .finish = finish_camera};

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
     .doc = "Speed at the upper end of the colour map; 0: 2 sqrt(g D)."},
    {.name = "video", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, video),
     .fallback = "true", .flags = SB_KEY_FREE,
     .doc = "Whether to join each camera's pictures to a film, if ffmpeg is installed."},
    {.name = "video_rate", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_render_settings, video_rate),
     .unit = "1/s", .min = 1, .max = 240, .fallback = "30", .flags = SB_KEY_FREE,
     .doc = "Pictures per second of the film."},
    {.name = "shadows", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, shadows), .fallback = "true",
     .doc = "Whether bodies and water cast shadows."},
    {.name = "occlusion", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, occlusion), .fallback = "true",
     .doc = "Whether corners and gaps are darker, because near surfaces hide a part of the sky."},
    {.name = "wet_ground", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, wet_ground), .fallback = "true",
     .doc = "Whether ground and walls that the water has reached are darker."},
    {.name = "greatest_depth", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, greatest_depth),
     .fallback = "false", .doc = "Whether the greatest depth so far is painted on terrain above the still water."},
    {.name = "scale_bar", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_render_settings, scale_bar), .fallback = "true",
     .doc = "Whether a bar shows the length of an object at the camera's target."},
    {.name = "north", .type = SB_KEY_VECTOR, SB_KEY_AT(sb_render_settings, north), SB_KEY_ANY,
     .flags = SB_KEY_FULL, .fallback = "[0, 0, 0]",
     .doc = "Direction of north, horizontal, for an arrow; [0, 0, 0]: no arrow."},
    {.name = "cameras", .type = SB_KEY_LIST,
     SB_KEY_ITEMS(sb_render_settings, cameras, camera_count), .table = &camera_table,
     .doc = "Cameras. Each makes its own pictures and film, and has eye and target, or a path."},
};
/* clang-format on */

static sb_status finish_render(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_render_settings *render = item;
    if (render->interval > 0 && render->camera_count == 0)
        return sb_reader_fail(reader, map, "cameras",
                              "has no camera, expected at least one because render.interval is not 0");
    if (render->north.z != 0)
        return sb_reader_fail(reader, map, "north", "has the height %g, expected a horizontal direction with z = 0",
                              render->north.z);
    return sb_reader_interval(reader, map, "interval", render->interval);
}

const sb_table sb_render_table = {SB_KEY_ROWS(render_keys), .size = sizeof(sb_render_settings),
                                  .finish = finish_render};

/* clang-format off */
static const sb_key stream_keys[] = {
    {.name = "enabled", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_stream_settings, enabled),
     .fallback = "false", .doc = "Whether the run publishes its state while it runs."},
    {.name = "url", .type = SB_KEY_TEXT, SB_KEY_AT(sb_stream_settings, url), .fallback = "\"\"",
     .doc = "LCM provider, for example udpm://239.255.76.67:7667?ttl=0; empty: LCM's default."},
    {.name = "prefix", .type = SB_KEY_NAME, SB_KEY_AT(sb_stream_settings, prefix),
     .fallback = "shorebreak", .doc = "First part of channel names."},
    {.name = "interval", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_stream_settings, interval),
     .unit = "s", SB_KEY_POSITIVE, .fallback = "0.1",
     .doc = "Simulated time between particle messages."},
    {.name = "decimation", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_stream_settings, decimation),
     .min = 1, .max = 1000000, .fallback = "1", .doc = "Every n-th particle is sent."},
};
/* clang-format on */

enum { PREFIX_MAX = 63 - 10 }; /* the longest channel: <prefix>_particles */

static sb_status finish_stream(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_stream_settings *stream = item;
    /* A scene may come from an untrusted source, and LCM would overwrite the file that it names, in any folder. */
    if (strncasecmp(stream->url + strspn(stream->url, " "), "file:", 5) == 0)
        return sb_reader_fail(reader, map, "url",
                              "%.80s would write outside of the output folder, expected a network provider; "
                              "record a log with lcm-logger, or name a file in LCM_DEFAULT_URL",
                              stream->url);
    if (strlen(stream->prefix) > PREFIX_MAX)
        return sb_reader_fail(reader, map, "prefix",
                              "has %zu characters, expected at most %d: a channel name of LCM has at most 63",
                              strlen(stream->prefix), PREFIX_MAX);
    return sb_reader_interval(reader, map, "interval", stream->interval);
}

const sb_table sb_stream_table = {SB_KEY_ROWS(stream_keys), .size = sizeof(sb_stream_settings),
                                  .finish = finish_stream};

/* clang-format off */
static const sb_key control_keys[] = {
    {.name = "enabled", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_control_settings, enabled),
     .fallback = "false",
     .doc = "Whether the run obeys commands that are signed with its token; this also enables the "
            "stream."},
    {.name = "paused", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_control_settings, paused),
     .fallback = "false",
     .doc = "Whether a run that obeys commands begins paused, until the command `resume`."},
};
/* clang-format on */

const sb_table sb_control_table = {SB_KEY_ROWS(control_keys)};

/* clang-format off */
static const sb_key checkpoint_keys[] = {
    {.name = "minutes", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_checkpoint_settings, minutes),
     .unit = "min", .min = 0, .max = 525600, .fallback = "10",
     .doc = "Run time between two checkpoints; 0: by steps only."},
    {.name = "steps", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_checkpoint_settings, steps),
     .unit = "steps", .min = 0, .max = 1000000000, .fallback = "0",
     .doc = "Steps between two checkpoints; 0: by minutes only. With both 0, no checkpoints are "
            "written."},
    {.name = "keep", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_checkpoint_settings, keep),
     .min = 1, .max = 1000000, .fallback = "2",
     .doc = "Number of checkpoints that are kept, the newest ones. If one is damaged, the "
            "previous one is used."},
};
/* clang-format on */

static const sb_table checkpoint_table = {SB_KEY_ROWS(checkpoint_keys)};

/* clang-format off */
static const sb_key output_keys[] = {
    {.name = "particle_interval", .type = SB_KEY_NUMBER,
     SB_KEY_AT(sb_output_settings, particle_interval), .unit = "s", SB_KEY_NOT_NEGATIVE,
     .fallback = "0",
     .doc = "Simulated time between particle files for ParaView; 0: no particle files."},
    {.name = "plots", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_output_settings, plots),
     .fallback = "true", .flags = SB_KEY_FREE,
     .doc = "Whether to plot forces and gauges at the end, if gnuplot is installed."},
    {.name = "checkpoint", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_output_settings, checkpoint),
     .table = &checkpoint_table, .flags = SB_KEY_FREE,
     .doc = "Times at which checkpoints are saved, for `--resume`; also at the end and on a "
            "signal."},
};
/* clang-format on */

static sb_status finish_output(sb_reader *reader, const sb_yaml *map, void *item)
{
    return sb_reader_interval(reader, map, "particle_interval", ((const sb_output_settings *)item)->particle_interval);
}

const sb_table sb_output_table = {SB_KEY_ROWS(output_keys), .size = sizeof(sb_output_settings),
                                  .finish = finish_output};
