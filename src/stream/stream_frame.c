/* Sends the particles of a frame. */
#include "stream/stream_state.h"

#include "base/clock.h"

#include "shorebreak_frame_t.h"

#include <float.h>
#include <math.h>

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

/* Spreads a frame over most of the time until the next one is expected: a receiver that does not run at once, because
   the simulation uses all cores, has time to empty its buffer, which holds four messages. */
static double choose_pace(const sb_stream *stream, double now, double most)
{
    static const double SHARE = 0.8, LONGEST = 0.5, FIRST = 0.1, SLOWEST = 4e6; /* of the interval, s, s, bytes/s */
    const double interval = stream->frame_time >= 0 ? now - stream->frame_time : FIRST;
    const double spread = fmin(SHARE * interval, LONGEST);
    const double pace = fmax((double)(SB_STREAM_POINT * stream->points.count) / fmax(spread, 1e-3), SLOWEST);
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
    for (size_t p = 0; p < points->part_count; p++) {
        const sb_points_part *part = &points->parts[p];
        message.part = (int32_t)p;
        message.first = (int64_t)part->first;
        for (int k = 0; k < 3; k++) message.corner[k] = part->corner[k];
        message.moved_components = 3 * message.moved_count;
        message.count = (int32_t)part->count;
        message.point_bytes = (int32_t)(SB_STREAM_POINT * part->count);
        message.points = points->bytes + SB_STREAM_POINT * part->first;
        sb_sender_send_paced(&stream->sender, SB_CHANNEL_FRAME, stream->buffer,
                             shorebreak_frame_t_encode(stream->buffer, 0, sizeof stream->buffer, &message), pace);
        message.moved_count = 0;
        sb_stream_serve(stream); /* a large frame takes longer than the interval of the status */
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
}
