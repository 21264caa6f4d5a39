#include "render/camera/cameras.h"

#include "base/memory.h"
#include "base/nearest.h"
#include "render/camera/camera.h"

#include <stdlib.h>
#include <string.h>

static const double DEGREE = 3.14159265358979323846 / 180;

/* ---- places for a renderer ---- */

sb_status sb_poses_create(sb_poses *poses, const sb_scene *scene, size_t more, sb_error *error)
{
    const size_t own = scene->render.camera_count, count = own + more;
    sb_camera *cameras = sb_alloc(count, sizeof *cameras);
    *poses = (sb_poses){.scene = *scene, .keys = sb_alloc(count, sizeof *poses->keys)};
    poses->scene.render.cameras = cameras;
    poses->scene.render.camera_count = count;
    if (!cameras || !poses->keys) {
        sb_poses_free(poses);
        return sb_fail_memory(error, "the cameras");
    }
    for (size_t c = 0; c < count; c++) {
        cameras[c] = c < own ? scene->render.cameras[c] : (sb_camera){.name = "view"};
        cameras[c].key_count = 1;
        cameras[c].keys = &poses->keys[c];
    }
    return SB_OK;
}

void sb_poses_free(sb_poses *poses)
{
    sb_free(poses->scene.render.cameras);
    sb_free(poses->keys);
    *poses = (sb_poses){0};
}

/* ---- bodies ---- */

static size_t find_body(const sb_model *model, const char *name)
{
    size_t b = 0;
    while (b < model->body_count &&
           (strcmp(model->bodies[b].name, name) != 0 || model->bodies[b].mesh.vertex_count == 0))
        b++;
    return b;
}

sb_status sb_cameras_check(const sb_scene *scene, const sb_model *model, sb_error *error)
{
    for (size_t c = 0; c < scene->render.camera_count; c++) {
        const sb_camera *camera = &scene->render.cameras[c];
        if (camera->kind != SB_CAMERA_CLOSEUP || find_body(model, camera->body) < model->body_count) continue;
        sb_nearest nearest = sb_nearest_to(camera->body);
        for (size_t b = 0; b < model->body_count; b++)
            if (model->bodies[b].mesh.vertex_count > 0) sb_nearest_try(&nearest, model->bodies[b].name);
        return sb_fail(error, SB_BAD_INPUT, "render.cameras.%s.closeup: no body is named %s, %s%s%s", camera->name,
                       camera->body, nearest.found ? "did you mean " : "expected the name of a body with a shape",
                       nearest.found ? nearest.found : "", nearest.found ? "?" : "");
    }
    return SB_OK;
}

/* Finds the box of a body at the frame's time. */
static void find_box(const sb_model *model, size_t body, const sb_frame *frame, sb_vec3 *low, sb_vec3 *high)
{
    const sb_vec3 moved = body < frame->body_count ? frame->bodies[body].displacement : sb_vec(0, 0, 0);
    if (!sb_model_box(model, body, low, high)) *low = *high = sb_vec(0, 0, 0);
    *low = sb_add(*low, moved);
    *high = sb_add(*high, moved);
}

/* The least distance from the box's middle at which all of its corners are within the picture, and before the eye. */
static double fit_distance(sb_vec3 low, sb_vec3 high, const sb_view *view)
{
    const sb_vec3 middle = sb_scale(sb_add(low, high), 0.5);
    double distance = 0;
    for (int corner = 0; corner < 8; corner++) {
        const sb_vec3 at = sb_sub(
            sb_vec(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z), middle);
        const double ahead = sb_dot(at, view->back);
        const double across = fabs(sb_dot(at, view->right)) / (view->tangent * view->aspect);
        distance = fmax(distance, ahead + fmax(across, fabs(sb_dot(at, view->up)) / view->tangent));
    }
    return distance;
}

sb_camera_key sb_cameras_fit(sb_vec3 low, sb_vec3 high, sb_vec3 direction, double fov, double aspect, double margin)
{
    const sb_vec3 middle = sb_scale(sb_add(low, high), 0.5), toward = sb_normalize(direction);
    sb_camera_key key = {.eye = sb_add(middle, toward), .target = middle, .fov = fov};
    const sb_view view = sb_view_create(&key, aspect, low, high);
    const double distance = margin * fit_distance(low, high, &view);
    key.eye = sb_madd(middle, distance > 0 ? distance : 1, toward);
    return key;
}

