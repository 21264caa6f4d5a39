/* tools/study: a resolution study of any scene. */
#include "quantity.h"
#include "study_report.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* The scene as a case, with a plan per spacing. */
typedef struct subject {
    char scene[SB_PATH_MAX], name[SB_NAME_MAX], out[SB_PATH_MAX];
    sb_case of;
    sb_plan plans[SB_STUDY_LEVELS];
    const char *settings[SB_PLAIN_SETTINGS + SB_STUDY_SETS + 1];
    sb_result *runs;
    size_t count;
} subject;

static void name_it(subject *s)
{
    const char *slash = strrchr(s->scene, '/');
    snprintf(s->name, sizeof s->name, "%.60s", slash ? slash + 1 : s->scene);
    char *dot = strrchr(s->name, '.');
    if (dot && dot != s->name) *dot = '\0';
}

/* The requested preset, or else that of the scene. */
static sb_status find_preset(const subject *s, const sb_study_options *o, bool *paper, sb_error *error)
{
    sb_scene scene = {0};
    *paper = o->paper;
    if (o->preset) return SB_OK;
    const sb_status status = sb_scene_read(s->scene, NULL, NULL, 0, &scene, error);
    *paper = status == SB_OK && scene.numerics.preset == SB_PRESET_PAPER;
    sb_scene_free(&scene);
    return status;
}

static sb_status begin(subject *s, const sb_study_options *o, sb_error *error)
{
    bool paper;
    if (!realpath(o->scene, s->scene)) return sb_fail(error, SB_BAD_INPUT, "%.400s: no such file", o->scene);
    name_it(s);
    snprintf(s->out, sizeof s->out, "%s%s", o->common.out ? o->common.out : SB_SOURCE_DIR "/runs/study/",
             o->common.out ? "" : s->name);
    s->of = (sb_case){.name = s->name, .scene = s->scene, .evaluate = sb_quantities_of};
    for (size_t i = 0; i < SB_PLAIN_SETTINGS; i++) s->settings[i] = sb_plain_settings[i];
    for (size_t i = 0; i < o->set_count; i++) s->settings[SB_PLAIN_SETTINGS + i] = o->sets[i];
    s->count = o->spacing_count * (size_t)o->seeds;
    const sb_status status = find_preset(s, o, &paper, error);
    if (status != SB_OK) return status;
    s->runs = sb_alloc(s->count, sizeof *s->runs);
    if (!s->runs) return sb_fail_memory(error, "a study");
    for (size_t i = 0; i < s->count; i++) {
        sb_plan *plan = &s->plans[i / (size_t)o->seeds];
        *plan = (sb_plan){.resolution = o->spacings[i / (size_t)o->seeds], .settings = s->settings};
        s->runs[i].request = (sb_request){
            .of = &s->of, .plan = plan, .preset = paper ? "paper" : NULL, .seed = 1 + (int)(i % (size_t)o->seeds)};
    }
    return SB_OK;
}

static sb_status report(const subject *s, const sb_study_options *o, const sb_store *store, sb_error *error)
{
    sb_study study = {.options = o, .store = store, .runs = s->runs, .count = s->count};
    sb_status status = sb_study_rows(&study, error);
    if (status == SB_OK && !study.row_count && store->found)
        status = sb_fail(error, SB_BAD_INPUT, "%s: no measured quantity has %s", s->name,
                         o->pattern_count ? "a name that matches --quantity" : "a value");
    if (study.row_count) sb_study_table(stdout, &study);
    if (status == SB_OK) status = sb_study_write(&study, error);
    sb_study_rows_free(&study);
    return status;
}

/* Checks that the scene can be read, before anything runs. */
static sb_status check(const sb_store *store, const subject *s, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < s->count; i++)
        status = sb_run_folder(store, &s->runs[i].request, folder, error);
    return status;
}

int main(int count, char **arguments)
{
    static subject s;
    sb_study_options o;
    static sb_store store;
    sb_error error = {0};
    sb_status status = sb_study_parse(count, arguments, &o, &error);
    if (status == SB_OK && o.common.answered) return 0;
    if (status == SB_OK) status = begin(&s, &o, &error);
    if (status == SB_OK) status = sb_store_open(&store, &o.common, s.out, "assets/validation", false, &error);
    memcpy(store.report, store.out, sizeof store.report);
    if (status == SB_OK) status = check(&store, &s, &error);
    if (status == SB_OK) status = sb_runs_make(&store, s.runs, s.count, &error);
    if (status == SB_OK) status = report(&s, &o, &store, &error);
    sb_results_free(s.runs, s.count);
    sb_free(s.runs);
    return sb_tool_end("study", status, store.failed ? SB_FAILED : 0, &error);
}
