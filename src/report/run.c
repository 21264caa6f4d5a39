#include "report/run.h"

#include "base/memory.h"
#include "output/tables/csv_tables.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

const char *const sb_report_table_names[] = {
    [SB_REPORT_FORCES] = "forces",           [SB_REPORT_GAUGES] = "gauges", [SB_REPORT_RUNUP] = "runup",
    [SB_REPORT_OVERTOPPING] = "overtopping", [SB_REPORT_PROBES] = "probes", [SB_REPORT_ENERGY] = "energy",
};

/* Values that the page uses, the time included: of forces F and M, without their parts by pressure and friction. */
static const size_t table_columns[] = {
    [SB_REPORT_FORCES] = 7,      [SB_REPORT_GAUGES] = 3, [SB_REPORT_RUNUP] = 6,
    [SB_REPORT_OVERTOPPING] = 3, [SB_REPORT_PROBES] = 5, [SB_REPORT_ENERGY] = 19,
};

enum { SUMMARY_LIMIT = 64 << 20, LOG_LIMIT = 1 << 30, SCENE_LIMIT = 16 << 20 };

void sb_texts_add(sb_texts *list, const char *format, ...)
{
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (sb_grow((void **)&list->texts, &list->capacity, list->count + 1, sizeof *list->texts) != 0) return;
    if ((list->texts[list->count] = sb_strdup(text))) list->count++;
}

void sb_texts_free(sb_texts *list)
{
    for (size_t i = 0; i < list->count; i++) sb_free(list->texts[i]);
    sb_free(list->texts);
    *list = (sb_texts){0};
}

/* Reads a file of the run. NULL, with a note unless it is only absent and `expected` is false. */
static char *read_file(sb_report_run *run, const char *name, size_t limit, bool expected, size_t *length)
{
    char path[SB_PATH_MAX], *text = NULL;
    sb_error error = {0};
    errno = 0;
    if (sb_path_join(path, run->directory, name, &error) == SB_OK &&
        sb_text_read(path, limit, &text, length, &error) == SB_OK)
        return text;
    if (errno != ENOENT)
        sb_texts_add(&run->notes, "%s", error.text);
    else if (expected)
        sb_texts_add(&run->notes, "%s: the run has no such file", name);
    return NULL;
}

static void read_summary(sb_report_run *run)
{
    size_t length = 0;
    char *text = read_file(run, "summary.json", SUMMARY_LIMIT, true, &length);
    if (!text) return;
    json_error_t why;
    run->summary = json_loadb(text, length, JSON_REJECT_DUPLICATES, &why);
    if (!json_is_object(run->summary)) {
        sb_texts_add(&run->notes, "summary.json: line %d: %s: expected one JSON object; its values are left out",
                     run->summary ? 1 : why.line, run->summary ? "no object" : why.text);
        json_decref(run->summary);
        run->summary = NULL;
    }
    sb_free(text);
}

static void keep(json_t **place, json_t *event)
{
    json_decref(*place);
    *place = json_incref(event);
}

static void take_warning(sb_report_run *run, const char *text)
{
    for (size_t i = 0; text && i < run->warnings.count; i++)
        if (strcmp(run->warnings.texts[i], text) == 0) return;
    if (text) sb_texts_add(&run->warnings, "%s", text);
}

static void take_event(sb_report_run *run, json_t *event)
{
    const char *name = json_string_value(json_object_get(event, "event"));
    const char *text = json_string_value(json_object_get(event, "text"));
    if (!name) return;
    if (strcmp(name, "start") == 0) {
        size_t i;
        json_t *warning;
        keep(&run->start, event);
        json_array_foreach(json_object_get(event, "warnings"), i, warning)
            take_warning(run, json_string_value(warning));
    } else if (strcmp(name, "step") == 0) {
        keep(&run->step, event);
    } else if (strcmp(name, "arguments") == 0) {
        json_array_append(run->arguments, event);
    } else if (strcmp(name, "build") == 0 && text) {
        sb_free(run->build);
        run->build = sb_strdup(text);
    } else if (strcmp(name, "warning") == 0) {
        take_warning(run, text);
    }
}

/* Only lines that the page uses are parsed: a long log has very many of other kinds. Of the steps only the last one is
   used. */
static void read_log(sb_report_run *run)
{
    static const char *const used[] = {"start", "arguments", "build", "warning"};
    size_t length = 0, damaged = 0;
    char *text = read_file(run, "run.jsonl", LOG_LIMIT, true, &length), *step = NULL;
    for (char *line = text, *end; line && *line && (end = strchr(line, '\n')); line = end + 1) {
        *end = '\0';
        char begin[64];
        bool wanted = strncmp(line, "{\"event\":", 9) != 0;
        for (size_t u = 0; u < sizeof used / sizeof *used && !wanted; u++) {
            snprintf(begin, sizeof begin, "{\"event\":\"%s\",", used[u]);
            wanted = strncmp(line, begin, strlen(begin)) == 0;
        }
        if (!wanted && strncmp(line, "{\"event\":\"step\",", 16) == 0) step = line;
        if (!wanted) continue;
        json_t *event = json_loads(line, 0, NULL);
        damaged += !event;
        take_event(run, event);
        json_decref(event);
    }
    if (step) {
        json_t *event = json_loads(step, 0, NULL);
        damaged += !event;
        take_event(run, event);
        json_decref(event);
    }
    if (damaged > 0) sb_texts_add(&run->notes, "run.jsonl: %zu lines are no JSON objects and are left out", damaged);
    sb_free(text);
}

