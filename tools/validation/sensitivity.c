#include "sensitivity.h"

#include "base/memory.h"
#include "launch.h"
#include "report.h"

#include <math.h>
#include <string.h>

static const double factors[] = {0.75, 1.25};
enum { FACTORS = 2 };

/* Of one case: [0] as it is, then per key and factor; a request without meaning has no case. */
typedef struct study {
    size_t count;
    sb_result *results;
} study;

static size_t key_count(void)
{
    size_t count = 0;
    while (sb_sensitivity_keys[count].key) count++;
    return count;
}

static const sb_plan *judged_plan(const sb_case *of)
{
    const sb_plan *plan = of->quick;
    while (!plan->judged && plan[1].resolution > 0) plan++;
    return plan;
}

static void want_changes(study *s, const sb_numerics *defaults)
{
    for (size_t i = 1; i < s->count; i++) {
        sb_request *request = &s->results[i].request;
        *request = s->results[0].request;
        sb_sensitivity_change(&sb_sensitivity_keys[(i - 1) / FACTORS], defaults, factors[(i - 1) % FACTORS],
                              request->change);
        if (!request->change[0]) request->of = NULL;
    }
}

/* Launches what the studies want: as it is (first), or all the changes. */
static sb_status run(const sb_store *store, const study *studies, size_t count, bool first, int jobs, size_t *failed,
                     sb_error *error)
{
    size_t room = 0, n = 0, bad = 0;
    for (size_t c = 0; c < count; c++) room += studies[c].count;
    sb_request *requests = sb_alloc(room, sizeof *requests);
    if (!requests) return sb_fail_memory(error, "runs");
    for (size_t c = 0; c < count; c++)
        for (size_t i = first ? 0 : 1; i < (first ? 1 : studies[c].count); i++)
            if (studies[c].results[i].request.of) requests[n++] = studies[c].results[i].request;
    sb_status status = sb_launch(store, requests, n, jobs, &bad, error);
    *failed += bad;
    sb_free(requests);
    return status;
}

static sb_status begin(study *s, const sb_case *of, sb_error *error)
{
    s->count = 1 + FACTORS * key_count();
    s->results = sb_alloc(s->count, sizeof *s->results);
    if (!s->results) return sb_fail_memory(error, "a study");
    s->results[0].request = (sb_request){.of = of, .plan = judged_plan(of), .quick = true, .seed = 1};
    return SB_OK;
}

static sb_status study_all(const sb_store *store, study *studies, const sb_case *const *cases, size_t count, int jobs,
                           bool report_only, size_t *failed, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t c = 0; status == SB_OK && c < count; c++) status = begin(&studies[c], cases[c], error);
    if (status == SB_OK && !report_only) status = run(store, studies, count, true, jobs, failed, error);
    for (size_t c = 0; status == SB_OK && c < count; c++) {
        sb_result *base = &studies[c].results[0];
        sb_result_read(store, report_only, base);
        if (base->state == SB_RESULT_DONE) want_changes(&studies[c], &base->run.scene.numerics);
    }
    if (status == SB_OK && !report_only) status = run(store, studies, count, false, jobs, failed, error);
    for (size_t c = 0; status == SB_OK && c < count; c++)
        for (size_t i = 1; i < studies[c].count; i++)
            if (studies[c].results[i].request.of) sb_result_read(store, report_only, &studies[c].results[i]);
    return status;
}

static void put_result(FILE *out, const sb_result *r, const char *headline)
{
    char text[48] = "–";
    const sb_figure *f = r->state == SB_RESULT_DONE ? sb_figures_find(&r->figures, headline) : NULL;
    if (r->request.of && r->state == SB_RESULT_FAILED) snprintf(text, sizeof text, "failed");
    if (f) sb_text_error(text, isnan(f->error) ? f->value : f->error, "");
    fprintf(out, " %s%s", text, f && !f->pass ? "!" : "");
}

static void put_time(FILE *out, const sb_result *r)
{
    if (r->state == SB_RESULT_DONE)
        fprintf(out, " %.3g", r->run.view.wall);
    else
        fputs(" –", out);
}

