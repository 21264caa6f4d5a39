/* tools/validate: runs the cases and writes the report. */
#include "kept.h"
#include "launch.h"
#include "options.h"
#include "process.h"
#include "report.h"
#include "sensitivity.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TARGETS_MISSED = 4 }; /* exit status */

static void list_cases(void)
{
    for (size_t i = 0; sb_cases[i]; i++) printf("%-24s %s\n", sb_cases[i]->name, sb_cases[i]->title);
}

/* Runs are made in three turns, so that every case has first results early. */
static int turn_of(const sb_request *request)
{
    return request->seed > 1 ? 2 : request->paper ? 1 : 0;
}

/* Whether the command line excludes this run. */
static bool is_excluded(const sb_validate_options *o, const sb_request *request)
{
    const sb_plan *coarsest = o->quick ? request->of->quick : request->of->full;
    if (o->spacing > 0 && fabs(request->plan->resolution - o->spacing) > 1e-6 * o->spacing) return true;
    return (o->once && turn_of(request) != 0) || (o->spacings && request->plan - coarsest >= o->spacings);
}

/* Appends the requests of a case that belong to this turn. */
static sb_status gather(const sb_case *of, const sb_validate_options *o, int turn, sb_request **all, size_t *count,
                        size_t *capacity, sb_error *error)
{
    sb_request *requests = NULL;
    size_t found = 0;
    sb_status status = sb_case_requests(of, o->quick, &requests, &found, error);
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

static sb_status run_cases(const sb_store *store, const sb_validate_options *o, size_t *failed, sb_error *error)
{
    sb_request *all = NULL;
    size_t count = 0, capacity = 0;
    sb_status status = SB_OK;
    for (int turn = 0; turn < 3; turn++)
        for (size_t c = 0; status == SB_OK && c < o->count; c++)
            status = gather(o->cases[c], o, turn, &all, &count, &capacity, error);
    if (status == SB_OK && count == 0)
        status = sb_fail(error, SB_BAD_INPUT,
                         "--spacing %g: no named case has this spacing, expected one of the report's tables (m)",
                         o->spacing);
    if (status == SB_OK) status = sb_launch(store, all, count, o->jobs, failed, error);
    sb_free(all);
    return status;
}

/* Writes the report of all cases, whether run now or not. *missed: judged figures of the named cases that missed. */
static sb_status report(const sb_store *store, const sb_validate_options *o, size_t *missed, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_case_results results[SB_CASES_MAX] = {{0}};
    size_t count = 0;
    sb_sheet former;
    snprintf(folder, sizeof folder, "%s", o->report ? o->report : SB_SOURCE_DIR "/docs/results");
    sb_status status = SB_OK;
    if (o->quick && !o->report) status = sb_path_join(folder, store->out, "quick", error);
    if (status == SB_OK) status = sb_kept_open(folder, &former, error);
    if (status != SB_OK) return status;
    for (; status == SB_OK && sb_cases[count] && count < SB_CASES_MAX; count++)
        status = sb_results_collect(store, sb_cases[count], o->quick, true, &former, &results[count], error);
    sb_sheet_free(&former);
    const sb_report what = {.store = store, .cases = results, .count = count, .command = o->command, .quick = o->quick};
    if (status == SB_OK) status = sb_report_write(&what, folder, error);
    if (status == SB_OK) printf("%s/validation.md\n", folder);
    for (size_t c = 0; c < count; c++) {
        size_t limited, passed;
        sb_results_count(&results[c], &limited, &passed);
        for (size_t k = 0; k < o->count; k++)
            if (o->cases[k] == results[c].of) *missed += limited - passed;
        sb_results_free(&results[c]);
    }
    return status;
}

static sb_status validate(const sb_validate_options *o, size_t *failed, size_t *missed, sb_error *error)
{
    sb_store store;
    char program[SB_PATH_MAX], path[SB_PATH_MAX];
    sb_status status = sb_process_beside("shorebreak", program, error);
    if (status == SB_OK)
        status = sb_store_open(&store, o->out ? o->out : SB_SOURCE_DIR "/build/validation",
                               o->program ? o->program : program, SB_SOURCE_DIR, error);
    if (status == SB_OK && o->sensitivity) {
        status = sb_path_join(path, o->report ? o->report : SB_SOURCE_DIR "/docs/results", "sensitivity.md", error);
        if (status == SB_OK)
            status =
                sb_sensitivity(&store, o->cases, o->count, o->jobs, o->report_only, o->command, path, failed, error);
        if (status == SB_OK) printf("%s\n", path);
        return status;
    }
    if (status == SB_OK && !o->report_only) status = run_cases(&store, o, failed, error);
    return status == SB_OK ? report(&store, o, missed, error) : status;
}

int main(int count, char **arguments)
{
    sb_validate_options o;
    sb_error error = {0};
    size_t failed = 0, missed = 0;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (count == 2 && strcmp(arguments[1], "--version") == 0) {
        printf("shorebreak-validate %s\n", SB_VERSION);
        return 0;
    }
    sb_status status = sb_validate_parse(count, arguments, &o, &error);
    if (status == SB_OK && (o.help || o.list)) {
        if (o.help) fputs(sb_validate_help, stdout);
        if (!o.help) list_cases();
        return 0;
    }
    if (status == SB_OK) status = validate(&o, &failed, &missed, &error);
    if (status != SB_OK) fprintf(stderr, "validate: %s\n", error.text);
    if (status != SB_OK) return status == SB_INTERRUPTED ? 130 : (int)status;
    return failed ? SB_FAILED : missed ? TARGETS_MISSED : 0;
}
