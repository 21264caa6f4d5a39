#include "trials.h"

#include "launch.h"
#include "process.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

const char *const sb_trial_settings[] = {"render.interval=0", "stream.enabled=false", "output.particle_interval=0",
                                         NULL};

sb_status sb_trials_make(const sb_store *store, sb_result *trials, size_t count, int jobs, bool report_only,
                         size_t *failed, sb_error *error)
{
    sb_status status = SB_OK;
    sb_request *requests = sb_alloc(count, sizeof *requests);
    if (!requests) return sb_fail_memory(error, "runs");
    size_t taken = 0;
    for (int seed = 1; taken < count; seed++)
        for (size_t i = 0; i < count; i++)
            if (trials[i].request.seed == seed) requests[taken++] = trials[i].request;
    if (!report_only) status = sb_launch(store, requests, count, jobs, failed, error);
    for (size_t i = 0; status == SB_OK && i < count; i++) sb_result_read(store, report_only, &trials[i]);
    sb_free(requests);
    return status;
}

/* Whether other programs ran at the same time, so that the run time is not reliable. */
static bool disturbed(const sb_result *trial)
{
    return trial->state == SB_RESULT_DONE && trial->run.load > (double)sysconf(_SC_NPROCESSORS_ONLN) + 0.5;
}

/* Writes label, numerics of the plan, and load of the machine. */
static void put_trial(FILE *out, const sb_result *trial)
{
    static const char numerics[] = "numerics.";
    char label[96];
    sb_request_label(&trial->request, true, label);
    fputs(label, out);
    for (const char *const *setting = trial->request.plan->settings; setting && *setting; setting++)
        if (strncmp(*setting, numerics, sizeof numerics - 1) == 0) fprintf(out, ", %s", *setting + sizeof numerics - 1);
    fprintf(out, " (load %.2g)", trial->run.load);
}

/* Writes the largest load, and the runs with a too high load. */
static void put_load(FILE *out, const sb_result *trials, size_t count)
{
    enum { NAMED = 6 };
    double most = (double)NAN;
    size_t high = 0;
    for (size_t i = 0; i < count; i++)
        if (trials[i].state == SB_RESULT_DONE) most = fmax(most, trials[i].run.load);
    if (isnan(most))
        fputs("- load of the machine: unknown\n", out);
    else
        fprintf(out, "- load of the machine: at most %.2g\n", most);
    for (size_t i = 0; i < count; i++) {
        if (!disturbed(&trials[i]) || high++ >= NAMED) continue;
        fputs(high == 1 ? "- **provisional times**, because other programs ran on the machine at the same time: "
                        : "; ",
              out);
        put_trial(out, &trials[i]);
    }
    if (high > NAMED) fprintf(out, "; and %zu more runs", high - NAMED);
    if (high) fputc('\n', out);
}

/* Writes every machine or commit of the runs once. */
static void put_all_of(FILE *out, const sb_result *trials, size_t count, bool machines)
{
    for (size_t i = 0; i < count; i++) {
        const char *own = machines ? trials[i].run.machine : trials[i].run.commit;
        bool listed = trials[i].state != SB_RESULT_DONE, first = true;
        for (size_t k = 0; k < i; k++) {
            const char *other = machines ? trials[k].run.machine : trials[k].run.commit;
            if (trials[k].state != SB_RESULT_DONE) continue;
            first = false;
            listed |= strcmp(own, other) == 0;
        }
        if (!listed) fprintf(out, "%s%s", first ? "" : "; ", own);
    }
}

void sb_trials_where(FILE *out, const sb_store *store, const sb_result *trials, size_t count)
{
    size_t done = 0;
    for (size_t i = 0; i < count; i++) done += trials[i].state == SB_RESULT_DONE;
    fputs("- machine: ", out);
    if (done) put_all_of(out, trials, count, true);
    fprintf(out, "%s\n- commit: ", done ? "" : store->machine);
    if (done) put_all_of(out, trials, count, false);
    fprintf(out, "%s\n", done ? "" : "nothing has run");
    put_load(out, trials, count);
    fputc('\n', out);
}

void sb_trials_origin(FILE *out, const sb_store *store, const sb_result *trials, size_t count, const char *command)
{
    fprintf(out, "- command: `%s`\n", command);
    sb_trials_where(out, store, trials, count);
}

bool sb_trial_problem(FILE *out, const sb_result *trial)
{
    char label[96];
    if (trial->state == SB_RESULT_DONE) return false;
    sb_request_label(&trial->request, true, label);
    fprintf(out, "- %s: %s%s\n", label, trial->state == SB_RESULT_FAILED ? "**failed**: " : "not run",
            trial->state == SB_RESULT_FAILED ? trial->problem : "");
    return true;
}

sb_status sb_trials_store(sb_store *store, const char *out, const char *program, const char *source, sb_error *error)
{
    char beside[SB_PATH_MAX];
    sb_status status = sb_process_beside("shorebreak", beside, error);
    return status == SB_OK ? sb_store_open(store, out, program ? program : beside, source, error) : status;
}
