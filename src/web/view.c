#include "web/view.h"

#include "base/memory.h"
#include "output/log/json.h"
#include "web/records.h"

#include <string.h>

enum { REPLIES = 8 };

struct sb_web_view {
    sb_live *live;
    sb_web_blob *frame, *scene;
    uint64_t frame_number, scene_number;
    int64_t run_id; /* -1: none yet */
    sb_history_table forces, gauges;
    bool cut_forces, cut_gauges; /* the next rows are the first of another process of the run */
    char run[SB_STREAM_NAME];
    bool has_status; /* also after a restart, until the new process has sent its own */
    sb_status_message status;
    sb_reply_message replies[REPLIES]; /* the last ones, in turns */
    uint64_t reply_count;
    double heard; /* s, of sb_clock, of the last valid message of the run */
};

static void on_restart(void *user, int64_t run_id)
{
    sb_web_view *view = user;
    view->run_id = run_id;
    view->cut_forces = view->cut_gauges = true;
}

static void on_scene(void *user, const sb_live_scene *scene)
{
    sb_web_view *view = user;
    sb_web_blob *made = sb_web_record_scene(scene);
    if (!made) return;
    const bool same =
        view->scene && view->scene->size == made->size && memcmp(view->scene->bytes, made->bytes, made->size) == 0;
    if (same) {
        sb_web_blob_release(made);
        return;
    }
    sb_web_blob_release(view->scene);
    view->scene = made;
    view->scene_number++;
}

static void on_status(void *user, const sb_status_message *message)
{
    sb_web_view *view = user;
    if (view->has_status && strcmp(view->run, message->run) != 0) {
        sb_history_clear(&view->forces);
        sb_history_clear(&view->gauges);
    }
    memcpy(view->run, message->run, sizeof view->run);
    view->run_id = message->head.run_id;
    view->status = *message;
    view->has_status = true;
}

static void on_reply(void *user, const sb_reply_message *message)
{
    sb_web_view *view = user;
    view->replies[view->reply_count++ % REPLIES] = *message;
}

static void on_forces(void *user, const sb_forces_message *m)
{
    sb_web_view *view = user;
    float values[3 * SB_STREAM_ROWS];
    if (view->cut_forces) sb_history_cut(&view->forces, m->time);
    view->cut_forces = false;
    for (int i = 0; i < 3 * m->count; i++) values[i] = (float)m->force[i];
    sb_history_add(&view->forces,
                   &(sb_history_rows){m->time, (size_t)m->total, (size_t)m->first, (size_t)m->count, m->names, values});
}

static void on_gauges(void *user, const sb_gauges_message *m)
{
    sb_web_view *view = user;
    float values[SB_STREAM_ROWS];
    if (view->cut_gauges) sb_history_cut(&view->gauges, m->time);
    view->cut_gauges = false;
    for (int i = 0; i < m->count; i++) values[i] = m->wet[i] ? (float)m->eta[i] : NAN;
    sb_history_add(&view->gauges,
                   &(sb_history_rows){m->time, (size_t)m->total, (size_t)m->first, (size_t)m->count, m->names, values});
}

static void on_frame(void *user, const sb_live_frame *frame)
{
    sb_web_view *view = user;
    sb_web_blob *made = sb_web_record_frame(frame, view->run_id);
    if (!made) return;
    sb_web_blob_release(view->frame);
    view->frame = made;
    view->frame_number++;
}

sb_web_view *sb_web_view_create(void)
{
    sb_web_view *view = sb_alloc(1, sizeof *view);
    if (!view) return NULL;
    view->run_id = -1;
    view->forces = (sb_history_table){.components = 3, .stride = 1};
    view->gauges = (sb_history_table){.components = 1, .stride = 1};
    const sb_live_calls calls = {.user = view,
                                 .restarted = on_restart,
                                 .scene = on_scene,
                                 .status = on_status,
                                 .forces = on_forces,
                                 .gauges = on_gauges,
                                 .reply = on_reply,
                                 .frame = on_frame};
    view->live = sb_live_create(&calls);
    if (view->live) return view;
    sb_web_view_destroy(view);
    return NULL;
}

void sb_web_view_destroy(sb_web_view *view)
{
    if (!view) return;
    sb_live_destroy(view->live);
    sb_web_blob_release(view->frame);
    sb_web_blob_release(view->scene);
    sb_history_free(&view->forces);
    sb_history_free(&view->gauges);
    sb_free(view);
}

void sb_web_view_take(sb_web_view *view, sb_channel_kind kind, const void *data, size_t size, double time)
{
    const uint64_t foreign = sb_live_count(view->live).foreign;
    if (sb_live_take(view->live, kind, data, size, time) != SB_OK) return;
    if (sb_live_count(view->live).foreign == foreign) view->heard = time;
}

sb_web_blob *sb_web_view_frame(const sb_web_view *view)
{
    return view->frame;
}

sb_web_blob *sb_web_view_scene(const sb_web_view *view)
{
    return view->scene;
}

