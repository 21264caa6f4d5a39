/* Decodes messages from untrusted bytes. */
#include "stream/decode.h"

#include "stream/reader.h"

#include "shorebreak_forces_t.h"
#include "shorebreak_frame_t.h"
#include "shorebreak_gauges_t.h"
#include "shorebreak_parity_t.h"
#include "shorebreak_reply_t.h"
#include "shorebreak_scene_piece_t.h"
#include "shorebreak_status_t.h"

#include <string.h>

const char *sb_run_state_name(sb_run_state state)
{
    static const char *const names[SB_RUN_STATES] = {"running", "paused", "done"};
    return (unsigned)state < SB_RUN_STATES ? names[state] : "unknown";
}

static void take_progress(sb_message_reader *in, sb_status_message *message)
{
    sb_reader_name(in, message->run);
    const int8_t state = sb_reader_int8(in);
    if (state < 0 || state >= SB_RUN_STATES) sb_reader_refuse(in, "its state is not 0, 1 or 2");
    message->state = (sb_run_state)state;
    message->step = sb_reader_int64(in);
    message->time = sb_reader_double(in);
    message->duration = sb_reader_double(in);
    message->time_step = sb_reader_double(in);
    message->iterations = sb_reader_int32(in);
    message->capped_steps = sb_reader_int64(in);
    message->density_error = sb_reader_double(in);
    message->density_error_max = sb_reader_double(in);
    message->tolerance = sb_reader_double(in);
    message->max_speed = sb_reader_double(in);
    message->wall_seconds = sb_reader_double(in);
    message->eta_seconds = sb_reader_double(in);
    message->lost_particles = sb_reader_int64(in);
    message->fluid_particles = sb_reader_int64(in);
    message->frame = sb_reader_int64(in);
}

static void take_publisher(sb_message_reader *in, sb_status_message *message)
{
    message->messages = sb_reader_int64(in);
    message->bytes = sb_reader_int64(in);
    message->errors = sb_reader_int64(in);
    message->frames_skipped = sb_reader_int64(in);
    message->rate = sb_reader_double(in);
    message->decimation = sb_reader_int32(in);
    sb_reader_doubles(in, message->region_min, 3);
    sb_reader_doubles(in, message->region_max, 3);
    message->stage_count = sb_reader_count(in, SB_STREAM_STAGES, "it has more than 32 stages");
    for (int32_t i = 0; i < message->stage_count; i++) sb_reader_name(in, message->stages[i]);
    sb_reader_doubles(in, message->stage_seconds, (size_t)message->stage_count);
}

sb_status sb_stream_decode_status(const void *buffer, size_t size, sb_status_message *out, sb_error *error)
{
    sb_message_reader in = sb_reader_begin(buffer, size, SB_STREAM_MESSAGE_MAX, __shorebreak_status_t_get_hash());
    sb_status_message message = {.head = sb_reader_head(&in)};
    take_progress(&in, &message);
    take_publisher(&in, &message);
    const int64_t counts[] = {
        message.step,  message.iterations, message.capped_steps, message.lost_particles, message.fluid_particles,
        message.frame, message.messages,   message.bytes,        message.errors,         message.frames_skipped};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        if (counts[i] < 0) sb_reader_refuse(&in, "a count is negative");
    if (message.decimation < 1 || message.rate < 0) sb_reader_refuse(&in, "decimation is below 1, or rate negative");
    const sb_status status = sb_reader_end(&in, "status", size, error);
    if (status == SB_OK) *out = message;
    return status;
}

/* Reads total, first and count of a message with rows. */
static void take_rows(sb_message_reader *in, int32_t *total, int32_t *first, int32_t *count)
{
    *total = sb_reader_count(in, INT32_MAX, "its number of rows is negative");
    *first = sb_reader_count(in, *total, "the index of its first row is outside of all rows");
    const int32_t left = *total - *first;
    *count = sb_reader_count(in, left < SB_STREAM_ROWS ? left : SB_STREAM_ROWS,
                             "it has more rows than there are or than a message can contain");
}

