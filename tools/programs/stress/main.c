/* tools/stress: runs stress cases and writes the report. */
#include "battery.h"
#include "process.h"

#include "base/memory.h"

#include <stdio.h>
#include <string.h>

enum { TRIAL_FAILED = 4 }; /* exit status */

static sb_status run_cases(const sb_trial_store *store, const sb_battery_options *o, sb_error *error)
{
    sb_trials trials[SB_STRESSES_MAX] = {{0}};
    sb_job *work = NULL;
    size_t count = 0, capacity = 0;
    sb_status status = SB_OK;
    for (size_t c = 0; c < o->count && status == SB_OK; c++) {
        trials[c].assets = store->assets;
        o->cases[c]->plan(&trials[c], o->quick);
        if (trials[c].incomplete || sb_grow((void **)&work, &capacity, count + trials[c].count, sizeof *work) != 0)
            status = sb_fail_memory(error, "trials");
        for (size_t i = 0; status == SB_OK && i < trials[c].count; i++)
            work[count++] = (sb_job){o->cases[c], &trials[c].list[i]};
    }
    if (status == SB_OK) status = sb_runner_run(store, work, count, o->jobs, error);
    for (size_t c = 0; c < o->count; c++) sb_trials_free(&trials[c]);
    sb_free(work);
    return status;
}

static bool chosen(const sb_battery_options *o, const sb_stress *of)
{
    for (size_t k = 0; k < o->count; k++)
        if (o->cases[k] == of) return true;
    return false;
}

/* Writes the report of all cases; prints and counts the failed trials of the named cases. */
static sb_status report(const sb_trial_store *store, const sb_battery_options *o, size_t *failed, sb_error *error)
{
    static sb_stress_results results[SB_STRESSES_MAX];
    char folder[SB_PATH_MAX];
    size_t count = 0;
    sb_status status = SB_OK;
    for (; status == SB_OK && sb_stresses[count] && count < SB_STRESSES_MAX; count++)
        status = sb_stress_collect(store, sb_stresses[count], o->quick, &results[count], error);
    snprintf(folder, sizeof folder, "%s", o->report ? o->report : SB_SOURCE_DIR "/docs/results");
    if (status == SB_OK && o->quick && !o->report) status = sb_path_join(folder, store->out, "quick", error);
    if (status == SB_OK) status = sb_stability_write(store, results, count, o->quick, o->command, folder, error);
    for (size_t c = 0; c < count; c++) {
        for (size_t i = 0; chosen(o, results[c].of) && results[c].judged && i < results[c].trials.count; i++)
            if (results[c].judged[i].outcome.there && results[c].judged[i].fails)
                printf("FAIL %s %s: %s\n", results[c].of->name, results[c].trials.list[i].name,
                       results[c].judged[i].why);
        if (chosen(o, results[c].of)) *failed += results[c].failed;
        sb_stress_results_free(&results[c]);
    }
    if (status == SB_OK) printf("%s/stability.md\n", folder);
    return status;
}

static sb_status stress(const sb_battery_options *o, size_t *failed, sb_error *error)
{
    static sb_trial_store store;
    char own[SB_PATH_MAX], program[SB_PATH_MAX];
    sb_status status = sb_process_beside(NULL, own, error);
    if (status == SB_OK) status = sb_process_beside("shorebreak", program, error);
    if (status == SB_OK)
        status = sb_trial_store_open(&store, o->out ? o->out : SB_SOURCE_DIR "/build/stress",
                                     o->program ? o->program : program, own, SB_SOURCE_DIR, error);
    if (status == SB_OK && !o->report_only) status = run_cases(&store, o, error);
    return status == SB_OK ? report(&store, o, failed, error) : status;
}

int main(int count, char **arguments)
{
    sb_battery_options o;
    sb_error error = {0};
    size_t failed = 0;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (count == 2 && strcmp(arguments[1], "--version") == 0) {
        printf("shorebreak-stress %s\n", SB_VERSION);
        return 0;
    }
    sb_status status = sb_battery_parse(count, arguments, &o, &error);
    if (status == SB_OK && o.help) fputs(sb_battery_help, stdout);
    for (size_t i = 0; status == SB_OK && o.list && !o.help && sb_stresses[i]; i++)
        printf("%-16s %s\n", sb_stresses[i]->name, sb_stresses[i]->title);
    if (status == SB_OK && (o.help || o.list)) return 0;
    if (status == SB_OK) status = stress(&o, &failed, &error);
    if (status != SB_OK) fprintf(stderr, "stress: %s\n", error.text);
    if (status != SB_OK) return status == SB_INTERRUPTED ? 130 : (int)status;
    return failed ? TRIAL_FAILED : 0;
}
