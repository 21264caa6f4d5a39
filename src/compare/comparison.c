#include "compare/comparison.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---- one run ---- */

static sb_status read_run(const char *directory, sb_compared_run *run, sb_error *error)
{
    struct stat info;
    if (stat(directory, &info) != 0 || !S_ISDIR(info.st_mode) || !realpath(directory, run->path))
        return sb_fail(error, SB_BAD_INPUT, "%.500s: expected the folder of a run", directory);
    const char *slash = strrchr(run->path, '/');
    snprintf(run->label, sizeof run->label, "%.120s", slash && slash[1] ? slash + 1 : run->path);
    sb_status status = sb_report_run_read(directory, &run->run, error);
    if (status != SB_OK) return status;
    if (strcmp(sb_report_status(&run->run), "done") != 0)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: the status of the run is %s: expected done; finish it with run --resume", directory,
                       sb_report_status(&run->run));
    status = sb_loads_make(&run->run, &run->loads, error);
    if (status == SB_OK) status = sb_scene_values_read(run->run.scene_text, &run->values, error);
    if (status == SB_OK && !sb_scene_values_find(&run->values, "dimensions"))
        status = sb_fail(error, SB_BAD_INPUT, "%.500s/scene.yaml: no key dimensions: expected the scene of the run",
                         directory);
    return status;
}

/* ---- pairs ---- */

static const char *base_of(const char *value)
{
    const char *slash = strrchr(value, '/');
    return slash ? slash + 1 : value;
}

/* Finds a value of a terrain body that the other scene has not. Files are compared by name: where they lay may differ.
 */
static const sb_scene_value *other_ground(const sb_scene_values *one, const sb_scene_values *other)
{
    char key[600];
    for (size_t i = 0; i < one->count; i++) {
        const sb_scene_value *value = &one->values[i];
        const char *last = strrchr(value->key, '.');
        if (strncmp(value->key, "bodies.", 7) != 0 || !sb_scene_values_matter(value->key)) continue;
        if (strcmp(last, ".report") == 0) continue;
        snprintf(key, sizeof key, "%.*s.role", (int)(last - value->key), value->key);
        const char *role = sb_scene_values_find(one, key), *its = sb_scene_values_find(other, value->key);
        if (!role || strcmp(role, "terrain") != 0) continue;
        if (!its || strcmp(base_of(its), base_of(value->value)) != 0) return value;
    }
    return NULL;
}

static size_t count_common(const sb_report_run *one, const sb_report_run *other)
{
    size_t common = 0;
    for (size_t t = 0; t < SB_REPORT_ENERGY; t++)
        for (size_t i = 0; i < one->tables[t].count; i++)
            common += sb_series_table_find(&other->tables[t], one->tables[t].series[i].name) != NULL;
    return common;
}

static sb_status check_pair(const sb_compared_run *one, const sb_compared_run *other, sb_error *error)
{
    const double dimensions = sb_report_number(&one->run, "dimensions");
    const double others = sb_report_number(&other->run, "dimensions");
    if (strcmp(one->path, other->path) == 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: is given twice: expected different runs", other->run.directory);
    if (dimensions != others)
        return sb_fail(error, SB_BAD_INPUT, "%.300s and %.300s: have %g and %g dimensions: expected equal numbers",
                       one->run.directory, other->run.directory, dimensions, others);
    const sb_scene_value *ground = other_ground(&one->values, &other->values);
    if (!ground) ground = other_ground(&other->values, &one->values);
    if (ground)
        return sb_fail(error, SB_BAD_INPUT, "%.300s and %.300s: have different ground: %.100s differs; expected one",
                       one->run.directory, other->run.directory, ground->key);
    if (count_common(&one->run, &other->run) == 0)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.300s and %.300s: have no body, gauge, line, plane or probe in common: expected at least one",
                       one->run.directory, other->run.directory);
    return SB_OK;
}

/* ---- groups ---- */

static bool same_but_for_seed(const sb_scene_values *one, const sb_scene_values *other)
{
    for (size_t i = 0; i < one->count; i++) {
        const char *key = one->values[i].key, *its = sb_scene_values_find(other, key);
        if (!sb_scene_values_matter(key) || strcmp(key, "numerics.seed") == 0) continue;
        if (!its || strcmp(its, one->values[i].value) != 0) return false;
    }
    return true;
}