sb_status sb_stream_decode_forces(const void *buffer, size_t size, sb_forces_message *out, sb_error *error)
{
    sb_message_reader in = sb_reader_begin(buffer, size, SB_STREAM_MESSAGE_MAX, __shorebreak_forces_t_get_hash());
    sb_forces_message message;
    message.head = sb_reader_head(&in);
    message.time = sb_reader_double(&in);
    take_rows(&in, &message.total, &message.first, &message.count);
    sb_reader_same(&in, 3 * message.count, "its number of components is not three per row");
    const size_t count = in.problem ? 0 : (size_t)message.count;
    for (size_t i = 0; i < count; i++) sb_reader_name(&in, message.names[i]);
    sb_reader_int32s(&in, message.body, count);
    for (size_t i = 0; i < count && !in.problem; i++)
        if (message.body[i] < 0) sb_reader_refuse(&in, "the index of a body is negative");
    sb_reader_doubles(&in, message.force, 3 * count);
    sb_reader_doubles(&in, message.moment, 3 * count);
    sb_reader_doubles(&in, message.pressure, 3 * count);
    sb_reader_doubles(&in, message.friction, 3 * count);
    const sb_status status = sb_reader_end(&in, "forces", size, error);
    if (status == SB_OK) memcpy(out, &message, sizeof message);
    return status;
}

sb_status sb_stream_decode_gauges(const void *buffer, size_t size, sb_gauges_message *out, sb_error *error)
{
    sb_message_reader in = sb_reader_begin(buffer, size, SB_STREAM_MESSAGE_MAX, __shorebreak_gauges_t_get_hash());
    sb_gauges_message message;
    message.head = sb_reader_head(&in);
    message.time = sb_reader_double(&in);
    take_rows(&in, &message.total, &message.first, &message.count);
    const size_t count = in.problem ? 0 : (size_t)message.count;
    for (size_t i = 0; i < count; i++) sb_reader_name(&in, message.names[i]);
    const unsigned char *wet = sb_reader_bytes(&in, count);
    for (size_t i = 0; wet && i < count; i++) message.wet[i] = wet[i] != 0;
    sb_reader_doubles(&in, message.eta, count);
    sb_reader_doubles(&in, message.z, count);
    const sb_status status = sb_reader_end(&in, "gauges", size, error);
    if (status == SB_OK) memcpy(out, &message, sizeof message);
    return status;
}

/* Checks that the part fits into its frame: the parts follow each other without gaps, the first begins at 0 and the
   last ends at the total. */
static void check_part(sb_message_reader *in, const sb_frame_message *m)
{
    if (m->part_count < 1 || m->part_count > SB_STREAM_PARTS_MAX || m->part < 0 || m->part >= m->part_count)
        sb_reader_refuse(in, "its part number is outside of the frame's parts");
    if (m->total < 0 || m->total > SB_STREAM_TOTAL_MAX || m->total > (int64_t)m->part_count * SB_STREAM_POINTS ||
        m->first < 0 || m->first > m->total || m->count > m->total - m->first)
        sb_reader_refuse(in, "its particles are outside of the frame's particles");
    if (in->problem) return;
    const bool last = m->part == m->part_count - 1;
    if ((m->part == 0) != (m->first == 0) || last != (m->first + m->count == m->total) ||
        (m->count == 0) != (m->total == 0))
        sb_reader_refuse(in, "its particles do not match its part number");
}

static void take_moved(sb_message_reader *in, sb_frame_message *m)
{
    m->moved_count = sb_reader_count(in, SB_STREAM_MOVED, "it has more than 100 displaced bodies");
    sb_reader_same(in, 3 * m->moved_count, "its number of components is not three per displaced body");
    const size_t count = in->problem ? 0 : (size_t)m->moved_count;
    sb_reader_int32s(in, m->moved, count);
    for (size_t i = 0; i < count && !in->problem; i++)
        if (m->moved[i] < 0) sb_reader_refuse(in, "the index of a body is negative");
    sb_reader_doubles(in, m->displacement, 3 * count);
}

sb_status sb_stream_decode_frame(const void *buffer, size_t size, sb_frame_message *out, sb_error *error)
{
    sb_message_reader in = sb_reader_begin(buffer, size, SB_STREAM_MESSAGE_MAX, __shorebreak_frame_t_get_hash());
    sb_frame_message m;
    m.head = sb_reader_head(&in);
    m.frame = sb_reader_int64(&in);
    m.step = sb_reader_int64(&in);
    m.time = sb_reader_double(&in);
    m.part = sb_reader_int32(&in);
    m.part_count = sb_reader_int32(&in);
    m.total = sb_reader_int64(&in);
    m.first = sb_reader_int64(&in);
    m.decimation = sb_reader_int32(&in);
    m.spacing = sb_reader_double(&in);
    m.quantum = sb_reader_double(&in);
    sb_reader_doubles(&in, m.corner, 3);
    m.speed_max = sb_reader_double(&in);
    m.pressure_max = sb_reader_double(&in);
    if (m.frame < 1 || m.step < 0 || m.decimation < 1 || !(m.spacing > 0) || !(m.quantum > 0) || !(m.speed_max >= 0) ||
        !(m.pressure_max >= 0))
        sb_reader_refuse(&in, "frame, step, decimation, spacing, quantum or a largest value is below its range");
    take_moved(&in, &m);
    m.count = sb_reader_count(&in, SB_STREAM_POINTS, "it has more particles than a message can contain");
    sb_reader_same(&in, SB_STREAM_POINT * m.count, "its number of bytes is not eight per particle");
    check_part(&in, &m);
    m.points = sb_reader_bytes(&in, in.problem ? 0 : SB_STREAM_POINT * (size_t)m.count);
    const sb_status status = sb_reader_end(&in, "frame", size, error);
    if (status == SB_OK) memcpy(out, &m, sizeof m);
    return status;
}

