#include "scene/key.h"

#include "base/memory.h"
#include "base/nearest.h"
#include "scene/presets.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

unsigned sb_table_variant(const sb_table *table, const void *item, const sb_yaml *map)
{
    return table->variant ? table->variant(item, map) : ~0u;
}

bool sb_key_applies(const sb_key *key, unsigned variant)
{
    return key->applies == 0 || (key->applies & variant) != 0;
}

const sb_key *sb_table_find(const sb_table *table, const char *name)
{
    for (size_t i = 0; i < table->count; i++) {
        const sb_key *key = &table->keys[i];
        if (!key->name) key = sb_table_find(key->table, name);
        if (key && strcmp(key->name, name) == 0) return key;
    }
    return NULL;
}

static void try_all(const sb_table *table, sb_nearest *nearest)
{
    for (size_t i = 0; i < table->count; i++) {
        const sb_key *key = &table->keys[i];
        if (key->name)
            sb_nearest_try(nearest, key->name);
        else
            try_all(key->table, nearest);
    }
}

const char *sb_table_nearest(const sb_table *table, const char *name)
{
    sb_nearest nearest = sb_nearest_to(name);
    try_all(table, &nearest);
    return nearest.found;
}

const char *sb_key_default(const sb_key *key, sb_preset preset, int dimensions)
{
    return key->flags & SB_KEY_PRESET ? sb_preset_value(preset, dimensions, key->name) : key->fallback;
}

typedef struct text_buffer {
    char *out;
    size_t size, used;
} text_buffer;

__attribute__((format(printf, 2, 3))) static void add(text_buffer *text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text->out + text->used, text->size - text->used, format, arguments);
    va_end(arguments);
    if (length > 0) text->used += (size_t)length;
    if (text->used >= text->size) text->used = text->size - 1;
}

static void add_choices(text_buffer *text, const char *const *names)
{
    for (size_t i = 0; names[i]; i++) add(text, "%s%s", i == 0 ? "" : names[i + 1] ? ", " : " or ", names[i]);
}

static void add_kernels(text_buffer *text)
{
    for (size_t i = 0; sb_kernels[i]; i++)
        add(text, "%s%s", i == 0 ? "" : sb_kernels[i + 1] ? ", " : " or ", sb_kernels[i]->name);
}

static void add_laws(text_buffer *text)
{
    for (size_t i = 0; sb_wavemakers[i]; i++)
        add(text, "%s%s", i == 0 ? "" : sb_wavemakers[i + 1] ? ", " : " or ", sb_wavemakers[i]->name);
}

static void add_range(text_buffer *text, const sb_key *key)
{
    bool low = key->min > -HUGE_VAL, high = key->max < HUGE_VAL;
    bool plain = !(key->flags & (SB_KEY_ABOVE | SB_KEY_BELOW));
    if (low && high && plain) {
        add(text, "%.10g to %.10g", key->min, key->max);
        return;
    }
    if (low) add(text, "%s %.10g", key->flags & SB_KEY_ABOVE ? ">" : ">=", key->min);
    if (high) add(text, "%s%s %.10g", low ? " and " : "", key->flags & SB_KEY_BELOW ? "<" : "<=", key->max);
}

static const char *unit_name(const char *unit)
{
    static const struct {
        const char *unit, *name;
    } units[] = {{"m", "metres"}, {"s", "seconds"}, {"deg", "degrees"}, {"px", "pixels"}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strcmp(units[i].unit, unit) == 0) return units[i].name;
    return unit;
}

static void add_number(text_buffer *text, const sb_key *key)
{
    if (key->unit)
        add(text, "%s", unit_name(key->unit));
    else
        add(text, "%s", key->type == SB_KEY_NUMBER ? "a number" : "a whole number");
    if (key->min > -HUGE_VAL || key->max < HUGE_VAL) {
        add(text, "%s", key->flags & (SB_KEY_ABOVE | SB_KEY_BELOW) || key->max == HUGE_VAL ? " " : " from ");
        add_range(text, key);
    }
    if (key->words) add(text, ", or %s", key->words[0]);
}