static void group_runs(sb_comparison *c)
{
    for (size_t r = 0; r < c->count; r++) {
        sb_compared_run *run = &c->runs[r];
        run->group = c->groups;
        for (size_t g = 0; g < c->groups && run->group == c->groups; g++) {
            const sb_scene_values *first = &c->runs[c->group[g].first].values;
            if (same_but_for_seed(&run->values, first) && same_but_for_seed(first, &run->values)) run->group = g;
        }
        if (run->group == c->groups) c->group[c->groups++] = (sb_compared_group){.first = r};
        c->group[run->group].count++;
    }
    for (size_t g = 0; g < c->groups; g++) {
        sb_compared_group *group = &c->group[g];
        if (group->count > 1)
            snprintf(group->label, sizeof group->label, "%s (%zu runs)", c->runs[group->first].label, group->count);
        else
            snprintf(group->label, sizeof group->label, "%s", c->runs[group->first].label);
    }
}

static void name_apart(sb_comparison *c, const char *const *directories)
{
    bool clash = false;
    for (size_t r = 0; r < c->count; r++)
        for (size_t s = 0; s < r; s++) clash |= strcmp(c->runs[r].label, c->runs[s].label) == 0;
    for (size_t r = 0; clash && r < c->count; r++)
        snprintf(c->runs[r].label, sizeof c->runs[r].label, "%.120s", directories[r]);
}

/* ---- warnings ---- */

static void warn_of(sb_comparison *c, const char *key, const char *what)
{
    const char *first = sb_scene_values_find(&c->runs[0].values, key);
    for (size_t g = 1; first && g < c->groups; g++) {
        const sb_compared_run *run = &c->runs[c->group[g].first];
        const char *other = sb_scene_values_find(&run->values, key);
        if (!other || strcmp(first, other) == 0) continue;
        sb_texts_add(&c->warnings, "%s differs: %s in %s, %s in %s. %s", key, first, c->runs[0].label, other,
                     run->label, what);
        return;
    }
}

static void warn(sb_comparison *c)
{
    warn_of(c, "resolution",
            "Part of each difference is due to the particle spacing, not to the scene: repeat at one resolution.");
    warn_of(c, "duration", "The longer run may reach later peaks, and its impulses include a longer time.");
    warn_of(c, "measure.interval", "A shorter interval gives higher peaks of an impact: compare impulses.");
    warn_of(c, "numerics.preset", "Part of each difference is due to the numerics.");
    if (c->groups == 1)
        sb_texts_add(&c->warnings, "All runs are of one scene and differ in the start seed: the page shows their "
                                   "scatter, and no differences.");
}

sb_status sb_comparison_read(const char *const *directories, size_t count, sb_comparison *comparison, sb_error *error)
{
    sb_comparison made = {0};
    if (count < 2 || count > SB_COMPARE_RUNS_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%zu run%s given: expected 2 to %d folders of runs", count,
                       count == 1 ? "" : "s", SB_COMPARE_RUNS_MAX);
    made.runs = sb_alloc(count, sizeof *made.runs);
    if (!made.runs) return sb_fail_memory(error, "a comparison");
    sb_status status = SB_OK;
    for (; made.count < count && status == SB_OK; made.count++) {
        made.runs[made.count] = (sb_compared_run){0};
        status = read_run(directories[made.count], &made.runs[made.count], error);
    }
    for (size_t r = 1; r < made.count && status == SB_OK; r++)
        for (size_t s = 0; s < r && status == SB_OK; s++) status = check_pair(&made.runs[s], &made.runs[r], error);
    if (status != SB_OK) {
        sb_comparison_free(&made);
        return status;
    }
    made.flat = made.runs[0].run.flat;
    name_apart(&made, directories);
    group_runs(&made);
    warn(&made);
    *comparison = made;
    return SB_OK;
}

void sb_comparison_free(sb_comparison *comparison)
{
    for (size_t r = 0; r < comparison->count; r++) {
        sb_loads_free(&comparison->runs[r].loads);
        sb_scene_values_free(&comparison->runs[r].values);
        sb_report_run_free(&comparison->runs[r].run);
    }
    sb_free(comparison->runs);
    sb_texts_free(&comparison->warnings);
    *comparison = (sb_comparison){0};
}
