#include "runs.h"

#include "origin.h"

#include <math.h>
#include <string.h>

const char *const sb_plain_settings[] = {"render.interval=0", "stream.enabled=false", "output.particle_interval=0",
                                         NULL};

/* Whether other programs ran at the same time, so that the run time is not reliable. */
static bool disturbed(const sb_result *result)
{
    return result->state == SB_RESULT_DONE && result->run.load > sb_origin_cores() + 0.5;
}

/* Writes label, numerics of the plan, and load of the machine. */
static void put_label(FILE *out, const sb_result *result)
{
    static const char numerics[] = "numerics.";
    char label[96];
    sb_request_label(&result->request, true, label);
    fputs(label, out);
    for (const char *const *setting = result->request.plan->settings; setting && *setting; setting++)
        if (strncmp(*setting, numerics, sizeof numerics - 1) == 0) fprintf(out, ", %s", *setting + sizeof numerics - 1);
    fprintf(out, " (load %.2g)", result->run.load);
}

/* Writes the largest load, and the runs with a too high load. */
static void put_load(FILE *out, const sb_result *results, size_t count)
{
    enum { NAMED = 6 };
    double most = (double)NAN;
    size_t high = 0;
    for (size_t i = 0; i < count; i++)
        if (results[i].state == SB_RESULT_DONE) most = fmax(most, results[i].run.load);
    if (isnan(most))
        fputs("- load of the machine: unknown\n", out);
    else
        fprintf(out, "- load of the machine: at most %.2g\n", most);
    for (size_t i = 0; i < count; i++) {
        if (!disturbed(&results[i]) || high++ >= NAMED) continue;
        fputs(high == 1 ? "- **provisional times**, because other programs ran on the machine at the same time: "
                        : "; ",
              out);
        put_label(out, &results[i]);
    }
    if (high > NAMED) fprintf(out, "; and %zu more runs", high - NAMED);
    if (high) fputc('\n', out);
}

/* Writes every machine or commit of the runs once. */
static void put_all_of(FILE *out, const sb_result *results, size_t count, bool machines)
{
    for (size_t i = 0; i < count; i++) {
        const char *own = machines ? results[i].run.machine : results[i].run.commit;
        bool listed = results[i].state != SB_RESULT_DONE, first = true;
        for (size_t k = 0; k < i; k++) {
            const char *other = machines ? results[k].run.machine : results[k].run.commit;
            if (results[k].state != SB_RESULT_DONE) continue;
            first = false;
            listed |= strcmp(own, other) == 0;
        }
        if (!listed) fprintf(out, "%s%s", first ? "" : "; ", own);
    }
}

void sb_runs_where(FILE *out, const sb_store *store, const sb_result *results, size_t count)
{
    size_t done = 0;
    for (size_t i = 0; i < count; i++) done += results[i].state == SB_RESULT_DONE;
    fputs("- machine: ", out);
    if (done) put_all_of(out, results, count, true);
    fprintf(out, "%s\n- commit: ", done ? "" : store->machine);
    if (done) put_all_of(out, results, count, false);
    fprintf(out, "%s\n", done ? "" : "nothing has run");
    put_load(out, results, count);
    fputc('\n', out);
}

void sb_runs_origin(FILE *out, const sb_store *store, const sb_result *results, size_t count)
{
    fprintf(out, "- command: `%s`\n", store->options->command);
    sb_runs_where(out, store, results, count);
}

bool sb_runs_problem(FILE *out, const sb_result *result)
{
    char label[96];
    if (result->state == SB_RESULT_DONE) return false;
    sb_request_label(&result->request, true, label);
    fprintf(out, "- %s: %s%s\n", label, result->state == SB_RESULT_FAILED ? "**failed**: " : "not run",
            result->state == SB_RESULT_FAILED ? result->problem : "");
    return true;
}
