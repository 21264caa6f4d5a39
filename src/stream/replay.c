#include "stream/replay.h"

#include "base/clock.h"
#include "base/hash.h"
#include "base/memory.h"
#include "stream/log.h"
#include "stream/sender.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* As in stream.c: the status comes at least so often, and a cycle holds all pieces of the scene. */
static const double STATUS_SECONDS = 0.5, CYCLE_SECONDS = 1.5, SERVE_SECONDS = 0.05;

static const double PACE = 1e8; /* bytes per second */

/* s; a longer wait between two messages is shortened: a run sends a status twice per second, so that such a gap is
   between two runs or in a damaged log. */
static const double LONGEST_GAP = 10;

typedef struct kept_message {
    size_t size; /* 0: not received yet */
    unsigned char *bytes;
} kept_message;

struct sb_replay {
    sb_log *log;
    sb_sender sender;
    sb_live *live;
    double speed;
    bool begun, ended, waiting; /* waiting: `event` was read and is not due yet */
    double first_time, started; /* of the first message: time of the recording, and sb_clock() */
    sb_log_event event;
    sb_channel_kind kind;
    int64_t recorded_id, run_id; /* of the present run in the log, and as it is published */
    kept_message status;
    double status_time;
    /* Pieces of the newest scene, as they were recorded. */
    int64_t scene_id;
    int32_t piece_count, next_piece;
    kept_message *pieces;
    double cycle_begin;
    unsigned char buffer[SB_STREAM_MESSAGE_MAX];
};

/* ---- messages that are repeated ---- */

static bool keep(kept_message *kept, const void *data, size_t size)
{
    unsigned char *bytes = kept->size == size ? kept->bytes : sb_alloc(size, 1);
    if (!bytes) return false;
    if (bytes != kept->bytes) sb_free(kept->bytes);
    memcpy(bytes, data, size);
    *kept = (kept_message){size, bytes};
    return true;
}

static void forget_pieces(sb_replay *r)
{
    for (int32_t i = 0; i < r->piece_count; i++) sb_free(r->pieces[i].bytes);
    sb_free(r->pieces);
    r->pieces = NULL;
    r->piece_count = r->next_piece = 0;
    r->cycle_begin = -1;
}

static void keep_piece(sb_replay *r, const void *data, size_t size)
{
    sb_scene_piece_message piece;
    if (sb_stream_decode_piece(data, size, &piece, NULL) != SB_OK) return;
    if (r->piece_count != piece.piece_count || r->scene_id != piece.scene_id) {
        forget_pieces(r);
        r->pieces = sb_alloc((size_t)piece.piece_count, sizeof *r->pieces);
        if (!r->pieces) return;
        r->piece_count = piece.piece_count;
        r->scene_id = piece.scene_id;
    }
    if (r->pieces[piece.piece].size == 0) keep(&r->pieces[piece.piece], data, size);
}

/* ---- publishing ---- */

/* A new id, so that subscribers of an earlier replay notice that it begins again. */
static int64_t renumber(int64_t recorded)
{
    const double now = sb_clock();
    return (int64_t)(sb_hash((uint64_t)recorded, &now, sizeof now) & (uint64_t)SB_STREAM_RUN_MAX);
}

static void publish(sb_replay *r, sb_channel_kind kind, const void *data, size_t size)
{
    const uint64_t id = __builtin_bswap64((uint64_t)r->run_id);
    const bool large = kind == SB_CHANNEL_FRAME || kind == SB_CHANNEL_PARITY || kind == SB_CHANNEL_SCENE;
    memcpy(r->buffer, data, size);
    memcpy(r->buffer + SB_RUN_ID_OFFSET, &id, sizeof id);
    if (large)
        sb_sender_send_paced(&r->sender, kind, r->buffer, (int)size, PACE);
    else
        sb_sender_send(&r->sender, kind, r->buffer, (int)size);
    if (kind == SB_CHANNEL_STATUS) r->status_time = sb_clock();
}

static void repeat_pieces(sb_replay *r, double now)
{
    if (r->piece_count == 0) return;
    if (r->cycle_begin < 0 || now >= r->cycle_begin + CYCLE_SECONDS) {
        r->cycle_begin = now;
        r->next_piece = 0;
    }
    while (r->next_piece < r->piece_count && now >= r->cycle_begin + CYCLE_SECONDS * r->next_piece / r->piece_count) {
        const kept_message *piece = &r->pieces[r->next_piece++];
        if (piece->size > 0) publish(r, SB_CHANNEL_SCENE, piece->bytes, piece->size);
    }
}

static void repeat(sb_replay *r)
{
    const double now = sb_clock();
    repeat_pieces(r, now);
    if (r->status.size > 0 && now >= r->status_time + STATUS_SECONDS)
        publish(r, SB_CHANNEL_STATUS, r->status.bytes, r->status.size);
}

/* ---- reading ---- */

/* Reads the next message of the run's channels. False: there is none. */
static bool next_event(sb_replay *r)
{
    while (!r->waiting) {
        if (!sb_log_next(r->log, &r->event)) return false;
        r->kind = sb_channel_find(r->event.channel, (const sb_channel *)r->sender.channels);
        r->waiting = r->kind != SB_CHANNELS;
    }
    return true;
}

/* The id with which a valid message begins. */
static int64_t id_of(const unsigned char *data)
{
    uint64_t word;
    memcpy(&word, data + SB_RUN_ID_OFFSET, sizeof word);
    return (int64_t)__builtin_bswap64(word);
}

