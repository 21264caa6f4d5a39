#include "base/archive.h"

#include "base/archive_layout.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"

#include <string.h>

static void append(sb_archive_out *out, const void *bytes, size_t length)
{
    if (out->starved || length > SIZE_MAX - out->used ||
        sb_grow((void **)&out->bytes, &out->capacity, out->used + length, 1) != 0) {
        out->starved = true;
        return;
    }
    if (length > 0) memcpy(out->bytes + out->used, bytes, length);
    out->used += length;
}

static void append_word(sb_archive_out *out, uint64_t word)
{
    append(out, &word, sizeof word);
}

static void append_name(sb_archive_out *out, const char *name)
{
    char padded[SB_ARCHIVE_NAME] = {0};
    memcpy(padded, name, strnlen(name, sizeof padded));
    append(out, padded, sizeof padded);
}

/* Fills in what the open section's head could not know. */
static void close_section(sb_archive_out *out)
{
    if (out->section == 0 || out->starved) return;
    unsigned char *head = out->bytes + out->section;
    const uint64_t length = out->used - out->section - SB_SECTION_HEAD;
    memcpy(head + SB_ARCHIVE_NAME, &length, sizeof length);
    const uint64_t sum = sb_archive_sum(head, length);
    memcpy(head + SB_ARCHIVE_NAME + sizeof length, &sum, sizeof sum);
    out->section = 0;
}

void sb_archive_begin(sb_archive_out *out, const char *kind, uint32_t version)
{
    const uint32_t words[2] = {version, SB_ARCHIVE_ORDER};
    out->used = 0;
    out->section = 0;
    out->starved = false;
    append_name(out, kind);
    append(out, words, sizeof words);
}

void sb_archive_section(sb_archive_out *out, const char *name)
{
    close_section(out);
    out->section = out->used;
    append_name(out, name);
    append_word(out, 0);
    append_word(out, 0);
}

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

void sb_put_list(sb_archive_out *out, const void *items, size_t count, size_t size)
{
    append_kind(out, SB_VALUE_LIST);
    append_word(out, count);
    append_word(out, size);
    append(out, items, count * size);
}

void sb_put_text(sb_archive_out *out, const char *text)
{
    sb_put_list(out, text, strlen(text), 1);
}

sb_status sb_archive_close(sb_archive_out *out, sb_error *error)
{
    sb_archive_section(out, SB_ARCHIVE_END);
    close_section(out);
    return out->starved ? sb_fail_memory(error, "an archive") : SB_OK;
}

sb_status sb_archive_save(sb_archive_out *out, const char *path, sb_error *error)
{
    sb_atomic_file file = {0};
    sb_status status = sb_archive_close(out, error);
    if (status == SB_OK) status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    fwrite(out->bytes, 1, out->used, file.stream);
    return sb_atomic_commit(&file, 1, error);
}

void sb_archive_out_free(sb_archive_out *out)
{
    sb_free(out->bytes);
    *out = (sb_archive_out){0};
}
