#include "stream/reader.h"

#include <math.h>
#include <string.h>

void sb_reader_refuse(sb_message_reader *in, const char *problem)
{
    if (!in->problem) in->problem = problem;
}

const unsigned char *sb_reader_bytes(sb_message_reader *in, size_t bytes)
{
    if (in->problem || bytes > in->left) {
        sb_reader_refuse(in, "it ends before the last value that its counts require");
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

int8_t sb_reader_int8(sb_message_reader *in)
{
    const unsigned char *at = sb_reader_bytes(in, 1);
    return at ? (int8_t)*at : 0;
}

int32_t sb_reader_int32(sb_message_reader *in)
{
    const unsigned char *at = sb_reader_bytes(in, 4);
    return at ? (int32_t)load32(at) : 0;
}

int64_t sb_reader_int64(sb_message_reader *in)
{
    const unsigned char *at = sb_reader_bytes(in, 8);
    return at ? (int64_t)load64(at) : 0;
}

void sb_reader_doubles(sb_message_reader *in, double *out, size_t count)
{
    const unsigned char *at = sb_reader_bytes(in, 8 * count);
    for (size_t i = 0; at && i < count; i++) {
        const uint64_t word = load64(at + 8 * i);
        memcpy(&out[i], &word, sizeof word);
        if (!isfinite(out[i])) sb_reader_refuse(in, "a number is not finite");
    }
}

double sb_reader_double(sb_message_reader *in)
{
    double value = 0;
    sb_reader_doubles(in, &value, 1);
    return value;
}

void sb_reader_floats(sb_message_reader *in, float *out, size_t count)
{
    const unsigned char *at = sb_reader_bytes(in, 4 * count);
    for (size_t i = 0; at && i < count; i++) {
        const uint32_t word = load32(at + 4 * i);
        memcpy(&out[i], &word, sizeof word);
        if (!isfinite(out[i])) sb_reader_refuse(in, "a number is not finite");
    }
}

void sb_reader_int32s(sb_message_reader *in, int32_t *out, size_t count)
{
    const unsigned char *at = sb_reader_bytes(in, 4 * count);
    for (size_t i = 0; at && i < count; i++) out[i] = (int32_t)load32(at + 4 * i);
}

void sb_reader_name(sb_message_reader *in, char name[SB_STREAM_NAME])
{
    sb_reader_text(in, name, SB_STREAM_NAME);
}

void sb_reader_text(sb_message_reader *in, char *name, size_t size)
{
    const int32_t length = sb_reader_int32(in); /* with the terminating zero */
    if (length < 1 || (size_t)length > size) {
        sb_reader_refuse(in, size == SB_STREAM_NAME ? "the length of a name is not 0 to 63 bytes"
                                                    : "the length of a text is not 0 to 255 bytes");
        return;
    }
    const unsigned char *at = sb_reader_bytes(in, (size_t)length);
    if (!at) return;
    if (memchr(at, 0, (size_t)length) != at + length - 1) {
        sb_reader_refuse(in, "a name is not terminated by a zero at its length");
        return;
    }
    for (int32_t i = 0; i < length - 1; i++) name[i] = (char)(at[i] >= 0x20 && at[i] < 0x7f ? at[i] : '?');
    name[length - 1] = 0;
}

int32_t sb_reader_count(sb_message_reader *in, int32_t most, const char *problem)
{
    const int32_t count = sb_reader_int32(in);
    if (count >= 0 && count <= most) return count;
    sb_reader_refuse(in, problem);
    return 0;
}

void sb_reader_same(sb_message_reader *in, int64_t expected, const char *problem)
{
    if (sb_reader_int32(in) != expected) sb_reader_refuse(in, problem);
}

sb_message_head sb_reader_head(sb_message_reader *in)
{
    sb_message_head head = {.run_id = sb_reader_int64(in)};
    head.sequence = sb_reader_int64(in);
    if (head.run_id < 0 || head.run_id > SB_STREAM_RUN_MAX || head.sequence < 0)
        sb_reader_refuse(in, "its run id is not 0 to 2^53 - 1, or its sequence number is negative");
    return head;
}

sb_message_reader sb_reader_begin(const void *buffer, size_t size, size_t most, int64_t fingerprint)
{
    sb_message_reader in = {.at = buffer, .left = size};
    if (size > most) sb_reader_refuse(&in, "it is larger than a message of its type can be");
    if (sb_reader_int64(&in) != fingerprint)
        sb_reader_refuse(&in, "its fingerprint belongs to another type or version");
    sb_reader_same(&in, SB_STREAM_VERSION, "its version is not 2");
    return in;
}

sb_status sb_reader_end(sb_message_reader *in, const char *type, size_t size, sb_error *error)
{
    if (in->left > 0) sb_reader_refuse(in, "bytes are left over");
    if (!in->problem) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%s message of %zu bytes refused: %s", type, size, in->problem);
}
