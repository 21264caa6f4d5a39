/* Every scene key at the ends of its range, and far beyond what anyone means where it has none: the key tables are
   walked, so that a new key is taken without a word here. */
#include "stresses.h"

#include "scene/key.h"

#include <float.h>
#include <math.h>
#include <string.h>

typedef struct walk {
    sb_trials *trials;
    const char *scene;
    const char *within; /* only keys below this block; NULL: all */
} walk;

static void take(const walk *w, const char *key, const char *value)
{
    char name[SB_TRIAL_NAME];
    if (w->within && strncmp(key, w->within, strlen(w->within)) != 0) return;
    snprintf(name, sizeof name, "%.4s%s=%.40s", strstr(w->scene, "2d") ? "2d." : "", key, value[0] ? value : "empty");
    for (char *c = name; *c; c++)
        if (strchr("/ \"'", *c)) *c = '_';
    sb_trial *t = sb_trial_add(w->trials, w->scene, "%s", name);
    sb_trial_set(t, "%s=%s", key, value);
    t->ends = SB_ENDS_WELL | SB_ENDS_REFUSED | SB_ENDS_FAILED | SB_ENDS_STOPPED;
    t->stop_after = 4;
    t->patience = 300;
}

/* A number, or as many of it as the key has components. */
static void take_number(const walk *w, const sb_key *key, const char *path, double value, int components)
{
    char text[160] = "[";
    if (components == 1 || key->type == SB_KEY_INTEGER) {
        snprintf(text, sizeof text, "%.17g", value);
    } else {
        for (int i = 0; i < components; i++) {
            size_t length = strlen(text);
            snprintf(text + length, sizeof text - length, "%.9g%s", value, i + 1 < components ? ", " : "]");
        }
    }
    take(w, path, text);
}

/* Both ends. Where a range has no end: what a double can hold, and ten thousand times more or less than is usual. */
static void take_range(const walk *w, const sb_key *key, const char *path, double now, int components)
{
    const double usual = fabs(now) > 0 ? fabs(now) : 1;
    const bool lowest = isfinite(key->min), above = key->flags & SB_KEY_ABOVE, below = key->flags & SB_KEY_BELOW;
    take_number(w, key, path, !lowest ? -1e300 : above ? DBL_MIN : key->min, components);
    if (!lowest) take_number(w, key, path, -1e4 * usual, components);
    if (lowest && above) take_number(w, key, path, 1e-4 * usual, components);
    if (!isfinite(key->max)) take_number(w, key, path, 1e4 * usual, components);
    take_number(w, key, path, !isfinite(key->max) ? 1e300 : below ? nextafter(key->max, 0) : key->max, components);
}

static void take_words(const walk *w, const sb_key *key, const char *path)
{
    for (size_t i = 0; key->type == SB_KEY_KERNEL && sb_kernels[i]; i++) take(w, path, sb_kernels[i]->name);
    for (size_t i = 0; key->type == SB_KEY_LAW && sb_wavemakers[i]; i++) take(w, path, sb_wavemakers[i]->name);
    for (size_t i = 0; key->words && key->words[i]; i++) take(w, path, key->words[i]);
}

static void take_leaf(const walk *w, const sb_key *key, const char *path, const void *value, int dimensions)
{
    switch (key->type) {
    case SB_KEY_NUMBER:
        take_range(w, key, path, *(const double *)value, 1);
        break;
    case SB_KEY_INTEGER:
        take_range(w, key, path, *(const int *)value, 1);
        break;
    case SB_KEY_VECTOR:
        take_range(w, key, path, ((const sb_vec3 *)value)->x, dimensions == 2 && !(key->flags & SB_KEY_FULL) ? 2 : 3);
        break;
    case SB_KEY_PLACE:
        take_range(w, key, path, *(const double *)value, dimensions == 2 ? 1 : 2);
        break;
    case SB_KEY_COLOR:
        take_range(w, key, path, 0.5, 3);
        break;
    case SB_KEY_SEED:
        take(w, path, "0");
        take(w, path, "18446744073709551615");
        break;
    case SB_KEY_SWITCH:
        take(w, path, "true");
        take(w, path, "false");
        break;
    case SB_KEY_TEXT:
        take(w, path, "\"\""); /* fall through */
    case SB_KEY_NAME:
        take(w, path, "n");
        take(w, path, "a63-characters-long-name-of-what-may-be-a-file-or-channel-nameX");
        break;
    case SB_KEY_CHOICE:
    case SB_KEY_LETTER:
    case SB_KEY_KERNEL:
    case SB_KEY_LAW:
        take_words(w, key, path);
        break;
    case SB_KEY_FILE:
    case SB_KEY_BLOCK:
    case SB_KEY_LIST:
        break;
    }
}

