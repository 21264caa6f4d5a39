/* The threads that read the frames of a run: stream, particle files, pictures. */
#include "app/check/room.h"
#include "app/run/parts.h"
#include "app/steering/steering.h"

#include <string.h>

/* The title, or else the name of the directory. */
static const char *run_name(const run *r)
{
    const char *slash = strrchr(r->directory, '/');
    return r->scene->title && *r->scene->title ? r->scene->title : slash && slash[1] ? slash + 1 : r->directory;
}

static sb_status start_streamer(run *r, sb_error *error)
{
    sb_error reason = {0};
    if (sb_stream_create(&r->scene->stream, run_name(r), &r->streamer.stream, &reason) != SB_OK) {
        sb_run_warn(r, "%s", reason.text);
        return SB_OK;
    }
    if (sb_stream_set_scene(r->streamer.stream, r->scene, &r->model, &reason) != SB_OK)
        sb_run_warn(r, "stream: no scene message: %.900s", reason.text);
    sb_consumer_work work = sb_streamer_work(&r->streamer);
    const sb_status status = sb_consumer_start(&r->consumers[STREAMER], &work, r->scene->stream.interval,
                                               sb_room_waiting(r->model.fluid_count), SB_QUEUE_DROP_OLDEST, error);
    if (status != SB_OK) {
        sb_stream_destroy(r->streamer.stream);
        r->streamer.stream = NULL;
    }
    return status;
}

static void note_off(run *r)
{
    const sb_scene *scene = r->scene;
    size_t n = 0;
    if (!scene->stream.enabled) r->off[n++].what = "stream: off, no LCM thread";
    if (!(scene->output.particle_interval > 0)) r->off[n++].what = "particle files: off, no thread";
    if (!sb_scene_draws(scene))
        r->off[n++] = (sb_skipped){"pictures: off, no thread, no graphics memory", 0, sb_room_graphics()};
    else if (!scene->render.video)
        r->off[n++].what = "films: off, pictures are not joined";
    if (!scene->output.plots) r->off[n++].what = "plots: off, tables are not drawn";
    if (!r->checkpoints.on) r->off[n++].what = "checkpoints: off, also on a signal; --resume starts from the beginning";
    r->off[n].what = NULL;
}

sb_status sb_run_start_consumers(run *r, sb_error *error)
{
    const sb_scene *scene = r->scene;
    const size_t waiting = sb_room_waiting(r->model.fluid_count);
    sb_status status = SB_OK;
    note_off(r);
    if (scene->stream.enabled) status = start_streamer(r, error);
    if (status == SB_OK) sb_steering_start(r);
    if (status == SB_OK && scene->output.particle_interval > 0) {
        sb_consumer_work work = sb_recorder_work(&r->recorder);
        status = sb_consumer_start(&r->consumers[RECORDER], &work, scene->output.particle_interval, waiting,
                                   SB_QUEUE_WAIT, error);
    }
    if (status == SB_OK && sb_scene_draws(scene)) {
        sb_consumer_work work = sb_pictures_work(&r->pictures);
        /* Without a film the interval is not used: the times are those of picture_times. */
        const double interval = scene->render.interval > 0 ? scene->render.interval : 1;
        status = sb_consumer_start(&r->consumers[PICTURES], &work, interval, waiting, SB_QUEUE_WAIT, error);
    }
    for (int c = 0; c < CONSUMERS; c++) r->consumers[c].next = r->due[c];
    r->consumers[PICTURES].next = sb_picture_times_next(&r->picture_times);
    return status;
}

void sb_run_name_consumers(run *r)
{
    r->recorder = (sb_recorder){.directory = r->directory,
                                .format = r->scene->output.particle_pieces ? &sb_particles_pvtp : &sb_particles_vtp,
                                .foam = r->scene->foam.enabled,
                                .ranks = r->scene->output.particle_pieces ? sb_ranks_count(r->cluster.ranks) : 1};
    r->streamer = (sb_streamer){.log = r->log};
}
