/* Creates a stream, takes values from the run, and sends the status and the scene. */
#include "stream/stream_state.h"

#include "base/clock.h"
#include "base/hash.h"
#include "base/memory.h"
#include "stream/scene_encode.h"

#include "shorebreak_scene_piece_t.h"
#include "shorebreak_status_t.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>

static const double STATUS_SECONDS = 0.5;

/* A cycle of all pieces of the scene: one that joins late has them within two seconds. A large scene takes longer, at
   most CYCLE_BYTES per second. */
static const double CYCLE_SECONDS = 1.5, CYCLE_BYTES = 12e6;

lcm_t *sb_stream_provider(sb_stream *stream)
{
    return stream->sender.lcm;
}

static int64_t draw_run_id(void)
{
    uint64_t bits;
    if (getrandom(&bits, sizeof bits, GRND_NONBLOCK) != (ssize_t)sizeof bits) {
        const double now = sb_clock(); /* early at boot: the time differs between two runs, too */
        bits = sb_hash(0, &now, sizeof now);
    }
    return (int64_t)(bits & (uint64_t)SB_STREAM_RUN_MAX);
}

sb_status sb_stream_create(const sb_stream_settings *settings, const char *run_name, sb_stream **stream,
                           sb_error *error)
{
    sb_stream *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the stream");
    pthread_mutex_init(&made->lock, NULL);
    made->interval = settings->interval;
    made->run_id = draw_run_id();
    made->url = sb_provider_url(settings->url);
    made->last_interval = -1;
    made->spread = 0.05;
    made->frame_time = made->status_time = made->cycle_begin = -1;
    const sb_stream_limits limits = {.decimation = settings->decimation, .bytes_per_second = SB_STREAM_BYTES_MAX};
    sb_stream_set_limits(made, &limits);
    snprintf(made->run, sizeof made->run, "%s", run_name ? run_name : "");
    const sb_status status = sb_sender_open(settings->url, settings->prefix, &made->sender, error);
    if (status != SB_OK) {
        sb_stream_destroy(made);
        return status;
    }
    *stream = made;
    return SB_OK;
}

static void free_rows(sb_stream_rows *rows)
{
    sb_free(rows->forces);
    sb_free(rows->gauges);
}

void sb_stream_destroy(sb_stream *stream)
{
    if (!stream) return;
    sb_sender_close(&stream->sender);
    free_rows(&stream->waiting);
    free_rows(&stream->sending);
    sb_points_free(&stream->points);
    sb_free(stream->encoded);
    pthread_mutex_destroy(&stream->lock);
    sb_free(stream);
}

void sb_stream_abandon(sb_stream *stream)
{
    static _Atomic(sb_stream *) last;
    stream->previous_abandoned = atomic_exchange(&last, stream);
}

sb_status sb_stream_set_scene(sb_stream *stream, const sb_scene *scene, const sb_model *model, sb_error *error)
{
    stream->scene = scene;
    stream->model = model;
    stream->progress.status.duration = scene->duration;
    stream->progress.status.eta_seconds = -1;
    stream->progress.fluid_particles = model->fluid_count;
    const sb_status status =
        sb_scene_encode(scene, model, stream->run_id, stream->run, &stream->encoded, &stream->encoded_size, error);
    if (status == SB_OK) stream->scene_id = (int64_t)sb_hash(0, stream->encoded, stream->encoded_size);
    return status;
}

const char *sb_stream_url(const sb_stream *stream)
{
    return stream->url;
}

int64_t sb_stream_run_id(const sb_stream *stream)
{
    return stream->run_id;
}

sb_stream_counters sb_stream_count(const sb_stream *stream)
{
    sb_stream_counters count = sb_sender_count(&stream->sender);
    count.errors += stream->row_errors;
    return count;
}

/* ---- values from the run ---- */

void sb_stream_set_progress(sb_stream *stream, const sb_stream_progress *progress)
{
    pthread_mutex_lock(&stream->lock);
    stream->progress = *progress;
    pthread_mutex_unlock(&stream->lock);
}