static void read_scene(sb_report_run *run)
{
    char path[SB_PATH_MAX];
    size_t length = 0;
    sb_error error = {0};
    run->scene_text = read_file(run, "scene.yaml", SCENE_LIMIT, true, &length);
    if (!run->scene_text || sb_path_join(path, run->directory, "scene.yaml", NULL) != SB_OK) return;
    run->has_scene = sb_scene_read(path, NULL, NULL, 0, &run->scene, &error) == SB_OK;
    if (!run->has_scene) sb_texts_add(&run->notes, "%s; the scene's facts are left out", error.text);
}

static void read_tables(sb_report_run *run, size_t *present)
{
    for (size_t t = 0; t < SB_REPORT_TABLES; t++) {
        char path[SB_PATH_MAX], name[32];
        sb_error error = {0};
        const bool always = t == SB_REPORT_FORCES || t == SB_REPORT_GAUGES || t == SB_REPORT_ENERGY;
        snprintf(name, sizeof name, "%s.csv", sb_report_table_names[t]);
        errno = 0;
        if (sb_path_join(path, run->directory, name, &error) == SB_OK &&
            sb_series_table_read(path, table_columns[t], t != SB_REPORT_ENERGY, &run->tables[t], &error) == SB_OK) {
            ++*present;
            if (run->tables[t].columns < table_columns[t]) {
                sb_texts_add(&run->notes, "%s: has %zu of the expected %zu columns and is left out", name,
                             run->tables[t].columns, table_columns[t]);
                sb_series_table_free(&run->tables[t]);
            } else if (run->tables[t].damaged > 0)
                sb_texts_add(&run->notes, "%s: %zu lines are damaged and are left out", name, run->tables[t].damaged);
        } else if (errno != ENOENT)
            sb_texts_add(&run->notes, "%s", error.text);
        else if (always)
            sb_texts_add(&run->notes, "%s: the run has no such file", name);
    }
    const char *column = run->tables[SB_REPORT_FORCES].names[1];
    run->flat = column && strstr(column, "_per_m");
}

sb_status sb_report_run_read(const char *directory, sb_report_run *run, sb_error *error)
{
    size_t present = 0;
    *run = (sb_report_run){.directory = directory, .arguments = json_array()};
    if (!run->arguments) return sb_fail_memory(error, "a report");
    read_summary(run);
    read_log(run);
    read_scene(run);
    read_tables(run, &present);
    if (run->summary || run->start || present > 0) return SB_OK;
    sb_report_run_free(run);
    return sb_fail(error, SB_BAD_INPUT, "%.500s: expected the folder of a run, with summary.json, run.jsonl or tables",
                   directory);
}

void sb_report_run_free(sb_report_run *run)
{
    json_decref(run->summary);
    json_decref(run->start);
    json_decref(run->step);
    json_decref(run->arguments);
    sb_free(run->build);
    sb_free(run->scene_text);
    sb_texts_free(&run->warnings);
    sb_texts_free(&run->notes);
    if (run->has_scene) sb_scene_free(&run->scene);
    for (size_t t = 0; t < SB_REPORT_TABLES; t++) sb_series_table_free(&run->tables[t]);
    *run = (sb_report_run){0};
}

const char *sb_report_text(const sb_report_run *run, const char *key)
{
    return json_string_value(json_object_get(run->summary, key));
}

const char *sb_report_status(const sb_report_run *run)
{
    static const char *const known[] = {"done", "interrupted", "failed", "running"};
    const char *status = sb_report_text(run, "status");
    for (size_t k = 0; status && k < sizeof known / sizeof *known; k++)
        if (strcmp(known[k], status) == 0) return known[k];
    return "unknown";
}

double sb_report_item_number(const json_t *item, const char *key)
{
    const json_t *value = json_object_get(item, key);
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

double sb_report_number(const sb_report_run *run, const char *key)
{
    return sb_report_item_number(run->summary, key);
}

double sb_report_reached(const sb_report_run *run)
{
    double time = sb_report_number(run, "simulated_s");
    if (isnan(time) && run->step) time = json_number_value(json_object_get(run->step, "time_s"));
    for (size_t t = 0; isnan(time) && t < SB_REPORT_TABLES; t++)
        if (run->tables[t].count > 0 && run->tables[t].series[0].rows > 0)
            time =
                sb_series_table_value(&run->tables[t], &run->tables[t].series[0], run->tables[t].series[0].rows - 1, 0);
    return time;
}