sb_status sb_stream_decode_parity(const void *buffer, size_t size, sb_parity_message *out, sb_error *error)
{
    sb_message_reader in = sb_reader_begin(buffer, size, SB_STREAM_MESSAGE_MAX, __shorebreak_parity_t_get_hash());
    sb_parity_message m = {.head = sb_reader_head(&in)};
    m.frame = sb_reader_int64(&in);
    m.part_count = sb_reader_int32(&in);
    m.group = sb_reader_int32(&in);
    m.group_count = sb_reader_int32(&in);
    m.count = sb_reader_count(&in, SB_STREAM_POINT * SB_STREAM_POINTS, "it has more bytes than a part can contain");
    if (m.frame < 1 || m.part_count < 1 || m.part_count > SB_STREAM_PARTS_MAX || m.group_count < 1 ||
        m.group_count > m.part_count || m.group < 0 || m.group >= m.group_count || m.count < 1 ||
        m.count % SB_STREAM_POINT != 0)
        sb_reader_refuse(&in, "its frame, group or number of bytes is outside of its range");
    m.data = sb_reader_bytes(&in, in.problem ? 0 : (size_t)m.count);
    const sb_status status = sb_reader_end(&in, "parity", size, error);
    if (status == SB_OK) *out = m;
    return status;
}

sb_status sb_stream_decode_reply(const void *buffer, size_t size, sb_reply_message *out, sb_error *error)
{
    sb_message_reader in = sb_reader_begin(buffer, size, SB_STREAM_MESSAGE_MAX, __shorebreak_reply_t_get_hash());
    sb_reply_message m = {.head = sb_reader_head(&in)};
    m.id = sb_reader_int64(&in);
    m.counter = sb_reader_int64(&in);
    const int8_t result = sb_reader_int8(&in);
    m.step = sb_reader_int64(&in);
    m.time = sb_reader_double(&in);
    sb_reader_text(&in, m.text, sizeof m.text);
    if (m.id < 0 || m.counter < 0 || m.step < 0 || (result != 0 && result != 1))
        sb_reader_refuse(&in, "its id, counter, step or result is outside of its range");
    m.refused = result != 0;
    const sb_status status = sb_reader_end(&in, "reply", size, error);
    if (status == SB_OK) *out = m;
    return status;
}

sb_status sb_stream_decode_piece(const void *buffer, size_t size, sb_scene_piece_message *out, sb_error *error)
{
    sb_message_reader in = sb_reader_begin(buffer, size, SB_STREAM_MESSAGE_MAX, __shorebreak_scene_piece_t_get_hash());
    sb_scene_piece_message m = {.head = sb_reader_head(&in)};
    m.scene_id = sb_reader_int64(&in);
    m.total = sb_reader_int64(&in);
    m.piece = sb_reader_int32(&in);
    m.piece_count = sb_reader_int32(&in);
    m.offset = sb_reader_int64(&in);
    m.count = sb_reader_count(&in, SB_STREAM_PIECE, "it has more bytes than a piece can contain");
    if (m.total < 1 || m.total > SB_STREAM_SCENE_MAX) {
        sb_reader_refuse(&in, "the size of its scene is outside of its range");
        m.total = 1;
    }
    /* All pieces but the last are full, so that each count follows from the total. */
    const int64_t pieces = (m.total + SB_STREAM_PIECE - 1) / SB_STREAM_PIECE;
    if (m.piece_count != pieces || m.piece < 0 || m.piece >= m.piece_count ||
        m.offset != (int64_t)m.piece * SB_STREAM_PIECE ||
        m.count != (m.piece == m.piece_count - 1 ? m.total - m.offset : SB_STREAM_PIECE))
        sb_reader_refuse(&in, "its bytes do not match its piece number");
    m.data = sb_reader_bytes(&in, in.problem ? 0 : (size_t)m.count);
    const sb_status status = sb_reader_end(&in, "scene", size, error);
    if (status == SB_OK) *out = m;
    return status;
}
