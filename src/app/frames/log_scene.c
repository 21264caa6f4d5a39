#include "app/frames/log_scene.h"

#include "base/memory.h"
#include "scene/name.h"
#include "stream/points.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static sb_vec3 vector(const double at[3])
{
    return sb_vec(at[0], at[1], at[2]);
}

/* A view of the whole domain from the side of small x and y, and from above. */
static sb_status add_view(sb_scene *scene, sb_error *error)
{
    const sb_vec3 size = sb_sub(scene->domain.max, scene->domain.min);
    const double far = 1.2 * fmax(size.x, fmax(size.y, size.z));
    const sb_vec3 middle = sb_madd(scene->domain.min, 0.5, size);
    scene->render.cameras = sb_alloc(1, sizeof *scene->render.cameras);
    if (!scene->render.cameras) return sb_fail_memory(error, "a camera");
    scene->render.camera_count = 1;
    sb_camera *camera = scene->render.cameras;
    snprintf(camera->name, sizeof camera->name, "view");
    camera->keys = sb_alloc(1, sizeof *camera->keys);
    if (!camera->keys) return sb_fail_memory(error, "a camera");
    camera->key_count = 1;
    camera->keys[0] =
        (sb_camera_key){.eye = sb_madd(middle, far, sb_vec(-0.5, -0.8, 0.5)), .target = middle, .fov = 45};
    return SB_OK;
}

static sb_status set_camera(sb_camera *camera, const sb_live_camera *live, sb_error *error)
{
    snprintf(camera->name, sizeof camera->name, "%s", live->name);
    sb_name_fit(camera->name);
    if (!*camera->name) snprintf(camera->name, sizeof camera->name, "view");
    camera->keys = sb_alloc(live->key_count, sizeof *camera->keys);
    if (!camera->keys) return sb_fail_memory(error, "a camera");
    camera->key_count = live->key_count;
    for (size_t k = 0; k < live->key_count; k++)
        camera->keys[k] = (sb_camera_key){.time = live->time[k],
                                          .eye = vector(live->eye + 3 * k),
                                          .target = vector(live->target + 3 * k),
                                          .fov = live->fov[k]};
    return SB_OK;
}

static sb_status set_cameras(sb_scene *scene, const sb_live_scene *live, sb_error *error)
{
    sb_status status = SB_OK;
    if (live->camera_count == 0) return add_view(scene, error);
    scene->render.cameras = sb_alloc(live->camera_count, sizeof *scene->render.cameras);
    if (!scene->render.cameras) return sb_fail_memory(error, "cameras");
    for (size_t c = 0; c < live->camera_count && status == SB_OK; c++) {
        scene->render.camera_count = c + 1;
        status = set_camera(&scene->render.cameras[c], &live->cameras[c], error);
        for (size_t other = 0; other < c && status == SB_OK; other++)
            if (strcmp(scene->render.cameras[other].name, scene->render.cameras[c].name) == 0)
                status = sb_fail(error, SB_BAD_INPUT, "the recorded scene has two cameras named %s",
                                 scene->render.cameras[c].name);
    }
    return status;
}

static sb_status set_scene(sb_scene *scene, const sb_live_scene *live, sb_error *error)
{
    static const double MOST = 60; /* pictures per second of a film, which lasts as long as the run if it can */
    scene->title = sb_strdup(live->run);
    scene->dimensions = live->dimensions;
    scene->resolution = live->spacing;
    scene->duration = live->duration;
    scene->fluid = (sb_fluid_properties){.density = live->density, .gravity = live->gravity};
    scene->domain.min = vector(live->domain_min);
    scene->domain.max = vector(live->domain_max);
    scene->sea = (sb_sea){.present = live->has_level, .level = live->level};
    /* Shadows and occlusion are those of a scene that does not name them: a log does not say. */
    scene->render = (sb_render_settings){.width = live->width,
                                         .height = live->height,
                                         .speed_max = live->speed_max,
                                         .shadows = true,
                                         .occlusion = true,
                                         .video = true};
    scene->render.video_rate = (int)fmin(fmax(round(1 / fmax(live->frame_interval, 1 / MOST)), 1), MOST);
    scene->boxes = sb_alloc(1, sizeof *scene->boxes); /* only its level matters */
    if (!scene->title || !scene->boxes) return sb_fail_memory(error, "the scene of a log");
    scene->box_count = 1;
    scene->boxes[0].level = live->level;
    return set_cameras(scene, live, error);
}

