/* Decodes messages from untrusted bytes. */
#include "stream/decode.h"

#include "shorebreak_forces_t.h"
#include "shorebreak_particles_t.h"
#include "shorebreak_status_t.h"

#include <math.h>
#include <string.h>

/* A position in a message. LCM's own decoders allocate and copy by counts that they do not check, so messages are read
   here, field by field, without access beyond their end. The first problem is kept; reads after it return 0. */
typedef struct reader {
    const unsigned char *at;
    size_t left;
    const char *problem; /* static text, NULL: none */
} reader;

static void refuse(reader *in, const char *problem)
{
    if (!in->problem) in->problem = problem;
}

/* Returns the next `bytes` bytes, or NULL. */
static const unsigned char *take(reader *in, size_t bytes)
{
    if (in->problem || bytes > in->left) {
        refuse(in, "it ends before the last value that its counts require");
        return NULL;
    }
    const unsigned char *at = in->at;
    in->at += bytes;
    in->left -= bytes;
    return at;
}

static uint32_t load32(const unsigned char *at)
{
    uint32_t word;
    memcpy(&word, at, sizeof word);
    return __builtin_bswap32(word);
}

static uint64_t load64(const unsigned char *at)
{
    uint64_t word;
    memcpy(&word, at, sizeof word);
    return __builtin_bswap64(word);
}

static int32_t take_int32(reader *in)
{
    const unsigned char *at = take(in, 4);
    return at ? (int32_t)load32(at) : 0;
}

static int64_t take_int64(reader *in)
{
    const unsigned char *at = take(in, 8);
    return at ? (int64_t)load64(at) : 0;
}

static void take_doubles(reader *in, double *out, size_t count)
{
    const unsigned char *at = take(in, 8 * count);
    for (size_t i = 0; at && i < count; i++) {
        uint64_t word = load64(at + 8 * i);
        memcpy(&out[i], &word, sizeof word);
        if (!isfinite(out[i])) refuse(in, "a number is not finite");
    }
}

static double take_double(reader *in)
{
    double value = 0;
    take_doubles(in, &value, 1);
    return value;
}

static void take_floats(reader *in, float *out, size_t count)
{
    const unsigned char *at = take(in, 4 * count);
    for (size_t i = 0; at && i < count; i++) {
        uint32_t word = load32(at + 4 * i);
        memcpy(&out[i], &word, sizeof word);
        if (!isfinite(out[i])) refuse(in, "a number is not finite");
    }
}

/* Reads an LCM string: the length including the terminating zero, the bytes, the zero. */
static void take_name(reader *in, char name[SB_STREAM_NAME])
{
    int32_t length = take_int32(in);
    if (length < 1 || length > SB_STREAM_NAME) {
        refuse(in, "the length of a name is not 0 to 63 bytes");
        return;
    }
    const unsigned char *at = take(in, (size_t)length);
    if (!at) return;
    if (memchr(at, 0, (size_t)length) != at + length - 1) {
        refuse(in, "a name is not terminated by a zero at its length");
        return;
    }
    /* Names are printed on terminals, so they must not contain escape sequences. */
    for (int32_t i = 0; i < length - 1; i++) name[i] = (char)(at[i] >= 0x20 && at[i] < 0x7f ? at[i] : '?');
    name[length - 1] = 0;
}

static int32_t take_count(reader *in, int32_t most, const char *problem)
{
    int32_t count = take_int32(in);
    if (count < 0 || count > most) {
        refuse(in, problem);
        return 0;
    }
    return count;
}

static reader open_message(const void *buffer, size_t size, int64_t fingerprint)
{
    reader in = {.at = buffer, .left = size};
    if (size > SB_STREAM_MESSAGE_MAX) refuse(&in, "it is larger than 60 kB");
    if (take_int64(&in) != fingerprint) refuse(&in, "its fingerprint belongs to another type or version");
    return in;
}

static sb_status close_message(reader *in, const char *type, size_t size, sb_error *error)
{
    if (in->left > 0) refuse(in, "bytes are left over");
    if (in->problem)
        return sb_fail(error, SB_BAD_INPUT, "%s message of %zu bytes refused: %s", type, size, in->problem);
    return SB_OK;
}

