#include "app/steering/picture_now.h"

#include "app/cluster/cluster.h"
#include "app/grid/picture.h"
#include "app/run/parts.h"
#include "base/memory.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#define FOLDER "pictures"

enum { NICENESS = 10 };                 /* of the thread, as of that of pictures.c */
static const double FIELD_OF_VIEW = 45; /* degrees, of a picture from eye to target */

static sb_status make_renderer(const run *r, sb_requested *p, sb_error *error)
{
    if (p->renderer) return SB_OK;
    setpriority(PRIO_PROCESS, 0, NICENESS); /* if refused, the niceness stays as it is */
    return sb_renderer_create(&p->poses.scene, &r->model, &p->renderer, error);
}

/* Finds a name that no file has: a picture of the same camera and step may exist. */
static sb_status name_file(const run *r, const sb_requested *p, char name[SB_STREAM_TEXT], char path[SB_PATH_MAX],
                           sb_error *error)
{
    enum { MOST = 10000 };
    char folder[SB_PATH_MAX];
    const char *camera = p->poses.scene.render.cameras[p->camera].name;
    sb_status status = sb_make_folder(folder, r->directory, FOLDER, error);
    for (int k = 1; status == SB_OK && k < MOST; k++) {
        char more[16] = "";
        if (k > 1) snprintf(more, sizeof more, "-%d", k);
        snprintf(name, SB_STREAM_TEXT, FOLDER "/%s-%06llu%s.png", camera, (unsigned long long)p->step, more);
        status = sb_run_path(r, name, path, error);
        if (status == SB_OK && access(path, F_OK) != 0) return SB_OK;
    }
    return status == SB_OK ? sb_fail(error, SB_FAILED, "%.100s: exists", name) : status;
}

/* Puts a camera of the scene where it is at the frame's time. The view of a command has its place already. */
static void pose(const run *r, sb_requested *p, const sb_frame *frame)
{
    const double aspect = (double)r->scene->render.width / r->scene->render.height;
    sb_camera_motion motion = {0}; /* a camera that follows looks at the crest at once */
    if (p->camera < r->scene->render.camera_count)
        p->poses.keys[p->camera] = sb_cameras_at(r->scene, &r->model, p->camera, frame, aspect, &motion);
}

static sb_status draw(void *state, const sb_frame *frame, sb_error *error)
{
    run *r = state;
    sb_requested *p = &r->requested;
    char name[SB_STREAM_TEXT] = "", path[SB_PATH_MAX];
    sb_status status = make_renderer(r, p, error);
    if (status == SB_OK) pose(r, p, frame);
    if (status == SB_OK) status = sb_renderer_draw(p->renderer, frame, p->camera, &p->image, error);
    if (status == SB_OK) status = name_file(r, p, name, path, error);
    if (status == SB_OK) status = sb_png_write(path, &p->image, error);
    sb_steering_reply(r, &p->command, p->step, frame->status.time, status != SB_OK,
                      status == SB_OK ? name : error->text);
    return status;
}

static void close_renderer(void *state)
{
    run *r = state;
    sb_renderer_destroy(r->requested.renderer);
    sb_image_free(&r->requested.image);
    r->requested.renderer = NULL;
}

/* The cameras of the scene and one more, the view that a command gives. */
static sb_status begin(run *r, sb_error *error)
{
    sb_requested *p = &r->requested;
    const sb_consumer_work work = {.name = "requested pictures", .state = r, .handle = draw, .close = close_renderer};
    if (p->poses.keys) return SB_OK;
    sb_status status = sb_poses_create(&p->poses, r->scene, 1, error);
    if (status != SB_OK) return status;
    status = sb_consumer_start(&p->consumer, &work, 1, 1, SB_QUEUE_WAIT, error);
    if (status != SB_OK) sb_poses_free(&p->poses);
    return status;
}

static sb_status choose_camera(run *r, const sb_command *command, sb_error *error)
{
    sb_requested *p = &r->requested;
    const double *at = command->number;
    const size_t count = r->scene->render.camera_count;
    size_t c = 0;
    while (c < count && strcmp(r->scene->render.cameras[c].name, command->name) != 0) c++;
    if (*command->name && c == count)
        return sb_fail(error, SB_BAD_INPUT, "camera \"%s\": there is none of this name", command->name);
    if (!*command->name) c = count;
    p->poses.keys[count] = (sb_camera_key){
        .eye = sb_vec(at[0], at[1], at[2]), .target = sb_vec(at[3], at[4], at[5]), .fov = FIELD_OF_VIEW};
    p->camera = c;
    return SB_OK;
}

sb_status sb_picture_now(run *r, const sb_command *command, sb_error *error)
{
    sb_requested *p = &r->requested;
    if (p->consumer.given_up) return sb_fail(error, SB_FAILED, "the thread that draws makes no progress");
    if (p->consumer.started && !sb_consumer_is_idle(&p->consumer))
        return sb_fail(error, SB_BAD_INPUT, "the picture before is being drawn, expected a command after that");
    sb_status status = begin(r, error);
    if (status == SB_OK) status = choose_camera(r, command, error); /* the thread is idle */
    if (status != SB_OK) return status;
    p->command = *command;
    p->step = sb_sim_report(r->sim)->step;
    sb_cluster_find_pressures(r);
    sb_frame *frame = sb_cluster_snapshot(r);
    if (!frame) return sb_fail_memory(error, "a frame");
    frame->index = r->frames;
    status = sb_measure_fill_frame(r->measure, frame, error);
    if (status == SB_OK) status = sb_grid_picture_add(r->sim, r->scene, frame, error);
    if (status != SB_OK) {
        sb_frame_release(frame);
        return status;
    }
    sb_consumer_feed(&p->consumer, frame);
    sb_frame_release(frame);
    return SB_OK;
}

void sb_picture_now_end(run *r)
{
    sb_consumer_stop(&r->requested.consumer);
}

void sb_picture_now_free(run *r)
{
    sb_poses_free(&r->requested.poses);
}
