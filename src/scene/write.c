#include "base/file.h"
#include "base/hash.h"
#include "base/input.h"
#include "base/memory.h"
#include "scene/key.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct writer {
    FILE *stream;
    int indent;
    bool dash;       /* the next key is the first of a list item */
    bool unwritable; /* a text is not UTF-8 */
    bool identity;   /* writes the scene's identity instead of a scene */
    sb_status status;
    sb_error error; /* of the first file that could not be read */
} writer;

/* Writes the shortest decimal form that is read back as the same number. */
static void put_number(FILE *stream, double number)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (strtod(text, NULL) == number) break;
    }
    fputs(text, stream);
}

/* Returns the code point at *text and moves *text behind it; -1 if the bytes are not UTF-8. */
static long next_code(const char **text)
{
    const unsigned char *at = (const unsigned char *)*text;
    int more = at[0] < 0x80 ? 0 : at[0] < 0xc2 ? -1 : at[0] < 0xe0 ? 1 : at[0] < 0xf0 ? 2 : at[0] < 0xf5 ? 3 : -1;
    if (more < 0) return -1;
    long code = more == 0 ? at[0] : at[0] & (0x3f >> more);
    for (int i = 1; i <= more; i++) {
        if ((at[i] & 0xc0) != 0x80) return -1;
        code = code << 6 | (at[i] & 0x3f);
    }
    *text += 1 + more;
    static const long least[] = {0, 0x80, 0x800, 0x10000};
    bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return code < least[more] || surrogate || code > 0x10ffff ? -1 : code;
}

/* Writes the text in double quotes. Characters that YAML would refuse or fold are escaped. */
static void put_text(writer *out, const char *text)
{
    text = text ? text : "";
    fputc('"', out->stream);
    while (*text) {
        const char *start = text;
        long code = next_code(&text);
        if (code < 0) {
            out->unwritable = true;
            break;
        }
        if (code == '"' || code == '\\')
            fprintf(out->stream, "\\%c", (char)code);
        else if (code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029 || code == 0xfeff ||
                 code >= 0xfffe)
            fprintf(out->stream, "\\U%08lX", (unsigned long)code);
        else
            fwrite(start, 1, (size_t)(text - start), out->stream);
    }
    fputc('"', out->stream);
}

static void put_numbers(FILE *stream, const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        fputs(i == 0 ? "[" : ", ", stream);
        put_number(stream, numbers[i]);
    }
    fputc(']', stream);
}

static void put_color(FILE *stream, const float *color)
{
    const double numbers[] = {(double)color[0], (double)color[1], (double)color[2]};
    put_numbers(stream, numbers, 3);
}

static void put_vector(FILE *stream, const sb_vec3 *vector)
{
    const double numbers[] = {vector->x, vector->y, vector->z};
    put_numbers(stream, numbers, 3);
}

static sb_status hash_file(const char *path, uint64_t *hash, sb_error *error)
{
    char part[16384];
    size_t got;
    FILE *file;
    sb_status status = sb_input_open(path, &file, error);
    if (status != SB_OK) return status;
    *hash = 0;
    while ((got = fread(part, 1, sizeof part, file)) > 0) *hash = sb_hash(*hash, part, got);
    bool bad = ferror(file) != 0;
    fclose(file);
    return bad ? sb_fail(error, SB_BAD_INPUT, "%.500s: cannot read", path) : SB_OK;
}

/* A file is identified by its name and contents, not by its folder. */
static void put_file_identity(writer *out, const char *path)
{
    uint64_t hash = 0;
    const char *slash = path ? strrchr(path, '/') : NULL;
    put_text(out, slash ? slash + 1 : path);
    if (out->status == SB_OK && path && *path) out->status = hash_file(path, &hash, &out->error);
    fprintf(out->stream, " # contents %016llx", (unsigned long long)hash);
}

static void put_value(writer *out, const sb_key *key, const void *field)
{
    FILE *stream = out->stream;
    unsigned choice;
    switch (key->type) {
    case SB_KEY_NUMBER:
        if (key->words && isinf(*(const double *)field))
            fputs(key->words[0], stream);
        else
            put_number(stream, *(const double *)field);
        break;
    case SB_KEY_INTEGER:
        fprintf(stream, "%d", *(const int *)field);
        break;
    case SB_KEY_SEED:
        fprintf(stream, "%llu", (unsigned long long)*(const uint64_t *)field);
        break;
    case SB_KEY_SWITCH:
        fputs(*(const bool *)field ? "true" : "false", stream);
        break;
    case SB_KEY_FILE:
        if (out->identity) {
            put_file_identity(out, *(char *const *)field);
            break;
        }
        put_text(out, *(char *const *)field);
        break;
    case SB_KEY_TEXT:
        put_text(out, *(char *const *)field);
        break;
    case SB_KEY_NAME:
        put_text(out, field);
        break;
    case SB_KEY_VECTOR:
        put_vector(stream, field);
        break;
    case SB_KEY_PLACE:
        put_numbers(stream, field, 2);
        break;
    case SB_KEY_COLOR:
        put_color(stream, field);
        break;
    case SB_KEY_CHOICE:
        memcpy(&choice, field, sizeof choice);
        fputs(key->words[choice], stream);
        break;
    case SB_KEY_LETTER:
        fputc(*(const char *)field, stream);
        break;
    case SB_KEY_KERNEL:
        fputs((*(const sb_kernel *const *)field)->name, stream);
        break;
    case SB_KEY_LAW:
        fputs((*(const sb_wavemaker *const *)field)->name, stream);
        break;
    case SB_KEY_BLOCK:
    case SB_KEY_LIST:
        break;
    }
}