/* One table: of errors, or of run times. */
static void put_table(FILE *out, const study *studies, const sb_case *const *cases, size_t count, bool errors)
{
    fputs("| key | default |", out);
    for (size_t c = 0; c < count; c++) fprintf(out, " %s |", cases[c]->name);
    fputs("\n|---|---|", out);
    for (size_t c = 0; c < count; c++) fputs("---|", out);
    fputs("\n| (as it is) | |", out);
    for (size_t c = 0; c < count; c++) {
        if (errors)
            put_result(out, &studies[c].results[0], cases[c]->headline);
        else
            put_time(out, &studies[c].results[0]);
        fputs(" |", out);
    }
    for (size_t k = 0; k < key_count(); k++) {
        char text[64] = "";
        const sb_result *first = &studies[0].results[0];
        if (first->state == SB_RESULT_DONE)
            sb_sensitivity_text(&sb_sensitivity_keys[k], &first->run.scene.numerics, text);
        fprintf(out, "\n| %s | %s |", sb_sensitivity_keys[k].key, text);
        for (size_t c = 0; c < count; c++) {
            for (size_t f = 0; f < FACTORS; f++) {
                const sb_result *r = &studies[c].results[1 + FACTORS * k + f];
                if (f) fputs(" /", out);
                if (errors)
                    put_result(out, r, cases[c]->headline);
                else
                    put_time(out, r);
            }
            fputs(" |", out);
        }
    }
    fputs("\n\n", out);
}

static void put_all(FILE *out, const sb_store *store, const study *studies, const sb_case *const *cases, size_t count,
                    const char *command)
{
    fprintf(out,
            "# What the numeric defaults do\n\nMade by `tools/validate --sensitivity` from the "
            "quick forms of the cases: each default times 0.75 / times 1.25, all\nothers as they "
            "are. A value that would pass its key's bound stays there; – where the change has no "
            "meaning. The\ndefaults are those of the first case.\n\n- command: `%s`\n- machine: "
            "%s\n- commit: `%s`\n\n## Errors of the headline figures\n\n! marks an error beyond "
            "the reach.\n\n",
            command, store->machine, store->commit);
    put_table(out, studies, cases, count, true);
    for (size_t c = 0; c < count; c++) {
        const sb_result *r = &studies[c].results[0];
        const sb_figure *f = r->state == SB_RESULT_DONE ? sb_figures_find(&r->figures, cases[c]->headline) : NULL;
        fprintf(out, "- %s: %s", cases[c]->name, cases[c]->headline);
        if (f && isnan(f->error)) fprintf(out, ", value in %s", f->unit);
        if (f && !isnan(f->error))
            fprintf(out, ", error%s%s, reach %.4g", f->error_unit[0] ? " in " : "", f->error_unit, f->limit);
        fprintf(out, ", at %.6g m\n", r->request.plan->resolution);
    }
    fputs("\n## Run times (s)\n\n", out);
    put_table(out, studies, cases, count, false);
}

static sb_status write_report(const sb_store *store, const study *studies, const sb_case *const *cases, size_t count,
                              const char *command, const char *path, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_atomic_file file;
    sb_path_folder(folder, path);
    sb_status status = sb_make_directories(folder, error);
    if (status == SB_OK) status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    put_all(file.stream, store, studies, cases, count, command);
    return sb_atomic_commit(&file, 0, error);
}

sb_status sb_sensitivity(const sb_store *store, const sb_case *const *cases, size_t count, int jobs, bool report_only,
                         const char *command, const char *path, size_t *failed, sb_error *error)
{
    study *studies = sb_alloc(count, sizeof *studies);
    sb_status status = studies ? SB_OK : sb_fail_memory(error, "studies");
    *failed = 0;
    if (status == SB_OK) status = study_all(store, studies, cases, count, jobs, report_only, failed, error);
    if (status == SB_OK) status = write_report(store, studies, cases, count, command, path, error);
    for (size_t c = 0; studies && c < count; c++) {
        for (size_t i = 0; studies[c].results && i < studies[c].count; i++) {
            sb_finished_free(&studies[c].results[i].run);
            sb_figures_free(&studies[c].results[i].figures);
        }
        sb_free(studies[c].results);
    }
    sb_free(studies);
    return status;
}