static sb_camera_key close_up(const sb_camera *camera, const sb_model *model, const sb_frame *frame, double aspect)
{
    sb_vec3 low = model->min, high = model->max;
    const size_t body = find_body(model, camera->body);
    if (body < model->body_count) find_box(model, body, frame, &low, &high);
    sb_camera_key key = sb_cameras_fit(low, high, camera->direction, camera->fov, aspect, camera->margin);
    key.time = frame->status.time;
    return key;
}

/* ---- circles ---- */

static sb_camera_key around(const sb_camera *camera, double time)
{
    const sb_orbit *orbit = &camera->orbit;
    const double angle = orbit->from * DEGREE + 360 * DEGREE * (time / orbit->period);
    const sb_vec3 from = sb_vec(orbit->radius * cos(angle), orbit->radius * sin(angle), orbit->height);
    return (sb_camera_key){
        .time = time, .eye = sb_add(orbit->target, from), .target = orbit->target, .fov = camera->fov};
}

/* ---- the crest ---- */

enum { COLUMNS_MAX = 4096, COLUMN_SPACINGS = 2, BINS_MAX = 512 };

/* Particles by their column along the line and their height. */
typedef struct columns {
    double x, y, ux, uy, length, half; /* m, the line relative to the frame's origin, its direction, half the width */
    double size, low, bin;             /* m, of a column along the line; z of the lowest bin, its height */
    size_t count, bins;
    double extent;   /* m, of the water across the line */
    uint32_t *found; /* particles, by column and from the lowest bin up */
} columns;

static columns make_columns(const sb_follow *follow, const sb_frame *frame)
{
    columns c = {.x = follow->ax - frame->origin.x, .y = follow->ay - frame->origin.y};
    double high = -(double)INFINITY;
    c.length = hypot(follow->bx - follow->ax, follow->by - follow->ay);
    c.ux = (follow->bx - follow->ax) / c.length;
    c.uy = (follow->by - follow->ay) / c.length;
    c.half = follow->width > 0 ? follow->width / 2 : (double)INFINITY;
    c.size = fmax(COLUMN_SPACINGS * frame->spacing, c.length / COLUMNS_MAX);
    c.count = (size_t)ceil(c.length / c.size);
    c.low = (double)INFINITY;
    for (size_t i = 0; i < frame->count; i++) {
        c.low = fmin(c.low, (double)frame->position[3 * i + 2]);
        high = fmax(high, (double)frame->position[3 * i + 2]);
    }
    const double height = frame->count > 0 ? high - c.low : 0;
    c.bin = fmax(frame->spacing / 4, height / BINS_MAX);
    c.bins = (size_t)(height / c.bin) + 1;
    c.found = sb_alloc(c.count * c.bins, sizeof *c.found);
    return c;
}

static void count_particles(columns *c, const sb_frame *frame)
{
    double least = (double)INFINITY, most = -(double)INFINITY;
    for (size_t i = 0; i < frame->count; i++) {
        const double x = (double)frame->position[3 * i] - c->x, y = (double)frame->position[3 * i + 1] - c->y;
        const double along = x * c->ux + y * c->uy, beside = y * c->ux - x * c->uy;
        if (!(along >= 0 && along < c->length && fabs(beside) <= c->half)) continue;
        least = fmin(least, beside);
        most = fmax(most, beside);
        const size_t column = (size_t)(along / c->size);
        const size_t bin = (size_t)(((double)frame->position[3 * i + 2] - c->low) / c->bin);
        c->found[(column < c->count ? column : c->count - 1) * c->bins + (bin < c->bins ? bin : c->bins - 1)]++;
    }
    c->extent = most > least ? most - least : 0;
}

/* The bin above which a column has half a layer of particles, so that a rounded crest counts and spray does not. False:
   it has less water. */