sb_status sb_stream_decode_status(const void *buffer, size_t size, sb_status_message *out, sb_error *error)
{
    reader in = open_message(buffer, size, __shorebreak_status_t_get_hash());
    sb_status_message message = {0};
    take_name(&in, message.run);
    message.step = take_int64(&in);
    message.time = take_double(&in);
    message.duration = take_double(&in);
    message.time_step = take_double(&in);
    message.iterations = take_int32(&in);
    message.density_error = take_double(&in);
    message.max_speed = take_double(&in);
    message.wall_seconds = take_double(&in);
    message.eta_seconds = take_double(&in);
    message.lost_particles = take_int64(&in);
    message.fluid_particles = take_int64(&in);
    message.frame = take_int64(&in);
    if (message.step < 0 || message.iterations < 0 || message.lost_particles < 0 || message.fluid_particles < 0 ||
        message.frame < 0)
        refuse(&in, "a count is negative");
    sb_status status = close_message(&in, "status", size, error);
    if (status == SB_OK) *out = message;
    return status;
}

sb_status sb_stream_decode_forces(const void *buffer, size_t size, sb_forces_message *out, sb_error *error)
{
    reader in = open_message(buffer, size, __shorebreak_forces_t_get_hash());
    sb_forces_message message;
    message.frame = take_int64(&in);
    message.time = take_double(&in);
    message.total = take_count(&in, INT32_MAX, "the number of bodies is negative");
    message.first = take_count(&in, message.total, "the index of its first body is outside of the run's bodies");
    int32_t left = message.total - message.first;
    message.count = take_count(&in, left < SB_STREAM_BODIES ? left : SB_STREAM_BODIES,
                               "it has more bodies than the run or than a message can contain");
    if (take_int32(&in) != 3 * message.count) refuse(&in, "its number of components is not three per body");
    size_t count = in.problem ? 0 : (size_t)message.count;
    for (size_t i = 0; i < count; i++) take_name(&in, message.names[i]);
    const unsigned char *flags = take(&in, count);
    for (size_t i = 0; flags && i < count; i++) message.reported[i] = flags[i] != 0;
    take_doubles(&in, message.force, 3 * count);
    take_doubles(&in, message.moment, 3 * count);
    take_doubles(&in, message.displacement, 3 * count);
    sb_status status = close_message(&in, "forces", size, error);
    if (status == SB_OK) memcpy(out, &message, sizeof message);
    return status;
}

/* Checks that the chunk fits into its frame: the chunks follow each other without gaps, the first begins at 0 and the
   last ends at the total. */
static void check_chunk(reader *in, const sb_particles_message *message)
{
    if (message->frame < 0 || message->decimation < 1 || !(message->spacing > 0))
        refuse(in, "frame is negative, decimation is below 1, or spacing is not above 0");
    if (message->chunk_count < 1 || message->chunk_count > SB_STREAM_CHUNKS_MAX || message->chunk < 0 ||
        message->chunk >= message->chunk_count)
        refuse(in, "its chunk number is outside of the frame's chunks");
    if (message->total < 0 || message->first < 0 || message->first > message->total ||
        message->count > message->total - message->first)
        refuse(in, "its particles are outside of the frame's particles");
    if (in->problem) return;
    bool last = message->chunk == message->chunk_count - 1;
    if ((message->chunk == 0) != (message->first == 0) || last != (message->first + message->count == message->total) ||
        (message->count == 0) != (message->total == 0))
        refuse(in, "its particles do not match its chunk number");
}

sb_status sb_stream_decode_particles(const void *buffer, size_t size, sb_particles_message *out, sb_error *error)
{
    reader in = open_message(buffer, size, __shorebreak_particles_t_get_hash());
    sb_particles_message message;
    message.frame = take_int64(&in);
    message.time = take_double(&in);
    message.chunk = take_int32(&in);
    message.chunk_count = take_int32(&in);
    message.total = take_int64(&in);
    message.first = take_int64(&in);
    message.decimation = take_int32(&in);
    take_doubles(&in, message.origin, 3);
    message.spacing = take_double(&in);
    message.count = take_count(&in, SB_STREAM_CHUNK, "it has more particles than a message can contain");
    if (take_int32(&in) != 3 * message.count) refuse(&in, "its number of components is not three per particle");
    check_chunk(&in, &message);
    size_t count = in.problem ? 0 : (size_t)message.count;
    take_floats(&in, message.position, 3 * count);
    take_floats(&in, message.velocity, 3 * count);
    take_floats(&in, message.pressure, count);
    sb_status status = close_message(&in, "particles", size, error);
    if (status == SB_OK) memcpy(out, &message, sizeof message);
    return status;
}