void sb_key_expectation(const sb_key *key, int dimensions, char *out, size_t size)
{
    text_buffer text = {.out = out, .size = size};
    out[0] = '\0';
    bool flat = dimensions == 2 && !(key->flags & SB_KEY_FULL);
    switch (key->type) {
    case SB_KEY_NUMBER:
    case SB_KEY_INTEGER:
        add_number(&text, key);
        break;
    case SB_KEY_SEED:
        add(&text, "a whole number from 0 to 2^64 - 1");
        break;
    case SB_KEY_SWITCH:
        add(&text, "true or false");
        break;
    case SB_KEY_TEXT:
        add(&text, "text");
        break;
    case SB_KEY_NAME:
        add(&text, "a name of letters, digits, _ . and -, at most %d long", SB_NAME_MAX - 1);
        break;
    case SB_KEY_FILE:
        add(&text, "a file, relative to the scene file");
        break;
    case SB_KEY_VECTOR:
        add(&text, "%s", flat ? "[x, z]" : "[x, y, z]");
        if (key->unit) add(&text, " in %s", unit_name(key->unit));
        break;
    case SB_KEY_PLACE:
        add(&text, "%s in metres", dimensions == 2 ? "[x]" : "[x, y]");
        break;
    case SB_KEY_COLOR:
        add(&text, "[red, green, blue], each 0 to 1");
        break;
    case SB_KEY_BLOCK:
        add(&text, "a block of keys");
        break;
    case SB_KEY_LIST:
        add(&text, "a list");
        break;
    case SB_KEY_CHOICE:
    case SB_KEY_LETTER:
    case SB_KEY_KERNEL:
    case SB_KEY_LAW:
        sb_key_range(key, out, size);
        break;
    }
}

void sb_key_range(const sb_key *key, char *out, size_t size)
{
    text_buffer text = {.out = out, .size = size};
    out[0] = '\0';
    switch (key->type) {
    case SB_KEY_NUMBER:
    case SB_KEY_INTEGER:
    case SB_KEY_VECTOR:
    case SB_KEY_PLACE:
        if (key->min == -HUGE_VAL && key->max == HUGE_VAL)
            add(&text, "any");
        else
            add_range(&text, key);
        if (key->flags & SB_KEY_UNIT) add(&text, ", not all 0");
        if (key->words) add(&text, ", or %s", key->words[0]);
        break;
    case SB_KEY_SEED:
        add(&text, "0 to 2^64 - 1");
        break;
    case SB_KEY_CHOICE:
    case SB_KEY_LETTER:
        add_choices(&text, key->words);
        break;
    case SB_KEY_KERNEL:
        add_kernels(&text);
        break;
    case SB_KEY_LAW:
        add_laws(&text);
        break;
    case SB_KEY_COLOR:
        add(&text, "0 to 1");
        break;
    case SB_KEY_SWITCH:
    case SB_KEY_TEXT:
    case SB_KEY_NAME:
    case SB_KEY_FILE:
    case SB_KEY_BLOCK:
    case SB_KEY_LIST:
        sb_key_expectation(key, 3, out, size);
        break;
    }
}

static void free_key(const sb_key *key, char *field, void *item)
{
    if (key->type == SB_KEY_TEXT || key->type == SB_KEY_FILE) {
        sb_free(*(char **)field);
        *(char **)field = NULL;
    } else if (key->type == SB_KEY_BLOCK) {
        sb_table_free(key->table, field);
    } else if (key->type == SB_KEY_LIST) {
        size_t *count = (size_t *)((char *)item + key->count_offset);
        char *items = *(char **)field;
        for (size_t i = 0; items && i < *count; i++) sb_table_free(key->table, items + i * key->table->size);
        sb_free(items);
        *(char **)field = NULL;
        *count = 0;
    }
}

void sb_table_free(const sb_table *table, void *item)
{
    for (size_t i = 0; i < table->count; i++) free_key(&table->keys[i], (char *)item + table->keys[i].offset, item);
}