static void put_rows(writer *out, const sb_table *table, const void *item);

static void put_items(writer *out, const sb_key *key, const void *item)
{
    const char *items;
    size_t count;
    memcpy(&items, (const char *)item + key->offset, sizeof items);
    memcpy(&count, (const char *)item + key->count_offset, sizeof count);
    if (!key->name) {
        put_rows(out, key->table, items);
        return;
    }
    fputs(count == 0 ? " []\n" : "\n", out->stream);
    out->indent += 4;
    for (size_t i = 0; i < count; i++) {
        out->dash = true;
        put_rows(out, key->table, items + i * key->table->size);
    }
    out->indent -= 4;
}

static void put_row(writer *out, const sb_key *key, const void *item)
{
    const char *field = (const char *)item + key->offset;
    if (!key->name) {
        put_items(out, key, item);
        return;
    }
    fprintf(out->stream, "%*s%s%s:", out->dash ? out->indent - 2 : out->indent, "", out->dash ? "- " : "", key->name);
    out->dash = false;
    if (key->type == SB_KEY_LIST) {
        put_items(out, key, item);
    } else if (key->type == SB_KEY_BLOCK) {
        fputc('\n', out->stream);
        out->indent += 2;
        put_rows(out, key->table, field);
        out->indent -= 2;
    } else {
        fputc(' ', out->stream);
        put_value(out, key, field);
        fprintf(out->stream, "%s%s\n", key->unit ? " # " : "", key->unit ? key->unit : "");
    }
}

/* Whether a key that was added later has the value that scenes had without it. */
static bool is_as_before(const sb_key *key, const void *item)
{
    const char *field = (const char *)item + key->offset;
    int choice = 0;
    if (!(key->flags & SB_KEY_LATER)) return false;
    if (key->type == SB_KEY_SWITCH) return !*(const bool *)field;
    if (key->type == SB_KEY_NUMBER) return *(const double *)field == 0;
    if (key->type == SB_KEY_PLACE) return ((const double *)field)[0] == 0 && ((const double *)field)[1] == 0;
    memcpy(&choice, field, sizeof choice);
    return choice == 0;
}

static bool is_identity(const sb_key *key, const void *item)
{
    return !(key->flags & SB_KEY_FREE) && !is_as_before(key, item);
}

static void put_rows(writer *out, const sb_table *table, const void *item)
{
    unsigned variant = sb_table_variant(table, item, NULL);
    for (size_t i = 0; i < table->count; i++)
        if (sb_key_applies(&table->keys[i], variant) && (!out->identity || is_identity(&table->keys[i], item)))
            put_row(out, &table->keys[i], item);
}

/* A text in memory to which a stream writes. */
typedef struct memory_text {
    char *bytes;
    size_t length, capacity;
} memory_text;

static ssize_t append_text(void *cookie, const char *bytes, size_t length)
{
    memory_text *text = cookie;
    if (sb_grow((void **)&text->bytes, &text->capacity, text->length + length + 1, 1) != 0) return 0;
    memcpy(text->bytes + text->length, bytes, length);
    text->length += length;
    text->bytes[text->length] = '\0';
    return (ssize_t)length;
}

sb_status sb_scene_identity(const sb_scene *scene, char **text, sb_error *error)
{
    memory_text made = {0};
    writer out = {.identity = true};
    *text = NULL;
    out.stream = fopencookie(&made, "w", (cookie_io_functions_t){.write = append_text});
    if (!out.stream) return sb_fail_memory(error, "the scene's identity");
    put_rows(&out, &sb_scene_table, scene);
    bool bad = fflush(out.stream) != 0 || ferror(out.stream);
    fclose(out.stream);
    if (!bad && out.status == SB_OK) {
        *text = made.bytes;
        return SB_OK;
    }
    sb_free(made.bytes);
    if (out.status == SB_OK) return sb_fail_memory(error, "the scene's identity");
    if (error) *error = out.error;
    return out.status;
}

sb_status sb_scene_write(const sb_scene *scene, const char *path, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    writer out = {.stream = file.stream};
    fputs(SB_SCENE_WRITTEN " " SB_VERSION " understood it, every default written out.\n", file.stream);
    put_rows(&out, &sb_scene_table, scene);
    if (out.unwritable) {
        sb_atomic_abort(&file);
        return sb_fail(error, SB_BAD_INPUT,
                       "%.300s: a title, file name or address in the scene is not UTF-8, which "
                       "YAML requires",
                       path);
    }
    return sb_atomic_commit(&file, 1, error); /* synchronised to disk, because a resumed run reads it */
}
