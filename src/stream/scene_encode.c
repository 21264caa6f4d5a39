#include "stream/scene_encode.h"

#include "base/memory.h"

#include "shorebreak_scene_t.h"

#include <stdio.h>
#include <string.h>

/* The generated types take plain pointers, and their encoder does not write through them. */
static char *text(const char *constant)
{
    return (char *)(uintptr_t)constant;
}

static void put(double out[3], sb_vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static bool set_body(shorebreak_body_t *to, const sb_model_body *body, sb_vec3 origin)
{
    const sb_mesh *mesh = &body->mesh;
    *to = (shorebreak_body_t){
        .name = text(body->name),
        .reported = body->report,
        .terrain = body->role == SB_ROLE_TERRAIN,
        .moves = body->wavemaker >= 0,
        .one_sided = mesh->open_surface && body->role != SB_ROLE_TERRAIN,
        .vertex_count = (int32_t)mesh->vertex_count,
        .vertex_components = (int32_t)(3 * mesh->vertex_count),
        .triangle_count = (int32_t)mesh->triangle_count,
        .corner_count = (int32_t)(3 * mesh->triangle_count),
    };
    memcpy(to->color, body->color, sizeof to->color);
    put(to->moment_point, body->moment_point);
    to->vertices = sb_alloc(3 * mesh->vertex_count, sizeof *to->vertices);
    to->corners = sb_alloc(3 * mesh->triangle_count, sizeof *to->corners);
    if (!to->vertices || !to->corners) return false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        to->vertices[3 * i] = (float)(mesh->vertices[i].x - origin.x);
        to->vertices[3 * i + 1] = (float)(mesh->vertices[i].y - origin.y);
        to->vertices[3 * i + 2] = (float)(mesh->vertices[i].z - origin.z);
    }
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++) to->corners[i] = (int32_t)mesh->triangles[i / 3][i % 3];
    return true;
}

static bool set_camera(shorebreak_camera_t *to, const sb_camera *camera)
{
    const size_t keys = camera->key_count;
    *to = (shorebreak_camera_t){
        .name = text(camera->name), .key_count = (int32_t)keys, .components = (int32_t)(3 * keys)};
    to->time = sb_alloc(keys, sizeof *to->time);
    to->eye = sb_alloc(3 * keys, sizeof *to->eye);
    to->target = sb_alloc(3 * keys, sizeof *to->target);
    to->fov = sb_alloc(keys, sizeof *to->fov);
    if (!to->time || !to->eye || !to->target || !to->fov) return false;
    for (size_t i = 0; i < keys; i++) {
        to->time[i] = camera->keys[i].time;
        to->fov[i] = camera->keys[i].fov;
        put(&to->eye[3 * i], camera->keys[i].eye);
        put(&to->target[3 * i], camera->keys[i].target);
    }
    return true;
}

static bool set_lists(shorebreak_scene_t *to, const sb_scene *scene, const sb_model *model)
{
    const sb_measure_settings *measure = &scene->measure;
    to->bodies = sb_alloc(model->body_count, sizeof *to->bodies);
    to->cameras = sb_alloc(scene->render.camera_count, sizeof *to->cameras);
    to->gauges = sb_alloc(measure->gauge_count, sizeof *to->gauges);
    to->wavemaker_names = sb_alloc(scene->wavemaker_count, sizeof *to->wavemaker_names);
    if (!to->bodies || !to->cameras || !to->gauges || !to->wavemaker_names) return false;
    for (; (size_t)to->body_count < model->body_count; to->body_count++)
        if (!set_body(&to->bodies[to->body_count], &model->bodies[to->body_count], scene->domain.min)) return false;
    /* Subscribers know cameras with keys only. */
    for (size_t c = 0; c < scene->render.camera_count; c++) {
        if (scene->render.cameras[c].key_count == 0) continue;
        if (!set_camera(&to->cameras[to->camera_count++], &scene->render.cameras[c])) return false;
    }
    for (; (size_t)to->gauge_count < measure->gauge_count; to->gauge_count++) {
        const sb_gauge *gauge = &measure->gauges[to->gauge_count];
        to->gauges[to->gauge_count] = (shorebreak_gauge_t){.name = text(gauge->name), .x = gauge->x, .y = gauge->y};
    }
    for (size_t w = 0; w < scene->wavemaker_count; w++)
        if (isinf(scene->wavemakers[w].law.start))
            to->wavemaker_names[to->wavemaker_count++] = text(scene->wavemakers[w].name);
    return true;
}

