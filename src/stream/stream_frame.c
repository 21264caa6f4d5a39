/* Sends the particles of a frame. */
#include "stream/stream_state.h"

#include "base/clock.h"

#include "shorebreak_frame_t.h"
#include "shorebreak_parity_t.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Returns whether a new interval has begun since particles were last sent. Frames may come at any interval. */
static bool is_new_interval(sb_stream *stream, double time)
{
    if (!(stream->interval > 0)) return true;
    /* Rounding may put the time of a frame slightly before the multiple of the interval that it belongs to. */
    const double number = floor(time / stream->interval + 1e-6);
    if (!(number > (double)stream->last_interval) || number > 0x1p62) return false;
    stream->last_interval = (int64_t)number;
    return true;
}

/* Lists the bodies that are not at their place at t = 0. */
static int32_t find_moved(const sb_frame *frame, int32_t moved[SB_STREAM_MOVED], double *displacement)
{
    int32_t count = 0;
    for (size_t b = 0; b < frame->body_count && count < SB_STREAM_MOVED; b++) {
        const sb_vec3 d = frame->bodies[b].displacement;
        if (!(fabs(d.x) + fabs(d.y) + fabs(d.z) > 0)) continue;
        moved[count] = (int32_t)b;
        sb_stream_store(&displacement[3 * count++], d);
    }
    return count;
}

/* Spreads a frame over most of the time until the next one: a receiver that does not run at once, because the
   simulation uses all cores, has time to empty its buffer, which holds two messages. The time follows from the pause
   before this frame: it grows while the pauses are longer than a tenth of the interval, and shrinks when frames have to
   wait. */
static double choose_pace(sb_stream *stream, double now, double most)
{
    static const double PAUSE = 0.1, GAIN = 0.5, WAITED = 2e-3, SHRINK = 0.7; /* of the interval, -, s, - */
    static const double SHORTEST = 1e-3, LONGEST = 0.5, SLOWEST = 4e6;        /* s, s, bytes/s */
    if (stream->frame_time >= 0) {
        const double pause = now - stream->frame_end, interval = now - stream->frame_time;
        stream->spread = pause < WAITED ? SHRINK * stream->spread : stream->spread + GAIN * (pause - PAUSE * interval);
    }
    stream->spread = fmin(fmax(stream->spread, SHORTEST), LONGEST);
    const double pace = fmax((double)(SB_STREAM_POINT * stream->points.count) / stream->spread, SLOWEST);
    return most > 0 ? fmin(pace, most) : pace;
}

static void send_parts(sb_stream *stream, const sb_frame *frame, const sb_stream_limits *limits, double pace)
{
    int32_t moved[SB_STREAM_MOVED];
    double displacement[3 * SB_STREAM_MOVED];
    const sb_points *points = &stream->points;
    shorebreak_frame_t message = {
        .version = SB_STREAM_VERSION,
        .run_id = stream->run_id,
        .frame = (int64_t)frame->index,
        .step = (int64_t)frame->status.step,
        .time = frame->status.time,
        .part_count = (int32_t)points->part_count,
        .total = (int64_t)points->count,
        .decimation = limits->decimation,
        .spacing = frame->spacing,
        .quantum = points->quantum,
        .speed_max = (double)points->speed_max,
        .pressure_max = (double)points->pressure_max,
        .moved = moved,
        .displacement = displacement,
    };
    message.moved_count = find_moved(frame, moved, displacement);
    message.moved_components = 3 * message.moved_count;
    for (size_t p = 0; p < points->part_count; p++) {
        const sb_points_part *part = &points->parts[p];
        message.part = (int32_t)p;
        message.first = (int64_t)part->first;
        for (int k = 0; k < 3; k++) message.corner[k] = part->corner[k];
        message.count = (int32_t)part->count;
        message.point_bytes = (int32_t)(SB_STREAM_POINT * part->count);
        message.points = points->bytes + SB_STREAM_POINT * part->first;
        sb_sender_send_paced(&stream->sender, SB_CHANNEL_FRAME, stream->buffer,
                             shorebreak_frame_t_encode(stream->buffer, 0, sizeof stream->buffer, &message), pace);
        sb_stream_serve(stream); /* a large frame takes longer than the interval of the status */
    }
}

/* Parts per group of parity, and parts of a frame that has parity: small frames lose nothing at their pace. */
enum { GROUP = 12, PARTS_LEAST = 8 };

/* Whether all parts have one corner and all but the last one are full. */
static bool is_regular(const sb_points *points)
{
    for (size_t p = 0; p < points->part_count; p++)
        if (memcmp(points->parts[p].corner, points->parts[0].corner, sizeof points->parts[p].corner) != 0 ||
            points->parts[p].first != p * SB_STREAM_POINTS)
            return false;
    return true;
}

/* Sends the parity of the parts: a frame stays complete when one part of each group is lost. */
static void send_parity(sb_stream *stream, const sb_frame *frame, double pace)
{
    const sb_points *points = &stream->points;
    const size_t parts = points->part_count, groups = (parts + GROUP - 1) / GROUP;
    if (parts < PARTS_LEAST || !is_regular(points)) return;
    for (size_t group = 0; group < groups; group++) {
        memset(stream->parity, 0, sizeof stream->parity);
        for (size_t p = group; p < parts; p += groups) {
            const unsigned char *from = points->bytes + SB_STREAM_POINT * points->parts[p].first;
            for (size_t i = 0; i < SB_STREAM_POINT * points->parts[p].count; i++) stream->parity[i] ^= from[i];
        }
        const shorebreak_parity_t message = {.version = SB_STREAM_VERSION,
                                             .run_id = stream->run_id,
                                             .frame = (int64_t)frame->index,
                                             .part_count = (int32_t)parts,
                                             .group = (int32_t)group,
                                             .group_count = (int32_t)groups,
                                             .count = sizeof stream->parity,
                                             .data = stream->parity};
        sb_sender_send_paced(&stream->sender, SB_CHANNEL_PARITY, stream->buffer,
                             shorebreak_parity_t_encode(stream->buffer, 0, sizeof stream->buffer, &message), pace);
    }
}

void sb_stream_send_frame(sb_stream *stream, const sb_frame *frame)
{
    if (!is_new_interval(stream, frame->status.time)) return;
    const sb_stream_limits limits = sb_stream_get_limits(stream);
    const double now = sb_clock();
    if (limits.rate > 0 && stream->frame_time >= 0 && now < stream->frame_time + 1 / limits.rate) {
        stream->skipped++;
        return;
    }
    const sb_vec3 all = sb_vec(DBL_MAX, DBL_MAX, DBL_MAX);
    const sb_points_choice choice = {.decimation = (uint64_t)limits.decimation,
                                     .min = limits.region ? limits.min : sb_scale(all, -1),
                                     .max = limits.region ? limits.max : all};
    if (sb_points_encode(&stream->points, frame, &choice, NULL) != SB_OK) {
        stream->skipped++;
        return;
    }
    stream->frame = (int64_t)frame->index;
    const double pace = choose_pace(stream, now, limits.bytes_per_second);
    stream->frame_time = now;
    send_parts(stream, frame, &limits, pace);
    send_parity(stream, frame, pace);
    stream->frame_end = sb_clock();
}
