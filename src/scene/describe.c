#include "scene/key.h"
#include "scene/presets.h"

#include <stdio.h>
#include <string.h>

typedef struct walk {
    void (*visit)(void *context, const sb_scene_key *key);
    void *context;
} walk;

/* The default preset's value, then that in two dimensions and those of the other presets where they differ. */
static void format_presets(const sb_key *key, const char *usual, char *out, size_t size)
{
    const char *before = " (", *flat = sb_key_default(key, SB_PRESET_DEFAULT, 2);
    int used = snprintf(out, size, "%s", usual);
    if (strcmp(usual, flat) != 0 && used > 0 && (size_t)used < size) {
        used += snprintf(out + used, size - (size_t)used, "%s2D: %s", before, flat);
        before = ", ";
    }
    for (int p = SB_PRESET_DEFAULT + 1; sb_preset_names[p] && used > 0 && (size_t)used < size; p++) {
        const char *other = sb_key_default(key, (sb_preset)p, 3);
        if (strcmp(usual, other) == 0) continue;
        used += snprintf(out + used, size - (size_t)used, "%s%s: %s", before, sb_preset_names[p], other);
        before = ", ";
    }
    if (*before == ',') snprintf(out + used, size - (size_t)used, ")");
}

/* Formats the default as docs/scene.md shows it. */
static void format_default(const sb_key *key, char *out, size_t size)
{
    const char *usual = sb_key_default(key, SB_PRESET_DEFAULT, 3);
    if (key->flags & SB_KEY_REQUIRED_3D)
        snprintf(out, size, "required in 3D; 2D: %s", key->derived ? key->derived : usual);
    else if (key->derived)
        snprintf(out, size, "%s", key->derived);
    else if (usual)
        format_presets(key, usual, out, size);
    else if (key->type == SB_KEY_LIST)
        snprintf(out, size, "none");
    else
        out[0] = '\0';
}

static void walk_table(const walk *to, const sb_table *table, const char *prefix);

static void walk_key(const walk *to, const sb_key *key, const char *prefix, const char *only)
{
    char path[200], fallback[200], range[300];
    snprintf(path, sizeof path, "%s%s%s", prefix, *prefix ? "." : "", key->name);
    format_default(key, fallback, sizeof fallback);
    sb_key_range(key, range, sizeof range);
    /* An "only" that repeats the block's purpose is used in errors, but not in docs/scene.md. */
    const char *condition = key->only ? key->only : only;
    sb_scene_key row = {
        .path = path,
        .unit = key->unit ? key->unit : "",
        .fallback = fallback,
        .range = range,
        .doc = key->doc,
        .only = key->derived && !(key->flags & (SB_KEY_REQUIRED | SB_KEY_REQUIRED_3D)) ? NULL : condition,
        .required = key->flags & SB_KEY_REQUIRED,
    };
    to->visit(to->context, &row);
    if (key->type != SB_KEY_BLOCK && key->type != SB_KEY_LIST) return;
    if (key->type == SB_KEY_LIST) strncat(path, "[]", sizeof path - strlen(path) - 1);
    walk_table(to, key->table, path);
}

static void walk_table(const walk *to, const sb_table *table, const char *prefix)
{
    for (size_t i = 0; i < table->count; i++) {
        const sb_key *key = &table->keys[i];
        if (key->name) walk_key(to, key, prefix, NULL);
        for (size_t j = 0; !key->name && j < key->table->count; j++)
            walk_key(to, &key->table->keys[j], prefix, key->only);
    }
}

void sb_scene_keys(void (*visit)(void *context, const sb_scene_key *key), void *context)
{
    const walk to = {.visit = visit, .context = context};
    walk_table(&to, &sb_scene_table, "");
}
