#include "app/frames/render_log.h"

#include "app/frames/log_scene.h"
#include "stream/log.h"

#include <stdio.h>

/* What the callbacks share. The first error ends the reading. */
typedef struct reading {
    sb_pictures *pictures; /* NULL: the scene is wanted, not the frames */
    sb_consumer_work work;
    sb_live *live;
    bool quiet, has_scene;
    uint64_t others; /* frames with another spacing */
    sb_scene scene;
    sb_model model;
    sb_status status;
    sb_error *error;
} reading;

static void on_scene(void *user, const sb_live_scene *live)
{
    reading *r = user;
    if (r->has_scene || r->pictures) return;
    r->status = sb_log_scene(live, &r->scene, &r->model, r->error);
    r->has_scene = r->status == SB_OK;
}

/* A log may hold several runs: those that were resumed have the spacing of the first one. Frames of others are left
   out. */
static void on_frame(void *user, const sb_live_frame *live)
{
    reading *r = user;
    const sb_live_scene *scene = sb_live_get_scene(r->live);
    if (!r->pictures || r->status != SB_OK || !scene) return;
    if (live->spacing < scene->spacing || live->spacing > scene->spacing) {
        r->others++;
        return;
    }
    sb_frame *frame = sb_log_frame(scene, live);
    r->status = frame ? r->work.handle(r->pictures, frame, r->error) : sb_fail_memory(r->error, "a frame");
    if (!r->quiet && r->status == SB_OK)
        printf("t = %g s: picture %llu\n", live->time, (unsigned long long)r->pictures->film.count);
    sb_frame_release(frame);
}

/* The pieces of the scene may come after the first frames: they are taken first. */
static void take_scene(sb_log *log, sb_live *live)
{
    sb_log_event event;
    while (!sb_live_get_scene(live) && sb_log_next(log, &event)) {
        const sb_channel_kind kind = sb_channel_guess(event.channel);
        if (kind == SB_CHANNEL_SCENE) sb_live_take(live, kind, event.data, event.size, event.time);
    }
    sb_log_rewind(log);
}

static sb_status read_log(const char *path, reading *r, sb_error *error)
{
    sb_log *log = NULL;
    sb_log_event event;
    const sb_live_calls calls = {.user = r, .scene = on_scene, .frame = on_frame};
    r->error = error;
    r->live = sb_live_create(&calls);
    if (!r->live) return sb_fail_memory(error, "a log");
    sb_status status = sb_log_open(path, &log, error);
    if (status == SB_OK) take_scene(log, r->live);
    if (status == SB_OK && !sb_live_get_scene(r->live))
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: has no complete scene of a run of this version", path);
    while (status == SB_OK && r->status == SB_OK && r->pictures && sb_log_next(log, &event)) {
        const sb_channel_kind kind = sb_channel_guess(event.channel);
        if (kind == SB_CHANNEL_FRAME || kind == SB_CHANNEL_PARITY || kind == SB_CHANNEL_STATUS)
            sb_live_take(r->live, kind, event.data, event.size, event.time);
    }
    if (status == SB_OK) status = r->status;
    if (r->others > 0)
        fprintf(stderr, "shorebreak: warning: %.500s: %llu frames have another particle spacing and are left out\n",
                path, (unsigned long long)r->others);
    sb_log_close(log);
    sb_live_destroy(r->live);
    return status;
}

sb_status sb_render_log_scene(const char *path, sb_scene *scene, sb_model *model, sb_error *error)
{
    reading r = {0};
    const sb_status status = read_log(path, &r, error);
    if (status != SB_OK) return status;
    *scene = r.scene;
    *model = r.model;
    return SB_OK;
}

sb_status sb_render_log_draw(const char *path, sb_pictures *pictures, bool quiet, sb_error *error)
{
    reading r = {.pictures = pictures, .work = sb_pictures_work(pictures), .quiet = quiet};
    sb_status status = r.work.open(pictures, error);
    if (status == SB_OK) status = read_log(path, &r, error);
    r.work.close(pictures);
    if (status == SB_OK && pictures->film.count == 0)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: has no complete frame", path);
    return status;
}
