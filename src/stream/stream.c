/* Encodes and publishes status, forces and particles. */
#include "stream/stream.h"

#include "base/hash.h"
#include "base/memory.h"
#include "stream/decode.h"
#include "stream/provider.h"

#include "shorebreak_forces_t.h"
#include "shorebreak_particles_t.h"
#include "shorebreak_status_t.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { CHUNK_PAUSE_NS = 100000, STATUS_BYTES = 512 };

struct sb_stream {
    sb_stream *previous_abandoned;
    lcm_t *lcm;
    sb_channel channels[SB_CHANNELS];
    char run[SB_STREAM_NAME];
    double interval;
    uint64_t decimation;
    int64_t last_interval; /* number of the interval whose particles were sent last; -1: none yet */
    _Atomic int64_t frame, fluid_particles;
    _Atomic uint64_t messages, bytes, errors;
    /* Buffers of the stream's thread. */
    unsigned char buffer[SB_STREAM_MESSAGE_MAX];
    float position[3 * SB_STREAM_CHUNK], velocity[3 * SB_STREAM_CHUNK], pressure[SB_STREAM_CHUNK];
    char *names[SB_STREAM_BODIES];
    int8_t reported[SB_STREAM_BODIES];
    double force[3 * SB_STREAM_BODIES], moment[3 * SB_STREAM_BODIES];
    double displacement[3 * SB_STREAM_BODIES];
};

lcm_t *sb_stream_provider(sb_stream *stream)
{
    return stream->lcm;
}

sb_status sb_stream_create(const sb_stream_settings *settings, const char *run_name, sb_stream **stream,
                           sb_error *error)
{
    sb_stream *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the stream");
    made->interval = settings->interval;
    made->decimation = settings->decimation > 1 ? (uint64_t)settings->decimation : 1;
    made->last_interval = -1;
    snprintf(made->run, sizeof made->run, "%s", run_name ? run_name : "");
    sb_status status = sb_provider_channels(settings->prefix, made->channels, error);
    if (status == SB_OK) status = sb_provider_open(settings->url, &made->lcm, error);
    if (status != SB_OK) {
        sb_stream_destroy(made);
        return status;
    }
    *stream = made;
    return SB_OK;
}

void sb_stream_destroy(sb_stream *stream)
{
    if (stream && stream->lcm) lcm_destroy(stream->lcm);
    sb_free(stream);
}

void sb_stream_abandon(sb_stream *stream)
{
    static _Atomic(sb_stream *) last;
    stream->previous_abandoned = atomic_exchange(&last, stream);
}

sb_stream_counters sb_stream_count(const sb_stream *stream)
{
    return (sb_stream_counters){.messages = stream->messages, .bytes = stream->bytes, .errors = stream->errors};
}

/* Sends an encoded message of `size` bytes; a negative size means that the encoder failed. */
static void send_message(sb_stream *stream, int channel, const void *buffer, int size)
{
    /* A provider over TCP raises SIGPIPE when its peer has closed the connection. This must not end the run. */
    sigset_t pipe_signal, before;
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_signal, &before);
    /* A peer that has stopped reading blocks the call without a limit, so the thread may be cancelled here, and only
       here. */
    int state;
    pthread_setcancelstate(PTHREAD_CANCEL_ENABLE, &state);
    bool sent = size > 0 && lcm_publish(stream->lcm, stream->channels[channel], buffer, (unsigned)size) == 0;
    pthread_setcancelstate(state, NULL);
    if (!sent && !sigismember(&before, SIGPIPE)) sigtimedwait(&pipe_signal, NULL, &(struct timespec){0});
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (sent) {
        stream->messages++;
        stream->bytes += (uint64_t)size;
    } else {
        stream->errors++;
    }
}

void sb_stream_status(sb_stream *stream, const sb_frame_status *status)
{
    unsigned char buffer[STATUS_BYTES];
    shorebreak_status_t message = {
        .run = stream->run,
        .step = (int64_t)status->step,
        .time = status->time,
        .duration = status->duration,
        .time_step = status->time_step,
        .iterations = status->iterations,
        .density_error = status->density_error,
        .max_speed = status->max_speed,
        .wall_seconds = status->wall_seconds,
        .eta_seconds = isfinite(status->eta_seconds) ? status->eta_seconds : -1,
        .lost_particles = (int64_t)status->lost_particles,
        .fluid_particles = stream->fluid_particles,
        .frame = stream->frame,
    };
    send_message(stream, SB_CHANNEL_STATUS, buffer, shorebreak_status_t_encode(buffer, 0, sizeof buffer, &message));
}