static bool find_level(const columns *c, size_t column, double layer, size_t *level)
{
    double above = 0;
    for (size_t bin = c->bins; bin-- > 0;) {
        above += c->found[column * c->bins + bin];
        if (above < 0.5 * layer) continue;
        *level = bin;
        return true;
    }
    return false;
}

static int by_size(const void *left, const void *right)
{
    const size_t a = *(const size_t *)left, b = *(const size_t *)right;
    return (a > b) - (a < b);
}

bool sb_cameras_crest(const sb_follow *follow, const sb_frame *frame, int dimensions, double *place)
{
    columns c = make_columns(follow, frame);
    size_t *levels = sb_alloc(c.count, sizeof *levels), wet = 0, first = 0, last = 0, highest = 0;
    if (c.found && levels) {
        count_particles(&c, frame);
        const double rows = dimensions == 2 ? 1 : 1 + c.extent / frame->spacing;
        for (size_t column = 0; column < c.count; column++) {
            if (!find_level(&c, column, c.size / frame->spacing * rows, &levels[wet])) continue;
            if (wet == 0 || levels[wet] > highest) {
                first = last = column;
                highest = levels[wet];
            } else if (levels[wet] == highest && column == last + 1) {
                last = column; /* a flat crest: its middle counts */
            }
            wet++;
        }
    }
    if (wet > 0) qsort(levels, wet, sizeof *levels, by_size);
    const bool found = wet > 0 && (double)(highest - levels[wet / 2]) * c.bin > frame->spacing;
    if (found) *place = 0.5 * (double)(first + last + 1) * c.size;
    sb_free(c.found);
    sb_free(levels);
    return found;
}

/* Moves towards `aim` as a critically damped spring with the time constant `smoothing`, by its exact solution, so that
   the motion does not depend on the time between frames while the aim stays. */
static void approach(sb_camera_motion *motion, double aim, double smoothing, double time)
{
    const double dt = time - motion->time, rate = smoothing > 0 ? 2 / smoothing : 0;
    if (!motion->begun || !(smoothing > 0)) {
        motion->place = aim;
        motion->speed = 0;
    } else if (dt > 0) {
        const double away = motion->place - aim, pull = motion->speed + rate * away, decay = exp(-rate * dt);
        motion->place = aim + (away + pull * dt) * decay;
        motion->speed = (motion->speed - rate * pull * dt) * decay;
    }
    motion->begun = true;
    motion->time = time;
}

static sb_camera_key follow_crest(const sb_camera *camera, const sb_frame *frame, int dimensions,
                                  sb_camera_motion *motion)
{
    const sb_follow *follow = &camera->follow;
    sb_camera_key key = camera->keys[0];
    const sb_vec3 line = sb_vec(follow->bx - follow->ax, follow->by - follow->ay, 0), along = sb_normalize(line);
    const double rest = sb_dot(sb_sub(key.target, sb_vec(follow->ax, follow->ay, 0)), along);
    double aim = motion->begun ? motion->place : rest;
    (void)sb_cameras_crest(follow, frame, dimensions, &aim);
    approach(motion, aim, follow->smoothing, frame->status.time);
    const double moved = motion->place - rest;
    key.time = frame->status.time;
    key.target = sb_madd(key.target, moved, along);
    if (follow->travel) key.eye = sb_madd(key.eye, moved, along);
    /* The target may have come to the eye. */
    if (!(sb_norm(sb_sub(key.target, key.eye)) > 1e-6 * sb_norm(line))) key.target = sb_madd(key.eye, 1, along);
    return key;
}

sb_camera_key sb_cameras_at(const sb_scene *scene, const sb_model *model, size_t camera, const sb_frame *frame,
                            double aspect, sb_camera_motion *motion)
{
    const sb_camera *c = &scene->render.cameras[camera];
    switch (c->kind) {
    case SB_CAMERA_FOLLOW:
        return follow_crest(c, frame, scene->dimensions, motion);
    case SB_CAMERA_ORBIT:
        return around(c, frame->status.time);
    case SB_CAMERA_CLOSEUP:
        return close_up(c, model, frame, aspect);
    case SB_CAMERA_KEYS:
        break;
    }
    return sb_camera_at(c, frame->status.time);
}