static void follow(sb_replay *r, int64_t recorded_id)
{
    r->recorded_id = recorded_id;
    r->run_id = renumber(recorded_id);
    r->status.size = 0; /* the status of the run before is not repeated */
}

static void take_event(sb_replay *r)
{
    const sb_log_event *event = &r->event;
    r->waiting = false;
    if (sb_live_take(r->live, r->kind, event->data, event->size, event->time) == SB_BAD_INPUT) return;
    if (id_of(event->data) != r->recorded_id) follow(r, id_of(event->data));
    if (!r->begun) {
        r->begun = true;
        r->first_time = event->time;
        r->started = sb_clock();
    }
    if (r->kind == SB_CHANNEL_SCENE) {
        keep_piece(r, event->data, event->size); /* published by repeat_pieces */
        return;
    }
    if (r->kind == SB_CHANNEL_STATUS) keep(&r->status, event->data, event->size);
    publish(r, r->kind, event->data, event->size);
}

/* sb_clock() at which the next message is due. */
static double due(sb_replay *r)
{
    if (!r->begun || !(r->speed > 0)) return 0;
    const double now = sb_clock(), time = r->started + (r->event.time - r->first_time) / r->speed;
    const double most = now + fmax(LONGEST_GAP, LONGEST_GAP / r->speed);
    if (time <= most) return time;
    r->started -= time - most;
    return most;
}

static void pause_until(double time)
{
    const double now = sb_clock(), left = fmin(time - now, SERVE_SECONDS);
    if (!(left > 0)) return;
    const struct timespec pause = {(time_t)left, (long)(1e9 * (left - floor(left)))};
    nanosleep(&pause, NULL);
}

sb_status sb_replay_run(sb_replay *r, double seconds)
{
    const double end = sb_clock() + seconds;
    while (!r->ended && sb_clock() < end) {
        repeat(r);
        if (!next_event(r)) {
            r->ended = true;
            break;
        }
        const double time = due(r);
        if (time > sb_clock())
            pause_until(fmin(time, end));
        else
            take_event(r);
    }
    return r->ended ? SB_INTERRUPTED : SB_OK;
}

/* ---- */

/* The prefix of the first valid message of a run in the log. */
static bool find_prefix(sb_log *log, sb_live *live, char prefix[sizeof(sb_channel)])
{
    sb_log_event event;
    while (sb_log_next(log, &event)) {
        const sb_channel_kind kind = sb_channel_guess(event.channel);
        if (kind == SB_CHANNELS || sb_live_take(live, kind, event.data, event.size, event.time) != SB_OK) continue;
        snprintf(prefix, sizeof(sb_channel), "%.*s", (int)(strrchr(event.channel, '_') - event.channel), event.channel);
        return *prefix != '\0';
    }
    return false;
}

/* Reads the first scene, so that subscribers have it from the start, and checks that there is a run. */
static sb_status look_ahead(sb_replay *r, const char *path, sb_error *error)
{
    const sb_live_calls none = {0};
    sb_live *live = sb_live_create(&none);
    if (!live) return sb_fail_memory(error, "a replay");
    bool any = false;
    while (!sb_live_get_scene(live) && next_event(r)) {
        r->waiting = false;
        if (sb_live_take(live, r->kind, r->event.data, r->event.size, r->event.time) != SB_OK) continue;
        if (!any) follow(r, id_of(r->event.data)); /* the scene is published before the first message */
        any = true;
        if (r->kind == SB_CHANNEL_SCENE) keep_piece(r, r->event.data, r->event.size);
    }
    sb_live_destroy(live);
    sb_log_rewind(r->log);
    return any ? SB_OK
               : sb_fail(error, SB_BAD_INPUT, "%.500s: has no valid message on the channels %s, ...", path,
                         r->sender.channels[0]);
}

sb_status sb_replay_create(const char *path, const sb_replay_options *options, sb_replay **replay, sb_error *error)
{
    sb_channel prefix;
    const sb_live_calls none = {0};
    sb_replay *r = sb_alloc(1, sizeof *r);
    if (!r) return sb_fail_memory(error, "a replay");
    r->speed = options->speed;
    r->cycle_begin = -1;
    r->live = sb_live_create(&none);
    sb_status status = r->live ? SB_OK : sb_fail_memory(error, "a replay");
    if (status == SB_OK) status = sb_log_open(path, &r->log, error);
    if (status == SB_OK && !options->prefix && !find_prefix(r->log, r->live, prefix))
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: has no message of a run of this version", path);
    if (status == SB_OK)
        status = sb_sender_open(options->url, options->prefix ? options->prefix : prefix, &r->sender, error);
    if (status == SB_OK) {
        sb_log_rewind(r->log);
        status = look_ahead(r, path, error);
    }
    sb_live_destroy(r->live);
    r->live = status == SB_OK ? sb_live_create(&none) : NULL;
    if (status == SB_OK && !r->live) status = sb_fail_memory(error, "a replay");
    if (status == SB_OK)
        *replay = r;
    else
        sb_replay_destroy(r);
    return status;
}

void sb_replay_destroy(sb_replay *r)
{
    if (!r) return;
    sb_sender_close(&r->sender);
    sb_log_close(r->log);
    sb_live_destroy(r->live);
    forget_pieces(r);
    sb_free(r->status.bytes);
    sb_free(r);
}

const sb_live *sb_replay_view(const sb_replay *r)
{
    return r->live;
}

uint64_t sb_replay_left_out(const sb_replay *r)
{
    return sb_log_left_out(r->log);
}

uint64_t sb_replay_errors(const sb_replay *r)
{
    return sb_sender_count(&r->sender).errors;
}
