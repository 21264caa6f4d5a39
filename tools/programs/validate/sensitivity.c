#include "base/memory.h"
#include "launch.h"
#include "sensitivity_parts.h"

static const double factors[SB_SENSITIVITY_PAIR] = {0.75, 1.25};

size_t sb_sensitivity_rows(void)
{
    size_t rows = 1;
    while (sb_sensitivity_keys[rows - 1].key) rows++;
    return rows;
}

static const sb_plan *judged_plan(const sb_case *of)
{
    const sb_plan *plan = of->quick;
    while (!plan->judged && plan[1].resolution > 0) plan++;
    return plan;
}

static void add_changes(sb_sensitivity_study *s, const sb_numerics *defaults)
{
    for (size_t i = 1; i < s->count; i++) {
        const size_t row = (i - 1) / SB_SENSITIVITY_PAIR, one = (i - 1) % SB_SENSITIVITY_PAIR;
        sb_request *request = &s->results[i].request;
        *request = s->results[0].request;
        if (row == 0) {
            request->seed += 1 + (int)one;
            continue;
        }
        sb_sensitivity_change(&sb_sensitivity_keys[row - 1], defaults, factors[one], request->change);
        if (!request->change[0]) request->of = NULL;
    }
}

/* Launches the runs of the studies: those with the defaults (first), or all others. */
static sb_status run(const sb_store *store, const sb_sensitivity_study *studies, size_t count, bool first, int jobs,
                     size_t *failed, sb_error *error)
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

static sb_status begin(sb_sensitivity_study *s, const sb_case *of, sb_error *error)
{
    s->count = 1 + SB_SENSITIVITY_PAIR * sb_sensitivity_rows();
    s->results = sb_alloc(s->count, sizeof *s->results);
    if (!s->results) return sb_fail_memory(error, "a study");
    s->results[0].request = (sb_request){.of = of, .plan = judged_plan(of), .quick = true, .seed = 1};
    return SB_OK;
}

static sb_status study_all(const sb_store *store, sb_sensitivity_study *studies, const sb_case *const *cases,
                           size_t count, int jobs, bool report_only, size_t *failed, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t c = 0; status == SB_OK && c < count; c++) status = begin(&studies[c], cases[c], error);
    if (status == SB_OK && !report_only) status = run(store, studies, count, true, jobs, failed, error);
    for (size_t c = 0; status == SB_OK && c < count; c++) {
        sb_result *base = &studies[c].results[0];
        sb_result_read(store, report_only, base);
        if (base->state == SB_RESULT_DONE) add_changes(&studies[c], &base->run.scene.numerics);
    }
    if (status == SB_OK && !report_only) status = run(store, studies, count, false, jobs, failed, error);
    for (size_t c = 0; status == SB_OK && c < count; c++)
        for (size_t i = 1; i < studies[c].count; i++)
            if (studies[c].results[i].request.of) sb_result_read(store, report_only, &studies[c].results[i]);
    return status;
}

static sb_status write_report(const sb_store *store, const sb_sensitivity_study *studies, const sb_case *const *cases,
                              size_t count, const char *command, const char *path, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_atomic_file file;
    sb_path_folder(folder, path);
    sb_status status = sb_make_directories(folder, error);
    if (status == SB_OK) status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    sb_sensitivity_report(file.stream, store, studies, cases, count, command);
    return sb_atomic_commit(&file, 0, error);
}

sb_status sb_sensitivity(const sb_store *store, const sb_case *const *cases, size_t count, int jobs, bool report_only,
                         const char *command, const char *path, size_t *failed, sb_error *error)
{
    sb_sensitivity_study *studies = sb_alloc(count, sizeof *studies);
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
