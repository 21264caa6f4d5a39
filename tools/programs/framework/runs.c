#include "runs.h"

#include "base/memory.h"
#include "runner.h"

#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <string.h>

typedef struct launcher {
    sb_store *store;
    const sb_request *requests;
    char scene[SB_PATH_MAX], folder[SB_PATH_MAX]; /* of the run that is started, as its settings */
    sb_settings settings;
} launcher;

static bool is_stored(void *user, size_t i)
{
    char folder[SB_PATH_MAX];
    const launcher *l = user;
    return sb_run_find(l->store, &l->requests[i], false, folder);
}

/* A scene that cannot be read counts as a failed run; the others continue. */
static sb_status begin(void *user, size_t i, sb_process *process, sb_error *error)
{
    launcher *l = user;
    const sb_request *request = &l->requests[i];
    char *folder = l->folder, label[96];
    sb_status status = sb_run_folder(l->store, request, folder, error);
    if (status == SB_BAD_INPUT) {
        sb_request_label(request, true, label);
        printf("%s: failed, %s\n", label, error->text);
        l->store->failed++;
        *error = (sb_error){0};
        return SB_OK;
    }
    if (status == SB_OK) status = sb_path_join(l->scene, l->store->assets, request->of->scene, error);
    if (status == SB_OK) status = sb_path_join(process->output, folder, "output.txt", error);
    if (status == SB_OK) status = sb_process_claim(folder, error);
    if (status == SB_OK) status = sb_run_forget(folder, error);
    if (status != SB_OK) return status;
    sb_request_settings(request, &l->settings);
    process->death_signal = SIGTERM;
    /* A run that was stopped left a checkpoint, from which it resumes; one of a grid alone has none. */
    sb_process_shorebreak(process, l->store->program, l->scene, folder);
    sb_process_add(process, request->of->grid ? "--overwrite" : "--resume", NULL);
    sb_process_set(process, l->settings.list, l->settings.count);
    sb_process_add(process, "--preset", sb_request_preset(request), NULL);
    if (l->store->options->jobs > 1) sb_process_add(process, "--threads", "1", NULL);
    return SB_OK;
}

static sb_status end(void *user, size_t i, const sb_process *process, bool stopped, sb_error *error)
{
    launcher *l = user;
    char label[96], folder[SB_PATH_MAX], reason[640];
    const int status = sb_process_status(process);
    sb_request_label(&l->requests[i], true, label);
    sb_path_folder(folder, process->output);
    if (status == 0) {
        printf("%s: %.1f s\n", label, process->wall);
        return sb_run_finish(l->store, folder, process->cpu, error);
    }
    if (stopped || status > 128) {
        const sb_status spent = sb_run_spend(folder, process->cpu, error);
        return spent == SB_OK ? SB_INTERRUPTED : spent;
    }
    sb_process_reason(process, ": ", "no output", reason, sizeof reason);
    printf("%s: failed, %s\n", label, reason);
    l->store->failed++;
    return sb_run_fail(folder, reason, error);
}

sb_status sb_runs_launch(sb_store *store, const sb_request *requests, size_t count, sb_error *error)
{
    launcher l = {.store = store, .requests = requests};
    const sb_runner runner = {.user = &l, .stop_signal = SIGTERM, .skip = is_stored, .begin = begin, .end = end};
    return sb_runner_run(&runner, count, store->options->jobs, error);
}

/* Fills in what only the request and the record contain. */
static void complete(const sb_store *store, sb_result *r)
{
    sb_case_run *view = &r->run.view;
    sb_request_label(&r->request, false, r->run.label);
    const char *slash = strrchr(r->run.folder, '/'); /* the last part names the program (store.h) */
    snprintf(r->run.build, sizeof r->run.build, "%.16s", slash ? slash + 1 : r->run.folder);
    sb_record_text(r->run.folder, "commit", r->run.commit, sizeof r->run.commit);
    sb_record_text(r->run.folder, "machine", r->run.machine, sizeof r->run.machine);
    if (isnan(r->run.cpu)) r->run.cpu = sb_record_number(r->run.folder, "cpu_s");
    r->run.load = sb_record_number(r->run.folder, "load");
    view->of = r->request.of;
    view->assets = store->assets;
    view->preset = sb_request_preset(&r->request);
    view->seed = r->request.seed;
    view->quick = r->request.quick;
    view->judged = r->request.plan->judged;
}

void sb_result_read(sb_store *store, bool any_build, sb_result *r)
{
    char folder[SB_PATH_MAX];
    sb_error why = {0};
    r->state = SB_RESULT_NOT_RUN;
    r->request_hash[0] = '\0';
    uint64_t hash = 0;
    if (sb_request_hash(&r->request, store->assets, &hash, &why) == SB_OK)
        snprintf(r->request_hash, sizeof r->request_hash, "%016" PRIx64, hash);
    if (why.text[0] || sb_request_defaults_hash(&r->request, store->assets, &r->defaults_hash, &why) != SB_OK) {
        r->state = SB_RESULT_FAILED;
        snprintf(r->problem, sizeof r->problem, "%.600s", why.text);
        return;
    }
    /* If this program failed, figures of another program must not hide that. */
    if (sb_run_failed(store, &r->request, r->problem, sizeof r->problem)) {
        r->state = SB_RESULT_FAILED;
        return;
    }
    if (!sb_run_find(store, &r->request, any_build, folder)) return;
    sb_status status = sb_finished_read(&r->run, folder, &why);
    uint64_t meaning = 0;
    if (status == SB_OK) status = sb_scene_defaults_hash(&r->run.scene, &meaning, &why);
    if (status == SB_OK && meaning != r->defaults_hash) {
        sb_finished_free(&r->run);
        snprintf(r->problem, sizeof r->problem, " with these defaults");
        return;
    }
    if (status == SB_OK) {
        complete(store, r);
        r->request.of->evaluate(&r->run.view, &r->figures);
        status = sb_run_close(&r->run.view, &why);
        if (status == SB_OK && r->figures.error.status != SB_OK) {
            status = r->figures.error.status;
            why = r->figures.error;
        }
    }
    r->state = status == SB_OK ? SB_RESULT_DONE : SB_RESULT_FAILED;
    store->found += status == SB_OK;
    if (status != SB_OK) snprintf(r->problem, sizeof r->problem, "%.600s", why.text);
}

void sb_results_free(sb_result *results, size_t count)
{
    for (size_t i = 0; results && i < count; i++) {
        sb_finished_free(&results[i].run);
        sb_figures_free(&results[i].figures);
    }
}

sb_status sb_runs_make(sb_store *store, sb_result *results, size_t count, sb_error *error)
{
    const bool report_only = store->options->report_only;
    sb_status status = SB_OK;
    int most = 0;
    size_t taken = 0;
    sb_request *requests = sb_alloc(count, sizeof *requests);
    if (!requests) return sb_fail_memory(error, "runs");
    for (size_t i = 0; i < count; i++) most = results[i].request.seed > most ? results[i].request.seed : most;
    for (int seed = 1; seed <= most; seed++)
        for (size_t i = 0; i < count; i++)
            if (results[i].request.of && results[i].request.seed == seed) requests[taken++] = results[i].request;
    if (!report_only) status = sb_runs_launch(store, requests, taken, error);
    for (size_t i = 0; status == SB_OK && i < count; i++)
        if (results[i].request.of) sb_result_read(store, report_only, &results[i]);
    sb_free(requests);
    return status;
}
