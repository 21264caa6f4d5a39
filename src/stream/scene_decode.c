/* Decodes an encoded scene from untrusted bytes. */
#include "stream/scene.h"

#include "base/memory.h"
#include "stream/reader.h"

#include "shorebreak_scene_t.h"

#include <string.h>

/* The fewest bytes that each of these takes in the encoding. A count is checked by them before memory is reserved. */
enum { SIDE_MAX = 16384 }; /* px */
enum {
    BODY_BYTES = 61,
    CAMERA_BYTES = 77,
    KEY_BYTES = 64,
    GAUGE_BYTES = 21,
    WAVEMAKER_BYTES = 5,
    VERTEX_BYTES = 12,
    TRIANGLE_BYTES = 12
};

/* Reads a count of items that take at least `bytes` each. */
static size_t take_items(sb_message_reader *in, size_t bytes)
{
    const int32_t count = sb_reader_int32(in);
    if (count >= 0 && (size_t)count <= in->left / bytes) return in->problem ? 0 : (size_t)count;
    sb_reader_refuse(in, "a count is negative or larger than the rest of the message");
    return 0;
}

/* Allocates the items. Without memory *no_memory becomes true and the message is refused. */
static void *make(sb_message_reader *in, size_t count, size_t size, bool *no_memory)
{
    void *made = sb_alloc(count, size);
    if (made) return made;
    *no_memory = true;
    sb_reader_refuse(in, "memory runs out");
    return NULL;
}

static void take_body(sb_message_reader *in, sb_live_body *body, bool *no_memory)
{
    sb_reader_name(in, body->name);
    body->reported = sb_reader_int8(in) != 0;
    body->terrain = sb_reader_int8(in) != 0;
    body->moves = sb_reader_int8(in) != 0;
    body->one_sided = sb_reader_int8(in) != 0;
    sb_reader_floats(in, body->color, 3);
    sb_reader_doubles(in, body->moment_point, 3);
    body->vertex_count = take_items(in, VERTEX_BYTES);
    sb_reader_same(in, 3 * (int64_t)body->vertex_count, "its number of components is not three per vertex");
    body->vertices = make(in, 3 * body->vertex_count, sizeof *body->vertices, no_memory);
    if (body->vertices) sb_reader_floats(in, body->vertices, 3 * body->vertex_count);
    body->triangle_count = take_items(in, TRIANGLE_BYTES);
    sb_reader_same(in, 3 * (int64_t)body->triangle_count, "its number of corners is not three per triangle");
    body->corners = make(in, 3 * body->triangle_count, sizeof *body->corners, no_memory);
    if (body->corners) sb_reader_int32s(in, body->corners, 3 * body->triangle_count);
    for (size_t i = 0; i < 3 * body->triangle_count && !in->problem; i++)
        if (body->corners[i] < 0 || (size_t)body->corners[i] >= body->vertex_count)
            sb_reader_refuse(in, "a triangle names a vertex that does not exist");
}

static void take_camera(sb_message_reader *in, sb_live_camera *camera, bool *no_memory)
{
    sb_reader_name(in, camera->name);
    camera->key_count = take_items(in, KEY_BYTES);
    if (camera->key_count == 0) sb_reader_refuse(in, "a camera has no key");
    sb_reader_same(in, 3 * (int64_t)camera->key_count, "its number of components is not three per key");
    double **const arrays[] = {&camera->time, &camera->eye, &camera->target, &camera->fov};
    const size_t lengths[] = {1, 3, 3, 1};
    for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++) {
        *arrays[a] = make(in, lengths[a] * camera->key_count, sizeof **arrays[a], no_memory);
        if (*arrays[a]) sb_reader_doubles(in, *arrays[a], lengths[a] * camera->key_count);
    }
    for (size_t i = 0; i < camera->key_count && !in->problem; i++)
        if (!(camera->fov[i] > 0 && camera->fov[i] < 180) || (i > 0 && camera->time[i] < camera->time[i - 1]))
            sb_reader_refuse(in,
                             "an angle of view is not within 0 and 180 degrees, or the keys are not ordered in time");
}