static void walk_table(const walk *w, const sb_table *table, const char *item, const char *prefix, int dimensions);

/* All items there are; and none at all. */
static void walk_list(const walk *w, const sb_key *key, const char *item, const char *path, int dimensions)
{
    const char *items = *(const char *const *)(const void *)(item + key->offset);
    const size_t count = *(const size_t *)(const void *)(item + key->count_offset);
    char one[200];
    for (size_t i = 0; i < count; i++) {
        snprintf(one, sizeof one, "%s[%zu]", path, i);
        walk_table(w, key->table, items + i * key->table->size, one, dimensions);
    }
    take(w, path, "[]");
}

static void walk_table(const walk *w, const sb_table *table, const char *item, const char *prefix, int dimensions)
{
    const unsigned variant = sb_table_variant(table, item, NULL);
    char path[160];
    for (size_t i = 0; i < table->count; i++) {
        const sb_key *key = &table->keys[i];
        if (!sb_key_applies(key, variant)) continue;
        if (!key->name) { /* a list of one whose keys stand in the parent */
            const char *first = *(const char *const *)(const void *)(item + key->offset);
            if (first) walk_table(w, key->table, first, prefix, dimensions);
            continue;
        }
        snprintf(path, sizeof path, "%s%s%s", prefix, *prefix ? "." : "", key->name);
        if (key->type == SB_KEY_BLOCK)
            walk_table(w, key->table, item + key->offset, path, dimensions);
        else if (key->type == SB_KEY_LIST)
            walk_list(w, key, item, path, dimensions);
        else
            take_leaf(w, key, path, item + key->offset, dimensions);
    }
}

static void walk_scene(sb_trials *trials, const char *name, const char *within)
{
    const walk w = {trials, name, within};
    const sb_trial plain = {.scene = name};
    sb_scene scene = {0};
    sb_error error = {0};
    if (sb_trial_scene(&plain, trials->assets, &scene, &error) == SB_OK)
        walk_table(&w, &sb_scene_table, (const char *)&scene, "", scene.dimensions);
    else
        sb_trial_add(trials, name, "unreadable"); /* its run tells why */
    sb_scene_free(&scene);
}

static void plan(sb_trials *trials, bool quick)
{
    walk_scene(trials, "keys-2d.yaml", quick ? "numerics" : NULL);
    if (!quick) walk_scene(trials, "keys.yaml", NULL);
}

static void judge(sb_judged *all, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        sb_judged *j = &all[i];
        if (!j->outcome.there) continue;
        sb_note(j, "%s",
                j->outcome.how == SB_ENDS_WELL      ? "ran"
                : j->outcome.how == SB_ENDS_REFUSED ? "refused"
                : j->outcome.how == SB_ENDS_FAILED  ? "failed"
                : j->outcome.how == SB_ENDS_STOPPED ? "stopped when told"
                                                    : j->outcome.ended);
        if (j->outcome.how & (SB_ENDS_REFUSED | SB_ENDS_FAILED)) sb_note(j, "%.180s", j->outcome.said + 12);
    }
}

const sb_stress sb_stress_keys = {
    .name = "keys",
    .title = "Every scene key at both ends of its range",
    .rule = "The run ends well, or is refused or fails with the reason in one line, or stops when it is told to, which "
            "is after four seconds.",
    .plan = plan,
    .judge = judge,
};
