/* tools/validate: runs the cases and writes the report. */
#include "cases.h"
#include "kept.h"
#include "options.h"
#include "report.h"
#include "sensitivity.h"

#include "base/memory.h"

#include <math.h>

enum { TARGETS_MISSED = 4 }; /* exit status */

/* Runs are made in three turns, so that every case has first results early. */
static int turn_of(const sb_request *request)
{
    return request->seed > 1 ? 2 : request->preset ? 1 : 0;
}

/* Whether the command line excludes this run. */
static bool is_excluded(const sb_validate_options *o, const sb_request *request)
{
    const sb_plan *coarsest = o->common.quick ? request->of->quick : request->of->full;
    if (o->spacing > 0 && fabs(request->plan->resolution - o->spacing) > 1e-6 * o->spacing) return true;
    return (o->once && turn_of(request) != 0) || (o->spacings && request->plan - coarsest >= o->spacings);
}

/* Appends the requests of a case that belong to this turn. */
static sb_status gather(const sb_case *of, const sb_validate_options *o, int turn, sb_request **all, size_t *count,
                        size_t *capacity, sb_error *error)
{
    sb_request *requests = NULL;
    size_t found = 0;
    sb_status status = sb_case_requests(of, o->common.quick, &requests, &found, error);
    for (size_t i = 0; status == SB_OK && i < found; i++) {
        if (turn_of(&requests[i]) != turn || is_excluded(o, &requests[i])) continue;
        if (sb_grow((void **)all, capacity, *count + 1, sizeof **all) != 0)
            status = sb_fail_memory(error, "runs");
        else
            (*all)[(*count)++] = requests[i];
    }
    sb_free(requests);
    return status;
}

static sb_status run_cases(sb_store *store, const sb_validate_options *o, sb_error *error)
{
    sb_request *all = NULL;
    size_t count = 0, capacity = 0;
    sb_status status = SB_OK;
    for (int turn = 0; turn < 3; turn++)
        for (size_t c = 0; status == SB_OK && c < o->cases.count; c++)
            status = gather(sb_cases[o->cases.rows[c]], o, turn, &all, &count, &capacity, error);
    if (status == SB_OK && count == 0)
        status = sb_fail(error, SB_BAD_INPUT,
                         "--spacing %g: no named case has this spacing, expected one of the report's tables (m)",
                         o->spacing);
    if (status == SB_OK) status = sb_runs_launch(store, all, count, error);
    sb_free(all);
    return status;
}

/* Writes the report of all cases, whether run now or not. *missed: judged figures of the named cases that missed. */
static sb_status report(sb_store *store, const sb_validate_options *o, size_t *missed, sb_error *error)
{
    sb_case_results results[SB_ROWS_MAX] = {{0}};
    sb_report what = {.store = store, .cases = results};
    sb_sheet former;
    sb_status status = sb_kept_open(store->report, &former, error);
    if (status != SB_OK) return status;
    for (; status == SB_OK && sb_cases[what.count]; what.count++)
        status = sb_results_collect(store, sb_cases[what.count], &former, &results[what.count], error);
    sb_sheet_free(&former);
    if (status == SB_OK) status = sb_validation_write(&what, error);
    const bool all = !o->spacings && !(o->spacing > 0); /* otherwise a partner may be left out on purpose */
    for (size_t c = 0; c < what.count; c++) {
        size_t limited, passed;
        sb_results_count(&results[c], &limited, &passed);
        if (sb_selection_has(&o->cases, c)) *missed += limited - passed + (all && sb_results_incomplete(&results[c]));
        sb_case_results_free(&results[c]);
    }
    return status;
}

static sb_status validate(const sb_validate_options *o, int *result, sb_error *error)
{
    static sb_store store;
    size_t missed = 0;
    sb_status status =
        sb_store_open(&store, &o->common, SB_SOURCE_DIR "/build/validation", "assets/validation", false, error);
    if (status == SB_OK && o->sensitivity) status = sb_sensitivity(&store, &o->cases, error);
    if (status == SB_OK && !o->sensitivity && !o->common.report_only) status = run_cases(&store, o, error);
    if (status == SB_OK && !o->sensitivity) status = report(&store, o, &missed, error);
    *result = store.failed ? SB_FAILED : missed ? TARGETS_MISSED : 0;
    return status;
}

int main(int count, char **arguments)
{
    sb_validate_options o;
    sb_error error = {0};
    int result = 0;
    sb_status status = sb_validate_parse(count, arguments, &o, &error);
    if (status == SB_OK && !o.common.answered) status = validate(&o, &result, &error);
    return sb_tool_end("validate", status, result, &error);
}