static sb_status set_body(sb_model_body *body, const sb_live_body *live, sb_vec3 origin, sb_error *error)
{
    snprintf(body->name, sizeof body->name, "%s", live->name);
    body->wavemaker = live->moves ? 0 : -1;
    body->report = live->reported;
    body->role = live->terrain ? SB_ROLE_TERRAIN : SB_ROLE_SOLID;
    body->moment_point = vector(live->moment_point);
    memcpy(body->color, live->color, sizeof body->color);
    const sb_status status = sb_mesh_alloc(&body->mesh, live->vertex_count, live->triangle_count, error);
    if (status != SB_OK) return status;
    body->mesh.open_surface = live->one_sided;
    for (size_t v = 0; v < live->vertex_count; v++) {
        const float *at = live->vertices + 3 * v;
        body->mesh.vertices[v] = sb_add(origin, sb_vec((double)at[0], (double)at[1], (double)at[2]));
    }
    for (size_t c = 0; c < 3 * live->triangle_count; c++)
        body->mesh.triangles[c / 3][c % 3] = (uint32_t)live->corners[c];
    return SB_OK;
}

static sb_status set_model(sb_model *model, const sb_live_scene *live, sb_error *error)
{
    sb_status status = SB_OK;
    *model = (sb_model){.min = vector(live->domain_min),
                        .max = vector(live->domain_max),
                        .dimensions = live->dimensions,
                        .spacing = live->spacing,
                        .still_depth = live->still_depth};
    model->bodies = sb_alloc(live->body_count, sizeof *model->bodies);
    if (!model->bodies) return sb_fail_memory(error, "the bodies of a log");
    for (size_t b = 0; b < live->body_count && status == SB_OK; b++) {
        model->body_count = b + 1;
        status = set_body(&model->bodies[b], &live->bodies[b], model->min, error);
    }
    return status;
}

sb_status sb_log_scene(const sb_live_scene *live, sb_scene *scene, sb_model *model, sb_error *error)
{
    sb_scene made = {0};
    sb_model bodies = {0};
    sb_status status = set_scene(&made, live, error);
    if (status == SB_OK) status = set_model(&bodies, live, error);
    if (status != SB_OK) {
        sb_scene_free(&made);
        sb_model_free(&bodies);
        return status;
    }
    *scene = made;
    *model = bodies;
    return SB_OK;
}

sb_frame *sb_log_frame(const sb_live_scene *scene, const sb_live_frame *live)
{
    sb_frame *frame = sb_frame_create((size_t)live->count, scene->body_count);
    if (!frame) return NULL;
    frame->index = (uint64_t)live->frame;
    frame->origin = vector(scene->domain_min);
    frame->spacing = live->spacing;
    frame->status = (sb_frame_status){.step = (uint64_t)live->step, .time = live->time, .duration = scene->duration};
    for (int32_t p = 0; p < live->part_count; p++) {
        const sb_live_part *part = &live->parts[p];
        for (size_t i = (size_t)part->first; i < (size_t)(part->first + part->count); i++) {
            const sb_point point = sb_point_decode(live->points + SB_STREAM_POINT * i, part->corner, live->quantum,
                                                   live->speed_max, live->pressure_max);
            for (size_t k = 0; k < 3; k++)
                frame->position[3 * i + k] = (float)(point.position[k] - scene->domain_min[k]);
            frame->velocity[3 * i] = point.speed;
            frame->velocity[3 * i + 1] = frame->velocity[3 * i + 2] = 0;
            frame->pressure[i] = point.pressure;
            frame->id[i] = (uint32_t)i;
        }
    }
    for (size_t b = 0; b < scene->body_count; b++) {
        snprintf(frame->bodies[b].name, sizeof frame->bodies[b].name, "%s", scene->bodies[b].name);
        frame->bodies[b].report = scene->bodies[b].reported;
    }
    for (int32_t m = 0; m < live->moved_count; m++)
        if ((size_t)live->moved[m] < scene->body_count)
            frame->bodies[live->moved[m]].displacement = vector(live->displacement + 3 * m);
    return frame;
}
