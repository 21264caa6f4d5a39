/* Stress case: every scene key at the ends of its range, or far from usual values if it has no range. The key tables
   are walked, so that new keys are included automatically. */
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

static void add_trial(const walk *w, const char *key, const char *value)
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
    t->time_limit = 300;
}

/* Adds a trial with a number, or a vector of it if the key has components. */
static void add_number(const walk *w, const sb_key *key, const char *path, double value, int components)
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
    add_trial(w, path, text);
}

/* Adds both ends of the range. If the range has no end: the largest number, and 10 000 times the usual value. */
static void add_range(const walk *w, const sb_key *key, const char *path, double now, int components)
{
    const double usual = fabs(now) > 0 ? fabs(now) : 1;
    const bool lowest = isfinite(key->min), above = key->flags & SB_KEY_ABOVE, below = key->flags & SB_KEY_BELOW;
    add_number(w, key, path, !lowest ? -SB_NUMBER_LARGEST : above ? DBL_MIN : key->min, components);
    if (!lowest) add_number(w, key, path, -1e4 * usual, components);
    if (lowest && above) add_number(w, key, path, 1e-4 * usual, components);
    if (!isfinite(key->max)) add_number(w, key, path, 1e4 * usual, components);
    add_number(w, key, path,
               !isfinite(key->max) ? SB_NUMBER_LARGEST
               : below             ? nextafter(key->max, 0)
                                   : key->max,
               components);
}

static void add_names(const walk *w, const sb_key *key, const char *path)
{
    for (size_t i = 0; key->type == SB_KEY_KERNEL && sb_kernels[i]; i++) add_trial(w, path, sb_kernels[i]->name);
    for (size_t i = 0; key->type == SB_KEY_LAW && sb_wavemakers[i]; i++) add_trial(w, path, sb_wavemakers[i]->name);
    for (size_t i = 0; key->words && key->words[i]; i++) add_trial(w, path, key->words[i]);
}

static void add_leaf(const walk *w, const sb_key *key, const char *path, const void *value, int dimensions)
{
    switch (key->type) {
    case SB_KEY_NUMBER:
        add_range(w, key, path, *(const double *)value, 1);
        break;
    case SB_KEY_INTEGER:
        add_range(w, key, path, *(const int *)value, 1);
        break;
    case SB_KEY_VECTOR:
        add_range(w, key, path, ((const sb_vec3 *)value)->x, dimensions == 2 && !(key->flags & SB_KEY_FULL) ? 2 : 3);
        break;
    case SB_KEY_PLACE:
        add_range(w, key, path, *(const double *)value, dimensions == 2 ? 1 : 2);
        break;
    case SB_KEY_COLOR:
        add_range(w, key, path, 0.5, 3);
        break;
    case SB_KEY_SEED:
        add_trial(w, path, "0");
        add_trial(w, path, "18446744073709551615");
        break;
    case SB_KEY_SWITCH:
        add_trial(w, path, "true");
        add_trial(w, path, "false");
        break;
    case SB_KEY_TEXT:
        add_trial(w, path, "\"\""); /* fall through */
    case SB_KEY_NAME:
        add_trial(w, path, "n");
        add_trial(w, path, "a63-characters-long-name-of-what-may-be-a-file-or-channel-nameX");
        break;
    case SB_KEY_CHOICE:
    case SB_KEY_LETTER:
    case SB_KEY_KERNEL:
    case SB_KEY_LAW:
        add_names(w, key, path);
        break;
    case SB_KEY_FILE:
    case SB_KEY_BLOCK:
    case SB_KEY_LIST:
        break;
    }
}

static void walk_table(const walk *w, const sb_table *table, const char *item, const char *prefix, int dimensions);

/* Walks all items of the list, and adds a trial with an empty list. */
static void walk_list(const walk *w, const sb_key *key, const char *item, const char *path, int dimensions)
{
    const char *items = *(const char *const *)(const void *)(item + key->offset);
    const size_t count = *(const size_t *)(const void *)(item + key->count_offset);
    char one[200];
    for (size_t i = 0; i < count; i++) {
        snprintf(one, sizeof one, "%s[%zu]", path, i);
        walk_table(w, key->table, items + i * key->table->size, one, dimensions);
    }
    add_trial(w, path, "[]");
}

static void walk_table(const walk *w, const sb_table *table, const char *item, const char *prefix, int dimensions)
{
    const unsigned variant = sb_table_variant(table, item, NULL);
    char path[160];
    for (size_t i = 0; i < table->count; i++) {
        const sb_key *key = &table->keys[i];
        if (!sb_key_applies(key, variant)) continue;
        if (!key->name) { /* a list of one item whose keys are in the parent */
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
            add_leaf(w, key, path, item + key->offset, dimensions);
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
        sb_trial_add(trials, name, "unreadable"); /* its run reports the reason */
    sb_scene_free(&scene);
}

static void plan(sb_trials *trials, bool quick)
{
    walk_scene(trials, "keys-2d.yaml", quick ? "numerics" : NULL);
    if (!quick) walk_scene(trials, "keys.yaml", NULL);
}

static void judge(sb_judged *j)
{
    sb_note(j, "%s",
            j->outcome.how == SB_ENDS_WELL      ? "ran"
            : j->outcome.how == SB_ENDS_REFUSED ? "refused"
            : j->outcome.how == SB_ENDS_FAILED  ? "failed"
            : j->outcome.how == SB_ENDS_STOPPED ? "stopped after SIGTERM"
                                                : j->outcome.ended);
    if (j->outcome.how & (SB_ENDS_REFUSED | SB_ENDS_FAILED)) sb_note(j, "%.180s", j->outcome.last_line + 12);
}

const sb_stress sb_stress_keys = {
    .name = "keys",
    .title = "Every scene key at both ends of its range",
    .rules =
        "The run finishes, or is refused or fails with the reason in one line, or stops after SIGTERM, which is sent "
        "after four seconds",
    .plan = plan,
    .judge = judge,
};
