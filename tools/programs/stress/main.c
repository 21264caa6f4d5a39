/* tools/stress: runs stress cases and writes the report. */
#include "battery.h"
#include "origin.h"

#include "base/memory.h"

#include <stdio.h>

enum { TRIAL_FAILED = 4 }; /* exit status */

typedef struct options {
    sb_common_options common;
    sb_selection cases; /* rows of sb_stresses */
} options;

static const char help[] =
    "usage: tools/stress [CASE...|--all] [OPTIONS]\n"
    "Runs stress cases, judges each trial by the rules, and writes the report stability.md.\n\n"
    "  --all            every case\n"
    "  --quick          few and cheap forms; the report goes to OUT/quick\n"
    "  --list           lists the cases\n"
    "  --report-only    runs nothing; writes the report again from stored trials\n"
    "  --out DIR        folder of stored trials (build/stress)\n"
    "  --report DIR     folder of the report (docs/results)\n"
    "  --jobs N         N trials at a time with one thread each (default: the number of cores)\n"
    "  --shorebreak F   program that runs the trials (the one built beside this tool)\n"
    "  --help, --version\n\n"
    "Trials are stored and not repeated as long as program and scene stay the same.\n"
    "Exit status: 0 all trials of the named cases pass, 1 bad input, 2 the tool itself failed, 4 a\n"
    "trial fails, 130 stopped.\n";

static const char *case_name(size_t row)
{
    return sb_stresses[row] ? sb_stresses[row]->name : NULL;
}

static void list(void)
{
    for (size_t i = 0; sb_stresses[i]; i++) printf("%-16s %s\n", sb_stresses[i]->name, sb_stresses[i]->title);
}

static sb_status parse(int count, char **arguments, options *o, sb_error *error)
{
    *o = (options){.cases = {.what = "case", .name = case_name}};
    const sb_command_line line = {.tool = "stress",
                                  .help = help,
                                  .list = list,
                                  .has = SB_HAS_ALL | SB_HAS_QUICK | SB_HAS_LIST | SB_HAS_REPORT_ONLY | SB_HAS_JOBS |
                                         SB_HAS_OUT | SB_HAS_REPORT | SB_HAS_PROGRAM,
                                  .selection = &o->cases};
    sb_status status = sb_command_line_read(&line, count, arguments, &o->common, error);
    if (status != SB_OK || o->common.answered) return status;
    if (o->common.all || (o->common.report_only && !o->cases.count)) sb_selection_all(&o->cases);
    if (!o->common.jobs) o->common.jobs = sb_origin_cores();
    return sb_selection_check(&o->cases, error);
}

static sb_status run_cases(const sb_store *store, const options *o, sb_error *error)
{
    sb_trials trials[SB_ROWS_MAX] = {{0}};
    sb_job *work = NULL;
    size_t count = 0, capacity = 0;
    sb_status status = SB_OK;
    for (size_t c = 0; c < o->cases.count && status == SB_OK; c++) {
        const sb_stress *of = sb_stresses[o->cases.rows[c]];
        trials[c].assets = store->assets;
        of->plan(&trials[c], o->common.quick);
        if (trials[c].incomplete || sb_grow((void **)&work, &capacity, count + trials[c].count, sizeof *work) != 0)
            status = sb_fail_memory(error, "trials");
        for (size_t i = 0; status == SB_OK && i < trials[c].count; i++)
            work[count++] = (sb_job){of, &trials[c].list[i]};
    }
    if (status == SB_OK) status = sb_trials_run(store, work, count, error);
    for (size_t c = 0; c < o->cases.count; c++) sb_trials_free(&trials[c]);
    sb_free(work);
    return status;
}

/* Writes the report of all cases; prints and counts the failed trials of the named cases. */
static sb_status report(sb_store *store, const options *o, size_t *failed, sb_error *error)
{
    static sb_stress_results results[SB_ROWS_MAX];
    sb_stability what = {.store = store, .cases = results};
    sb_status status = SB_OK;
    for (; status == SB_OK && sb_stresses[what.count]; what.count++)
        status = sb_stress_collect(store, sb_stresses[what.count], &results[what.count], error);
    for (size_t c = 0; status == SB_OK && c < what.count; c++) {
        const sb_stress_results *r = &results[c];
        const bool chosen = sb_selection_has(&o->cases, c);
        for (size_t i = 0; chosen && r->judged && i < r->trials.count; i++)
            if (r->judged[i].outcome.there && r->judged[i].fails)
                printf("FAIL %s %s: %s\n", r->of->name, r->trials.list[i].name, r->judged[i].why);
        if (chosen) *failed += r->failed;
    }
    if (status == SB_OK) status = sb_stability_write(&what, error);
    for (size_t c = 0; c < what.count; c++) sb_stress_results_free(&results[c]);
    return status;
}

static sb_status stress(const options *o, int *result, sb_error *error)
{
    static sb_store store;
    size_t failed = 0;
    sb_status status = sb_store_open(&store, &o->common, SB_SOURCE_DIR "/build/stress", "assets/stress", true, error);
    if (status == SB_OK && !o->common.report_only) status = run_cases(&store, o, error);
    if (status == SB_OK) status = report(&store, o, &failed, error);
    *result = failed ? TRIAL_FAILED : 0;
    return status;
}

int main(int count, char **arguments)
{
    options o;
    sb_error error = {0};
    int result = 0;
    sb_status status = parse(count, arguments, &o, &error);
    if (status == SB_OK && !o.common.answered) status = stress(&o, &result, &error);
    return sb_tool_end("stress", status, result, &error);
}