/* Frees also the items at the counts, which setting them may have left incomplete. */
static void free_lists(shorebreak_scene_t *to, const sb_scene *scene, const sb_model *model)
{
    for (size_t i = 0; to->bodies && i < model->body_count; i++) {
        sb_free(to->bodies[i].vertices);
        sb_free(to->bodies[i].corners);
    }
    for (size_t i = 0; to->cameras && i < scene->render.camera_count; i++) {
        sb_free(to->cameras[i].time);
        sb_free(to->cameras[i].eye);
        sb_free(to->cameras[i].target);
        sb_free(to->cameras[i].fov);
    }
    sb_free(to->bodies);
    sb_free(to->cameras);
    sb_free(to->gauges);
    sb_free(to->wavemaker_names);
}

static double meshes_size(const sb_model *model)
{
    double bytes = 0;
    for (size_t b = 0; b < model->body_count; b++)
        bytes += 12 * ((double)model->bodies[b].mesh.vertex_count + (double)model->bodies[b].mesh.triangle_count);
    return bytes;
}

static sb_status encode(const shorebreak_scene_t *message, unsigned char **bytes, size_t *size, sb_error *error)
{
    const int length = shorebreak_scene_t_encoded_size(message);
    if (length < 1 || length > SB_STREAM_SCENE_MAX)
        return sb_fail(error, SB_FAILED, "the scene's meshes take more than the %d MB that the stream can send",
                       SB_STREAM_SCENE_MAX >> 20);
    unsigned char *made = sb_alloc((size_t)length, 1);
    if (!made) return sb_fail_memory(error, "the scene of the stream");
    if (shorebreak_scene_t_encode(made, 0, length, message) != length) {
        sb_free(made);
        return sb_fail(error, SB_FAILED, "LCM cannot encode the scene");
    }
    *bytes = made;
    *size = (size_t)length;
    return SB_OK;
}

static double level_of(const sb_scene *scene)
{
    if (scene->sea.present) return scene->sea.level;
    double level = scene->domain.min.z;
    for (size_t i = 0; i < scene->box_count; i++) level = fmax(level, scene->boxes[i].level);
    return level;
}

sb_status sb_scene_encode(const sb_scene *scene, const sb_model *model, int64_t run_id, const char *run,
                          unsigned char **bytes, size_t *size, sb_error *error)
{
    const double depth = fmax(model->still_depth, scene->resolution);
    char name[SB_STREAM_NAME];
    snprintf(name, sizeof name, "%s", run);
    shorebreak_scene_t message = {
        .version = SB_STREAM_VERSION,
        .run_id = run_id,
        .run = name,
        .units = text(scene->dimensions == 2 ? "m s kg N/m Pa" : "m s kg N Pa"),
        .dimensions = scene->dimensions,
        .spacing = scene->resolution,
        .duration = scene->duration,
        .gravity = scene->fluid.gravity,
        .density = scene->fluid.density,
        .has_level = scene->sea.present,
        .level = level_of(scene),
        .still_depth = model->still_depth,
        .speed_max = scene->render.speed_max > 0 ? scene->render.speed_max : 2 * sb_model_wave_speed(scene, model),
        .pressure_max = scene->fluid.density * scene->fluid.gravity * depth,
        .measure_interval = scene->measure.interval,
        .frame_interval = scene->stream.interval,
        .width = scene->render.width,
        .height = scene->render.height,
    };
    put(message.domain_min, scene->domain.min);
    put(message.domain_max, scene->domain.max);
    sb_status status = SB_OK;
    if (meshes_size(model) > SB_STREAM_SCENE_MAX) /* also keeps the counts within 32 bits */
        status = sb_fail(error, SB_FAILED, "the scene's meshes take more than the %d MB that the stream can send",
                         SB_STREAM_SCENE_MAX >> 20);
    else if (!set_lists(&message, scene, model))
        status = sb_fail_memory(error, "the scene of the stream");
    else
        status = encode(&message, bytes, size, error);
    free_lists(&message, scene, model);
    return status;
}
