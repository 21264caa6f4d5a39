/* Reads archives: checks the whole file first, then reads section by section. */
#include "base/archive.h"

#include "base/archive_layout.h"
#include "base/file.h"
#include "base/memory.h"

#include <errno.h>
#include <stdarg.h>
#include <string.h>

/* ---- the file as a whole ---- */

static uint64_t word_at(const unsigned char *bytes)
{
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

/* Copies a name as text. Bytes that are not printable, as in a file of another kind, become dots. */
static void copy_name(char out[SB_ARCHIVE_NAME + 1], const unsigned char *bytes)
{
    size_t length = strnlen((const char *)bytes, SB_ARCHIVE_NAME);
    for (size_t i = 0; i < length; i++) out[i] = (char)(bytes[i] >= ' ' && bytes[i] < 127 ? bytes[i] : '.');
    out[length] = '\0';
}

static sb_status check_head(const sb_archive_in *in, const char *kind, uint32_t version, sb_error *error)
{
    char found[SB_ARCHIVE_NAME + 1], padded[SB_ARCHIVE_NAME] = {0};
    uint32_t words[2];
    if (in->length < SB_ARCHIVE_HEAD)
        return sb_fail(error, SB_BAD_INPUT, "%s: has %zu bytes, too short for a %s", in->name, in->length, kind);
    copy_name(found, in->bytes);
    memcpy(padded, kind, strnlen(kind, sizeof padded));
    if (memcmp(in->bytes, padded, sizeof padded) != 0)
        return sb_fail(error, SB_BAD_INPUT, "%s: begins with \"%s\", expected \"%s\"", in->name, found, kind);
    memcpy(words, in->bytes + SB_ARCHIVE_NAME, sizeof words);
    if (words[1] != SB_ARCHIVE_ORDER)
        return sb_fail(error, SB_BAD_INPUT, "%s: byte order mark %08x, expected %08x", in->name, words[1],
                       SB_ARCHIVE_ORDER);
    if (words[0] != version)
        return sb_fail(error, SB_BAD_INPUT, "%s: version %u of the format, expected %u", in->name, words[0], version);
    return SB_OK;
}

/* Checks the section at *at and moves *at past it. */
static sb_status check_section(const sb_archive_in *in, size_t *at, char name[SB_ARCHIVE_NAME + 1], sb_error *error)
{
    const size_t left = in->length - *at;
    if (left < SB_SECTION_HEAD)
        return sb_fail(error, SB_BAD_INPUT, "%s: truncated at byte %zu, expected a section", in->name, in->length);
    const unsigned char *head = in->bytes + *at;
    const uint64_t length = word_at(head + SB_ARCHIVE_NAME);
    copy_name(name, head);
    if (length > left - SB_SECTION_HEAD)
        return sb_fail(error, SB_BAD_INPUT,
                       "%s: truncated or damaged: section \"%s\" at byte %zu has %zu bytes left, expected %llu",
                       in->name, name, *at, left - SB_SECTION_HEAD, (unsigned long long)length);
    if (sb_archive_sum(head, length) != word_at(head + SB_ARCHIVE_NAME + 8))
        return sb_fail(error, SB_BAD_INPUT, "%s: damaged: the checksum of section \"%s\" at byte %zu is wrong",
                       in->name, name, *at);
    *at += SB_SECTION_HEAD + length;
    return SB_OK;
}

static sb_status check_all(const sb_archive_in *in, const char *kind, uint32_t version, sb_error *error)
{
    char name[SB_ARCHIVE_NAME + 1] = "";
    size_t at = SB_ARCHIVE_HEAD;
    sb_status status = check_head(in, kind, version, error);
    while (status == SB_OK && strcmp(name, SB_ARCHIVE_END) != 0) status = check_section(in, &at, name, error);
    if (status == SB_OK && at != in->length)
        status = sb_fail(error, SB_BAD_INPUT, "%s: %zu bytes after its end, expected none", in->name, in->length - at);
    return status;
}

sb_status sb_archive_parse(sb_archive_in *in, const char *name, const void *bytes, size_t length, const char *kind,
                           uint32_t version, sb_error *error)
{
    *in = (sb_archive_in){.bytes = bytes, .length = length};
    snprintf(in->name, sizeof in->name, "%s", name);
    return check_all(in, kind, version, error);
}

sb_status sb_archive_open(sb_archive_in *in, const char *path, const char *kind, uint32_t version, sb_error *error)
{
    char *bytes;
    size_t length;
    *in = (sb_archive_in){0};
    sb_status status = sb_file_read(path, (size_t)1 << 40, &bytes, &length, error);
    /* A file that exists but cannot be read at the moment need not be damaged. */
    if (status == SB_BAD_INPUT && errno != 0 && errno != ENOENT && errno != EISDIR) {
        if (error) error->status = SB_FAILED;
        return SB_FAILED;
    }
    if (status != SB_OK) return status;
    status = sb_archive_parse(in, path, bytes, length, kind, version, error);
    in->own = (unsigned char *)bytes;
    if (status != SB_OK) sb_archive_in_free(in);
    return status;
}

void sb_archive_in_free(sb_archive_in *in)
{
    sb_free(in->own);
    *in = (sb_archive_in){0};
}

/* ---- sections ---- */

void sb_archive_refuse(sb_archive_in *in, const char *format, ...)
{
    char text[512];
    va_list arguments;
    if (in->error.status != SB_OK) return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    sb_fail(&in->error, SB_BAD_INPUT, "%s: section \"%s\": %s", in->name, in->section, text);
}

sb_status sb_archive_enter(sb_archive_in *in, const char *name, sb_error *error)
{
    in->error = (sb_error){0};
    snprintf(in->section, sizeof in->section, "%s", name);
    for (size_t at = SB_ARCHIVE_HEAD; at < in->length;) {
        char found[SB_ARCHIVE_NAME + 1];
        const unsigned char *head = in->bytes + at;
        const size_t length = (size_t)word_at(head + SB_ARCHIVE_NAME);
        copy_name(found, head);
        at += SB_SECTION_HEAD;
        in->at = at;
        in->end = at += length;
        if (strcmp(found, name) == 0) return SB_OK;
    }
    in->at = in->end = in->length;
    return sb_fail(error, SB_BAD_INPUT, "%s: no section \"%s\"", in->name, name);
}

sb_status sb_archive_leave(sb_archive_in *in, sb_error *error)
{
    if (in->at != in->end) sb_archive_refuse(in, "%zu bytes left over, expected none", in->end - in->at);
    if (in->error.status != SB_OK && error) *error = in->error;
    return in->error.status;
}

/* ---- values ---- */

static const char *kind_name(int kind)
{
    return kind == SB_VALUE_COUNT  ? "a count"
           : kind == SB_VALUE_REAL ? "a number"
           : kind == SB_VALUE_FLAG ? "a flag"
           : kind == SB_VALUE_LIST ? "a list"
                                   : "an unknown kind of value";
}

/* Returns the next `length` bytes, or NULL after storing the error. */
static const unsigned char *next(sb_archive_in *in, size_t length)
{
    if (in->error.status != SB_OK) return NULL;
    if (length > in->end - in->at) {
        sb_archive_refuse(in, "%zu bytes left, expected %zu", in->end - in->at, length);
        return NULL;
    }
    const unsigned char *here = in->bytes + in->at;
    in->at += length;
    return here;
}

/* Returns the `length` bytes of a value of this kind, or NULL. */
static const unsigned char *value(sb_archive_in *in, int kind, size_t length)
{
    const unsigned char *mark = next(in, 1);
    if (mark && *mark != kind)
        sb_archive_refuse(in, "%s at byte %zu, expected %s", kind_name(*mark), in->at - 1, kind_name(kind));
    return next(in, length);
}

uint64_t sb_take_count(sb_archive_in *in, uint64_t most)
{
    const unsigned char *bytes = value(in, SB_VALUE_COUNT, 8);
    const uint64_t count = bytes ? word_at(bytes) : 0;
    if (count > most) {
        sb_archive_refuse(in, "a count of %llu, expected at most %llu", (unsigned long long)count,
                          (unsigned long long)most);
        return 0;
    }
    return count;
}

double sb_take_real(sb_archive_in *in)
{
    double real = 0;
    const unsigned char *bytes = value(in, SB_VALUE_REAL, sizeof real);
    if (bytes) memcpy(&real, bytes, sizeof real);
    return real;
}

bool sb_take_flag(sb_archive_in *in)
{
    const unsigned char *byte = value(in, SB_VALUE_FLAG, 1);
    if (byte && *byte > 1) sb_archive_refuse(in, "a flag of %u, expected 0 or 1", *byte);
    return byte && *byte == 1;
}

sb_vec3 sb_take_vector(sb_archive_in *in)
{
    const double x = sb_take_real(in), y = sb_take_real(in), z = sb_take_real(in);
    return sb_vec(x, y, z);
}

size_t sb_take_length(sb_archive_in *in, size_t size, size_t most)
{
    const size_t start = in->at;
    const unsigned char *shape = value(in, SB_VALUE_LIST, 16);
    in->at = start;
    if (!shape) return 0;
    const uint64_t count = word_at(shape), found = word_at(shape + 8);
    if (found == size && count <= most && count <= (in->end - start) / size) return (size_t)count;
    sb_archive_refuse(in, "a list of %llu elements of %llu bytes, expected at most %zu of %zu",
                      (unsigned long long)count, (unsigned long long)found, most, size);
    return 0;
}

const void *sb_take_list_place(sb_archive_in *in, size_t count, size_t size)
{
    const unsigned char *shape = value(in, SB_VALUE_LIST, 16);
    if (shape && (word_at(shape) != count || word_at(shape + 8) != size))
        sb_archive_refuse(in, "a list of %llu elements of %llu bytes, expected %zu of %zu",
                          (unsigned long long)word_at(shape), (unsigned long long)word_at(shape + 8), count, size);
    return next(in, count * size);
}

void sb_take_list(sb_archive_in *in, void *items, size_t count, size_t size)
{
    const void *bytes = sb_take_list_place(in, count, size);
    if (count == 0) return;
    if (bytes)
        memcpy(items, bytes, count * size);
    else
        memset(items, 0, count * size);
}

char *sb_take_text(sb_archive_in *in)
{
    const size_t length = sb_take_length(in, 1, SIZE_MAX);
    if (in->error.status != SB_OK) return NULL;
    char *text = sb_alloc(length + 1, 1);
    if (text)
        sb_take_list(in, text, length, 1);
    else
        sb_fail_memory(&in->error, in->name);
    return text;
}