static void take_facts(sb_message_reader *in, sb_live_scene *scene)
{
    scene->run_id = sb_reader_int64(in);
    sb_reader_name(in, scene->run);
    sb_reader_name(in, scene->units);
    scene->dimensions = sb_reader_int32(in);
    scene->spacing = sb_reader_double(in);
    scene->duration = sb_reader_double(in);
    sb_reader_doubles(in, scene->domain_min, 3);
    sb_reader_doubles(in, scene->domain_max, 3);
    scene->gravity = sb_reader_double(in);
    scene->density = sb_reader_double(in);
    scene->has_level = sb_reader_int8(in) != 0;
    scene->level = sb_reader_double(in);
    scene->still_depth = sb_reader_double(in);
    scene->speed_max = sb_reader_double(in);
    scene->pressure_max = sb_reader_double(in);
    scene->measure_interval = sb_reader_double(in);
    scene->frame_interval = sb_reader_double(in);
    scene->width = sb_reader_int32(in);
    scene->height = sb_reader_int32(in);
    if (scene->width < 1 || scene->width > SIDE_MAX || scene->height < 1 || scene->height > SIDE_MAX)
        sb_reader_refuse(in, "the size of its pictures is outside of its range");
    if (scene->dimensions < 2 || scene->dimensions > 3 || !(scene->spacing > 0) || !(scene->speed_max > 0))
        sb_reader_refuse(in, "dimensions, spacing or the top of the colour map is outside of its range");
    for (int k = 0; k < 3; k++)
        if (scene->domain_min[k] > scene->domain_max[k]) sb_reader_refuse(in, "its domain ends before it begins");
}

static void take_lists(sb_message_reader *in, sb_live_scene *scene, bool *no_memory)
{
    scene->body_count = take_items(in, BODY_BYTES);
    scene->bodies = make(in, scene->body_count, sizeof *scene->bodies, no_memory);
    for (size_t i = 0; i < scene->body_count && !in->problem; i++) take_body(in, &scene->bodies[i], no_memory);
    scene->camera_count = take_items(in, CAMERA_BYTES);
    scene->cameras = make(in, scene->camera_count, sizeof *scene->cameras, no_memory);
    for (size_t i = 0; i < scene->camera_count && !in->problem; i++) take_camera(in, &scene->cameras[i], no_memory);
    scene->gauge_count = take_items(in, GAUGE_BYTES);
    scene->gauges = make(in, scene->gauge_count, sizeof *scene->gauges, no_memory);
    for (size_t i = 0; i < scene->gauge_count && !in->problem; i++) {
        sb_reader_name(in, scene->gauges[i].name);
        scene->gauges[i].x = sb_reader_double(in);
        scene->gauges[i].y = sb_reader_double(in);
    }
    scene->wavemaker_count = take_items(in, WAVEMAKER_BYTES);
    scene->wavemakers = make(in, scene->wavemaker_count, sizeof *scene->wavemakers, no_memory);
    for (size_t i = 0; i < scene->wavemaker_count && !in->problem; i++) sb_reader_name(in, scene->wavemakers[i]);
}

sb_status sb_live_scene_decode(const void *buffer, size_t size, sb_live_scene *out, sb_error *error)
{
    bool no_memory = false;
    sb_live_scene scene = {0};
    sb_message_reader in = sb_reader_begin(buffer, size, SB_STREAM_SCENE_MAX, __shorebreak_scene_t_get_hash());
    take_facts(&in, &scene);
    take_lists(&in, &scene, &no_memory);
    sb_status status = sb_reader_end(&in, "scene", size, error);
    if (no_memory) status = sb_fail_memory(error, "the scene of a stream");
    if (status == SB_OK)
        *out = scene;
    else
        sb_live_scene_free(&scene);
    return status;
}

void sb_live_scene_free(sb_live_scene *scene)
{
    for (size_t i = 0; scene->bodies && i < scene->body_count; i++) {
        sb_free(scene->bodies[i].vertices);
        sb_free(scene->bodies[i].corners);
    }
    for (size_t i = 0; scene->cameras && i < scene->camera_count; i++) {
        sb_free(scene->cameras[i].time);
        sb_free(scene->cameras[i].eye);
        sb_free(scene->cameras[i].target);
        sb_free(scene->cameras[i].fov);
    }
    sb_free(scene->bodies);
    sb_free(scene->cameras);
    sb_free(scene->gauges);
    sb_free(scene->wavemakers);
    *scene = (sb_live_scene){0};
}