void sb_stream_set_state(sb_stream *stream, sb_run_state state)
{
    pthread_mutex_lock(&stream->lock);
    stream->state = state;
    pthread_mutex_unlock(&stream->lock);
}

void sb_stream_set_limits(sb_stream *stream, const sb_stream_limits *limits)
{
    sb_stream_limits set = *limits;
    if (!(set.rate >= 0) || !isfinite(set.rate)) set.rate = 0;
    if (set.decimation < 1) set.decimation = 1;
    if (!(set.bytes_per_second > 0))
        set.bytes_per_second = 0;
    else
        set.bytes_per_second = fmin(fmax(set.bytes_per_second, SB_STREAM_BYTES_MIN), SB_STREAM_BYTES_MAX);
    pthread_mutex_lock(&stream->lock);
    stream->limits = set;
    pthread_mutex_unlock(&stream->lock);
}

sb_stream_limits sb_stream_get_limits(sb_stream *stream)
{
    pthread_mutex_lock(&stream->lock);
    const sb_stream_limits limits = stream->limits;
    pthread_mutex_unlock(&stream->lock);
    return limits;
}

sb_stream_limits sb_stream_adapt(sb_stream_limits limits, double lost)
{
    static const double SOME = 0.002, SLOWER = 0.7, FASTER = 1.05;
    double pace = limits.bytes_per_second > 0 ? limits.bytes_per_second : SB_STREAM_BYTES_MAX;
    pace *= lost > SOME ? SLOWER : lost > 0 ? 1 : FASTER;
    limits.bytes_per_second = fmin(fmax(pace, SB_STREAM_BYTES_MIN), SB_STREAM_BYTES_MAX);
    return limits;
}

/* ---- status ---- */

/* The region that is sent: without a limit, the domain. */
static void put_region(const sb_stream *stream, const sb_stream_limits *limits, shorebreak_status_t *message)
{
    const sb_vec3 zero = {0};
    sb_stream_store(message->region_min, limits->region  ? limits->min
                                         : stream->scene ? stream->scene->domain.min
                                                         : zero);
    sb_stream_store(message->region_max, limits->region  ? limits->max
                                         : stream->scene ? stream->scene->domain.max
                                                         : zero);
}

static void send_status(sb_stream *stream)
{
    pthread_mutex_lock(&stream->lock);
    const sb_stream_progress progress = stream->progress;
    const sb_stream_limits limits = stream->limits;
    const sb_run_state state = stream->sent_state = stream->state;
    pthread_mutex_unlock(&stream->lock);
    const sb_frame_status *status = &progress.status;
    const sb_stream_counters count = sb_stream_count(stream);
    char *stages[SB_STAGES_MAX];
    double seconds[SB_STAGES_MAX];
    for (size_t i = 0; i < progress.stage_count; i++) {
        stages[i] = (char *)(uintptr_t)progress.stages[i].name; /* the encoder does not write through it */
        seconds[i] = progress.stages[i].seconds;
    }
    shorebreak_status_t message = {
        .version = SB_STREAM_VERSION,
        .run_id = stream->run_id,
        .run = stream->run,
        .state = (int8_t)state,
        .step = (int64_t)status->step,
        .time = status->time,
        .duration = status->duration,
        .time_step = status->time_step,
        .iterations = status->iterations,
        .capped_steps = (int64_t)progress.capped_steps,
        .density_error = status->density_error,
        .density_error_max = progress.density_error_max,
        .tolerance = progress.tolerance,
        .max_speed = status->max_speed,
        .wall_seconds = status->wall_seconds,
        .eta_seconds = isfinite(status->eta_seconds) ? status->eta_seconds : -1,
        .lost_particles = (int64_t)status->lost_particles,
        .fluid_particles = (int64_t)progress.fluid_particles,
        .frame = stream->frame,
        .messages = (int64_t)count.messages,
        .bytes = (int64_t)count.bytes,
        .errors = (int64_t)count.errors,
        .frames_skipped = (int64_t)(progress.frames_dropped + stream->skipped),
        .rate = limits.rate,
        .decimation = limits.decimation,
        .stage_count = (int32_t)progress.stage_count,
        .stages = stages,
        .stage_seconds = seconds,
    };
    put_region(stream, &limits, &message);
    sb_sender_send(&stream->sender, SB_CHANNEL_STATUS, stream->buffer,
                   shorebreak_status_t_encode(stream->buffer, 0, sizeof stream->buffer, &message));
    stream->status_time = sb_clock();
}