static void store(double out[3], sb_vec3 vector)
{
    out[0] = vector.x;
    out[1] = vector.y;
    out[2] = vector.z;
}

static void publish_forces(sb_stream *stream, const sb_frame *frame)
{
    size_t first = 0;
    do {
        size_t left = frame->body_count - first;
        size_t count = left < SB_STREAM_BODIES ? left : SB_STREAM_BODIES;
        for (size_t i = 0; i < count; i++) {
            sb_frame_body *body = &frame->bodies[first + i];
            stream->names[i] = body->name;
            stream->reported[i] = body->report ? 1 : 0;
            store(&stream->force[3 * i], body->force);
            store(&stream->moment[3 * i], body->moment);
            store(&stream->displacement[3 * i], body->displacement);
        }
        shorebreak_forces_t message = {
            .frame = (int64_t)frame->index,
            .time = frame->status.time,
            .total = (int32_t)frame->body_count,
            .first = (int32_t)first,
            .n = (int32_t)count,
            .components = (int32_t)(3 * count),
            .names = stream->names,
            .reported = stream->reported,
            .force = stream->force,
            .moment = stream->moment,
            .displacement = stream->displacement,
        };
        send_message(stream, SB_CHANNEL_FORCES, stream->buffer,
                     shorebreak_forces_t_encode(stream->buffer, 0, sizeof stream->buffer, &message));
        first += count;
    } while (first < frame->body_count);
}

/* Selects one particle in `decimation` by a hash of its id: the same particles in every frame, and, unlike every n-th
   particle of a lattice, without preference for a lattice plane. */
static bool streamed(const sb_stream *stream, const sb_frame *frame, size_t particle)
{
    return stream->decimation == 1 || sb_hash_mix(frame->id[particle]) % stream->decimation == 0;
}

static void send_chunk(sb_stream *stream, shorebreak_particles_t *message, int32_t count)
{
    message->count = count;
    message->components = 3 * count;
    int size = shorebreak_particles_t_encode(stream->buffer, 0, sizeof stream->buffer, message);
    if (message->chunk > 0) nanosleep(&(struct timespec){.tv_nsec = CHUNK_PAUSE_NS}, NULL);
    send_message(stream, SB_CHANNEL_PARTICLES, stream->buffer, size);
    message->chunk++;
    message->first += count;
}

static void publish_particles(sb_stream *stream, const sb_frame *frame)
{
    int64_t total = 0;
    for (size_t i = 0; i < frame->count; i++) total += streamed(stream, frame, i);
    int64_t chunks = total > 0 ? (total + SB_STREAM_CHUNK - 1) / SB_STREAM_CHUNK : 1;
    shorebreak_particles_t message = {
        .frame = (int64_t)frame->index,
        .time = frame->status.time,
        .chunk_count = (int32_t)chunks,
        .total = total,
        .decimation = (int32_t)stream->decimation,
        .spacing = frame->spacing,
        .position = stream->position,
        .velocity = stream->velocity,
        .pressure = stream->pressure,
    };
    store(message.origin, frame->origin);
    size_t filled = 0;
    for (size_t i = 0; i < frame->count; i++) {
        if (!streamed(stream, frame, i)) continue;
        memcpy(&stream->position[3 * filled], &frame->position[3 * i], 3 * sizeof(float));
        memcpy(&stream->velocity[3 * filled], &frame->velocity[3 * i], 3 * sizeof(float));
        stream->pressure[filled++] = frame->pressure[i];
        if (filled == SB_STREAM_CHUNK) {
            send_chunk(stream, &message, (int32_t)filled);
            filled = 0;
        }
    }
    if (filled > 0 || total == 0) send_chunk(stream, &message, (int32_t)filled);
}

/* Returns whether a new interval has begun since particles were last sent. Frames may come at any interval. */
static bool particles_due(sb_stream *stream, double time)
{
    if (!(stream->interval > 0)) return true;
    /* Rounding may put the time of a frame slightly before the multiple of the interval that it belongs to. */
    double number = floor(time / stream->interval + 1e-6);
    if (!(number > (double)stream->last_interval) || number > 0x1p62) return false;
    stream->last_interval = (int64_t)number;
    return true;
}

void sb_stream_publish(sb_stream *stream, const sb_frame *frame)
{
    stream->frame = (int64_t)frame->index;
    stream->fluid_particles = (int64_t)frame->count;
    sb_stream_status(stream, &frame->status);
    publish_forces(stream, frame);
    if (particles_due(stream, frame->status.time)) publish_particles(stream, frame);
}