uint64_t sb_web_view_frame_number(const sb_web_view *view)
{
    return view->frame_number;
}

const sb_history_table *sb_web_view_forces(const sb_web_view *view)
{
    return &view->forces;
}

const sb_history_table *sb_web_view_gauges(const sb_web_view *view)
{
    return &view->gauges;
}

bool sb_web_view_has_status(const sb_web_view *view)
{
    return view->has_status;
}

const sb_live *sb_web_view_live(const sb_web_view *view)
{
    return view->live;
}

int64_t sb_web_view_run_id(const sb_web_view *view)
{
    return view->run_id;
}

static void write_table(sb_json *json, const char *key, const sb_history_table *table)
{
    sb_json_open(json, key, '{');
    sb_json_count(json, "generation", table->generation);
    sb_json_count(json, "rows", sb_history_count(table));
    sb_json_close(json);
}

static void write_run(sb_json *json, const sb_status_message *s)
{
    sb_json_count(json, "run_id", (uint64_t)s->head.run_id);
    sb_json_number(json, "duration_s", s->duration);
    sb_json_number(json, "time_step_s", s->time_step);
    sb_json_number(json, "wall_s", s->wall_seconds);
    sb_json_count(json, "iterations", (uint64_t)s->iterations);
    sb_json_count(json, "capped_steps", (uint64_t)s->capped_steps);
    sb_json_number(json, "density_error", s->density_error);
    sb_json_number(json, "density_error_max", s->density_error_max);
    sb_json_number(json, "tolerance", s->tolerance);
    sb_json_number(json, "max_speed", s->max_speed);
    sb_json_count(json, "fluid_particles", (uint64_t)s->fluid_particles);
    sb_json_count(json, "lost_particles", (uint64_t)s->lost_particles);
    sb_json_number(json, "rate", s->rate);
    sb_json_count(json, "decimation", (uint64_t)s->decimation);
    sb_json_vector(json, "region_min", sb_vec(s->region_min[0], s->region_min[1], s->region_min[2]));
    sb_json_vector(json, "region_max", sb_vec(s->region_max[0], s->region_max[1], s->region_max[2]));
}

static void write_stream(sb_json *json, const sb_web_view *view, double now)
{
    const sb_live_counts counts = sb_live_count(view->live);
    sb_json_number(json, "silent_s", now > view->heard ? now - view->heard : 0);
    sb_json_count(json, "restarts", counts.restarts);
    sb_json_open(json, "stream", '{');
    sb_json_count(json, "messages", counts.messages);
    sb_json_count(json, "lost", counts.lost);
    sb_json_count(json, "invalid", counts.refused);
    sb_json_count(json, "foreign", counts.foreign);
    sb_json_count(json, "frames", counts.frames_complete);
    sb_json_count(json, "frames_incomplete", counts.frames_partial);
    sb_json_count(json, "parts_repaired", counts.parts_repaired);
    sb_json_close(json);
    sb_json_count(json, "frame", view->frame_number);
    sb_json_count(json, "scene", view->scene_number);
    write_table(json, "forces", &view->forces);
    write_table(json, "gauges", &view->gauges);
}

static void write_replies(sb_json *json, const sb_web_view *view)
{
    sb_json_open(json, "replies", '[');
    for (uint64_t i = view->reply_count > REPLIES ? view->reply_count - REPLIES : 0; i < view->reply_count; i++) {
        const sb_reply_message *reply = &view->replies[i % REPLIES];
        sb_json_open(json, NULL, '{');
        sb_json_count(json, "id", (uint64_t)reply->id);
        sb_json_bool(json, "refused", reply->refused);
        sb_json_count(json, "step", (uint64_t)reply->step);
        sb_json_number(json, "time_s", reply->time);
        sb_json_text(json, "text", reply->text);
        sb_json_close(json);
    }
    sb_json_close(json);
}

void sb_web_view_write_status(const sb_web_view *view, const sb_web_extra *extra, double now, FILE *stream)
{
    const sb_status_message *s = &view->status;
    const sb_live_counts counts = sb_live_count(view->live);
    const double sent = (double)counts.lost + (double)(counts.messages - counts.refused - counts.foreign);
    sb_json json;
    sb_json_begin(&json, stream, false);
    sb_json_open(&json, NULL, '{');
    sb_json_text(&json, "run", s->run);
    sb_json_number(&json, "time_s", s->time);
    sb_json_count(&json, "step", (uint64_t)s->step);
    sb_json_text(&json, "state", sb_run_state_name(s->state));
    sb_json_number(&json, "eta_s", s->eta_seconds >= 0 ? s->eta_seconds : (double)NAN);
    sb_json_number(&json, "loss", sent > 0 ? (double)counts.lost / sent : 0);
    write_run(&json, s);
    write_stream(&json, view, now);
    write_replies(&json, view);
    sb_json_bool(&json, "commands", extra->commands);
    sb_json_bool(&json, "plots", extra->plots);
    sb_json_count(&json, "clients", extra->clients);
    sb_json_count(&json, "requests_refused", extra->refused);
    sb_json_close(&json);
}
