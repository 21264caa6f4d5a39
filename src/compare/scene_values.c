#include "compare/scene_values.h"

#include "base/memory.h"

#include <stdio.h>
#include <string.h>

enum { DEPTH = 16, KEY_MAX = 512, VALUE_MAX = 2048 };

/* The keys and entries that contain the present line. */
typedef struct place {
    size_t indent, length; /* of the line; of the key up to it */
    size_t entries;        /* of its list so far */
} place;

typedef struct reader {
    sb_scene_values *values;
    char key[KEY_MAX];
    place places[DEPTH];
    size_t depth;
} reader;

static void leave(reader *r, size_t indent)
{
    while (r->depth > 0 && r->places[r->depth - 1].indent >= indent) r->depth--;
    r->key[r->depth > 0 ? r->places[r->depth - 1].length : 0] = '\0';
}

/* Appends a part to the present key. */
static bool extend(reader *r, const char *part, size_t length)
{
    const size_t used = strlen(r->key);
    if (used + length + 2 > sizeof r->key) return false;
    snprintf(r->key + used, sizeof r->key - used, "%s%.*s", used > 0 ? "." : "", (int)length, part);
    return true;
}

static void enter(reader *r, size_t indent)
{
    if (r->depth < DEPTH) r->places[r->depth++] = (place){.indent = indent, .length = strlen(r->key)};
}

/* Takes the value's text without quotes, and its unit, which is a comment behind it. */
static void take_value(const char *from, char value[VALUE_MAX])
{
    size_t length = 0;
    bool quoted = false;
    while (*from == ' ') from++;
    for (; *from && length + 4 < VALUE_MAX; from++) {
        if (*from == '"') {
            quoted = !quoted;
            continue;
        }
        if (quoted && *from == '\\' && from[1]) from++;
        if (!quoted && strncmp(from, " # ", 3) == 0) from += 2;
        value[length++] = *from;
    }
    value[length] = '\0';
}

static sb_status add(reader *r, const char *value, sb_error *error)
{
    sb_scene_values *all = r->values;
    if (sb_grow((void **)&all->values, &all->capacity, all->count + 1, sizeof *all->values) != 0)
        return sb_fail_memory(error, "the values of a scene");
    const sb_scene_value made = {sb_strdup(r->key), sb_strdup(value)};
    if (made.key && made.value) {
        all->values[all->count++] = made;
        return SB_OK;
    }
    sb_free(made.key);
    sb_free(made.value);
    return sb_fail_memory(error, "the values of a scene");
}

/* "- name: ..." begins an entry of a list, with that name; another entry has a number. */
static bool begin_entry(reader *r, const char *line, size_t indent)
{
    char value[VALUE_MAX], number[24];
    if (r->depth == 0) return false;
    const size_t entry = ++r->places[r->depth - 1].entries;
    snprintf(number, sizeof number, "%zu", entry);
    const char *name = number;
    if (strncmp(line, "name: ", 6) == 0) {
        take_value(line + 6, value);
        name = value;
    }
    if (!extend(r, name, strlen(name))) return false;
    enter(r, indent);
    return true;
}

static sb_status take_line(reader *r, const char *line, sb_error *error)
{
    char value[VALUE_MAX];
    size_t indent = strspn(line, " ");
    line += indent;
    if (*line == '\0' || *line == '#') return SB_OK;
    leave(r, indent);
    if (strncmp(line, "- ", 2) == 0) {
        line += 2;
        if (!begin_entry(r, line, indent)) return SB_OK;
        indent += 2;
    }
    const char *colon = strchr(line, ':');
    if (!colon || (colon[1] != ' ' && colon[1] != '\0') || !extend(r, line, (size_t)(colon - line))) return SB_OK;
    take_value(colon + 1, value);
    if (*value) return add(r, value, error);
    enter(r, indent);
    return SB_OK;
}

sb_status sb_scene_values_read(const char *text, sb_scene_values *values, sb_error *error)
{
    char line[VALUE_MAX];
    sb_status status = SB_OK;
    *values = (sb_scene_values){0};
    reader r = {.values = values};
    while (text && *text && status == SB_OK) {
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", length < sizeof line ? (int)length : (int)sizeof line - 1, text);
        status = take_line(&r, line, error);
        text += length + (text[length] == '\n');
    }
    if (status != SB_OK) sb_scene_values_free(values);
    return status;
}

void sb_scene_values_free(sb_scene_values *values)
{
    for (size_t i = 0; i < values->count; i++) {
        sb_free(values->values[i].key);
        sb_free(values->values[i].value);
    }
    sb_free(values->values);
    *values = (sb_scene_values){0};
}

const char *sb_scene_values_find(const sb_scene_values *values, const char *key)
{
    for (size_t i = 0; i < values->count; i++)
        if (strcmp(values->values[i].key, key) == 0) return values->values[i].value;
    return NULL;
}

bool sb_scene_values_matter(const char *key)
{
    static const char *const blocks[] = {"render.", "stream.", "output.", "control."};
    const char *last = strrchr(key, '.');
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; b++)
        if (strncmp(key, blocks[b], strlen(blocks[b])) == 0) return false;
    return strcmp(key, "title") != 0 && !(last && strcmp(last, ".color") == 0);
}
