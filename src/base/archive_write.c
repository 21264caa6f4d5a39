/* Writes archives to memory or to a file. */
#include "base/archive.h"

#include "base/archive_layout.h"
#include "base/hash.h"
#include "base/memory.h"

#include <errno.h>
#include <string.h>

/* ---- output to a file or to memory ---- */

/* Returns 0, or errno. */
static int put_bytes(sb_archive_out *out, const void *bytes, size_t length)
{
    if (out->file.stream) return fwrite(bytes, 1, length, out->file.stream) == length ? 0 : errno;
    if (length > SIZE_MAX - out->used || sb_grow((void **)&out->bytes, &out->capacity, out->used + length, 1) != 0)
        return ENOMEM;
    memcpy(out->bytes + out->used, bytes, length);
    return 0;
}

static void emit(sb_archive_out *out, const void *bytes, size_t length)
{
    if (!out->reason) out->reason = put_bytes(out, bytes, length);
    if (!out->reason) out->used += length;
}

/* Overwrites bytes that were emitted before. */
static void overwrite(sb_archive_out *out, size_t at, const void *bytes, size_t length)
{
    FILE *stream = out->file.stream;
    if (out->reason) return;
    if (!stream)
        memcpy(out->bytes + at, bytes, length);
    else if (fseeko(stream, (off_t)at, SEEK_SET) != 0 || fwrite(bytes, 1, length, stream) != length ||
             fseeko(stream, (off_t)out->used, SEEK_SET) != 0)
        out->reason = errno;
}

/* ---- blocks and sections ---- */

static void add_sum(sb_archive_out *out, uint64_t block)
{
    out->sum = sb_hash(out->sum, &block, sizeof block);
}

static void flush_block(sb_archive_out *out)
{
    if (out->pending == 0) return;
    add_sum(out, sb_hash(0, out->block, out->pending));
    emit(out, out->block, out->pending);
    out->pending = 0;
}

static void append(sb_archive_out *out, const void *bytes, size_t length)
{
    const unsigned char *from = bytes;
    while (length > 0) {
        const size_t room = sizeof out->block - out->pending, part = length < room ? length : room;
        memcpy(out->block + out->pending, from, part);
        out->pending += part;
        from += part;
        length -= part;
        if (part == room) flush_block(out);
    }
}

static void append_word(sb_archive_out *out, uint64_t word)
{
    append(out, &word, sizeof word);
}

/* Writes the length and the checksum, which are known only at the section's end, into the open section's head. */
static void close_section(sb_archive_out *out)
{
    flush_block(out);
    if (out->section == 0) return;
    uint64_t words[2] = {out->used - out->section - SB_SECTION_HEAD};
    words[1] = sb_hash(out->sum, &words[0], sizeof words[0]);
    overwrite(out, out->section + SB_ARCHIVE_NAME, words, sizeof words);
    out->section = 0;
}

void sb_archive_section(sb_archive_out *out, const char *name)
{
    unsigned char head[SB_SECTION_HEAD] = {0};
    close_section(out);
    memcpy(head, name, strnlen(name, SB_ARCHIVE_NAME));
    out->section = out->used;
    out->sum = sb_hash(0, head, SB_ARCHIVE_NAME);
    emit(out, head, sizeof head);
}

/* ---- beginning and end ---- */

static void begin(sb_archive_out *out, const char *kind, uint32_t version)
{
    const uint32_t words[2] = {version, SB_ARCHIVE_ORDER};
    char name[SB_ARCHIVE_NAME] = {0};
    memcpy(name, kind, strnlen(kind, sizeof name));
    out->used = out->section = out->pending = 0;
    out->reason = out->rank = 0;
    emit(out, name, sizeof name);
    emit(out, words, sizeof words);
}

void sb_archive_begin(sb_archive_out *out, const char *kind, uint32_t version)
{
    sb_atomic_abort(&out->file);
    begin(out, kind, version);
}

sb_status sb_archive_create(sb_archive_out *out, const char *path, const char *kind, uint32_t version, sb_error *error)
{
    sb_atomic_abort(&out->file);
    sb_status status = sb_atomic_open(&out->file, path, error);
    if (status == SB_OK) begin(out, kind, version);
    return status;
}

sb_status sb_archive_close(sb_archive_out *out, sb_error *error)
{
    sb_archive_section(out, SB_ARCHIVE_END);
    close_section(out);
    if (!out->file.stream) return out->reason ? sb_fail_memory(error, "an archive") : SB_OK;
    if (!out->reason) return sb_atomic_commit(&out->file, 1, error);
    sb_atomic_abort(&out->file);
    if (out->rank > 0)
        return sb_fail(error, SB_FAILED, "%.500s: rank %d cannot write: %s", out->file.path, out->rank,
                       strerror(out->reason));
    return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", out->file.path, strerror(out->reason));
}

void sb_archive_out_free(sb_archive_out *out)
{
    sb_atomic_abort(&out->file);
    sb_free(out->bytes);
    *out = (sb_archive_out){0};
}

/* ---- values ---- */

static void append_kind(sb_archive_out *out, char kind)
{
    append(out, &kind, 1);
}

void sb_put_count(sb_archive_out *out, uint64_t value)
{
    append_kind(out, SB_VALUE_COUNT);
    append_word(out, value);
}

void sb_put_real(sb_archive_out *out, double value)
{
    append_kind(out, SB_VALUE_REAL);
    append(out, &value, sizeof value);
}

void sb_put_flag(sb_archive_out *out, bool value)
{
    const char byte = value ? 1 : 0;
    append_kind(out, SB_VALUE_FLAG);
    append(out, &byte, 1);
}

void sb_put_vector(sb_archive_out *out, sb_vec3 value)
{
    sb_put_real(out, value.x);
    sb_put_real(out, value.y);
    sb_put_real(out, value.z);
}

void sb_put_list_begin(sb_archive_out *out, size_t count, size_t size)
{
    append_kind(out, SB_VALUE_LIST);
    append_word(out, count);
    append_word(out, size);
}

void sb_put_list_bytes(sb_archive_out *out, const void *bytes, size_t length)
{
    append(out, bytes, length);
}

void sb_put_list(sb_archive_out *out, const void *items, size_t count, size_t size)
{
    sb_put_list_begin(out, count, size);
    append(out, items, count * size);
}

void sb_put_text(sb_archive_out *out, const char *text)
{
    sb_put_list(out, text, strlen(text), 1);
}

void sb_put_blocks(sb_archive_out *out, const uint64_t *sums, size_t count)
{
    for (size_t k = 0; k < count; k++) add_sum(out, sums[k]);
    if (out->reason) return;
    out->used += count * SB_ARCHIVE_BLOCK;
    if (fseeko(out->file.stream, (off_t)out->used, SEEK_SET) != 0) out->reason = errno;
}