/* ---- scene ---- */

static void send_piece(sb_stream *stream, int32_t piece, int32_t pieces, double pace)
{
    const size_t offset = (size_t)piece * SB_STREAM_PIECE, left = stream->encoded_size - offset;
    shorebreak_scene_piece_t message = {
        .version = SB_STREAM_VERSION,
        .run_id = stream->run_id,
        .scene_id = stream->scene_id,
        .total = (int64_t)stream->encoded_size,
        .piece = piece,
        .piece_count = pieces,
        .offset = (int64_t)offset,
        .count = (int32_t)(left < SB_STREAM_PIECE ? left : SB_STREAM_PIECE),
        .data = stream->encoded + offset,
    };
    sb_sender_send_paced(&stream->sender, SB_CHANNEL_SCENE, stream->buffer,
                         shorebreak_scene_piece_t_encode(stream->buffer, 0, sizeof stream->buffer, &message), pace);
}

/* Sends the pieces that are due. They are spread evenly over a cycle. */
static void send_pieces(sb_stream *stream, double now)
{
    if (!stream->encoded) return;
    const int32_t pieces = (int32_t)((stream->encoded_size + SB_STREAM_PIECE - 1) / SB_STREAM_PIECE);
    const double cycle = fmax(CYCLE_SECONDS, (double)stream->encoded_size / CYCLE_BYTES);
    if (stream->cycle_begin < 0 || now >= stream->cycle_begin + cycle) {
        stream->cycle_begin = now;
        stream->next_piece = 0;
    }
    /* Faster than the mean, so that the pieces that are due at once are sent before the next ones are. */
    const double most = sb_stream_get_limits(stream).bytes_per_second;
    const double pace =
        fmin(fmax(3 * (double)stream->encoded_size / cycle, 4e6), most > 0 ? most : SB_STREAM_BYTES_MAX);
    while (stream->next_piece < pieces && now >= stream->cycle_begin + cycle * stream->next_piece / pieces)
        send_piece(stream, stream->next_piece++, pieces, pace);
}

/* ---- */

/* Whether the state is another one than the last status had. */
static bool state_changed(sb_stream *stream)
{
    pthread_mutex_lock(&stream->lock);
    const bool changed = stream->state != stream->sent_state;
    pthread_mutex_unlock(&stream->lock);
    return changed;
}

double sb_stream_serve(sb_stream *stream)
{
    const double now = sb_clock();
    const bool late = stream->status_time < 0 || now >= stream->status_time + STATUS_SECONDS;
    if (late || state_changed(stream)) send_status(stream); /* a reply to a command comes after the state it caused */
    sb_stream_send_replies(stream);
    sb_stream_send_rows(stream);
    send_pieces(stream, now);
    return SB_STREAM_SERVE;
}

void sb_stream_publish(sb_stream *stream, const sb_frame *frame)
{
    sb_stream_send_replies(stream);
    send_status(stream);
    sb_stream_send_rows(stream);
    sb_stream_send_frame(stream, frame);
    send_pieces(stream, sb_clock());
}

void sb_stream_finish(sb_stream *stream)
{
    sb_stream_set_state(stream, SB_RUN_DONE);
    sb_stream_send_replies(stream);
    sb_stream_send_rows(stream);
    send_status(stream);
}
