#include "launch.h"

#include "base/clock.h"
#include "base/memory.h"
#include "process.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>

enum { ARGUMENTS = 2 * SB_SETTINGS_MAX + 16 };

typedef struct job {
    pid_t process; /* 0: the slot is free */
    const sb_request *request;
    char folder[SB_PATH_MAX];
    double start;
} job;

typedef struct launcher {
    const sb_store *store;
    job *jobs;
    int size, busy;
    size_t failed;
} launcher;

static const char output_name[] = "output.txt";

static volatile sig_atomic_t stopped_by;

static void stop(int number)
{
    stopped_by = number;
}

static sb_status start(const sb_store *store, const char *scene, job *j, bool alone, sb_error *error)
{
    const char *arguments[ARGUMENTS];
    char output[SB_PATH_MAX + 16];
    sb_settings settings;
    int count = 0;
    sb_request_settings(j->request, &settings);
    /* A run that was stopped left a checkpoint, from which it resumes. */
    const char *const first[] = {"shorebreak", "run", scene, "--quiet", "--resume", "--out", j->folder};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++) arguments[count++] = first[i];
    for (size_t i = 0; i < settings.count; i++) {
        arguments[count++] = "--set";
        arguments[count++] = settings.list[i];
    }
    arguments[count++] = "--preset";
    arguments[count++] = j->request->paper ? "paper" : "default";
    if (!alone) {
        arguments[count++] = "--threads";
        arguments[count++] = "1";
    }
    arguments[count] = NULL;
    snprintf(output, sizeof output, "%s/%s", j->folder, output_name);
    return sb_process_start(store->program, arguments, output, SIGTERM, &j->process, error);
}

/* A scene that cannot be read counts as a failed run; the others continue. */
static sb_status refuse(launcher *c, const sb_request *request, sb_error *error)
{
    char label[96];
    sb_request_label(request, true, label);
    printf("%s: failed, %s\n", label, error->text);
    c->failed++;
    *error = (sb_error){0};
    return SB_OK;
}

static sb_status begin(launcher *c, const sb_request *request, job *j, sb_error *error)
{
    char scene[SB_PATH_MAX];
    *j = (job){.request = request, .start = sb_clock()};
    sb_status status = sb_store_folder(c->store, request, j->folder, error);
    if (status == SB_BAD_INPUT) return refuse(c, request, error);
    if (status == SB_OK) status = sb_path_join(scene, c->store->assets, request->of->scene, error);
    if (status == SB_OK) status = sb_process_claim(j->folder, error);
    if (status == SB_OK) status = sb_store_forget(j->folder, error);
    if (status == SB_OK) status = start(c->store, scene, j, c->size == 1, error);
    c->busy += status == SB_OK;
    return status;
}

static double seconds(const struct timeval *time)
{
    return (double)time->tv_sec + 1e-6 * (double)time->tv_usec;
}

static sb_status end(launcher *c, job *j, int how, const struct rusage *used, sb_error *error)
{
    char label[96], path[SB_PATH_MAX], ended[32], last_line[512], reason[640];
    sb_request_label(j->request, true, label);
    j->process = 0;
    c->busy--;
    if (WIFEXITED(how) && WEXITSTATUS(how) == 0) {
        printf("%s: %.1f s\n", label, sb_clock() - j->start);
        return sb_store_finish(c->store, j->folder, seconds(&used->ru_utime) + seconds(&used->ru_stime), error);
    }
    if (stopped_by || (WIFEXITED(how) && WEXITSTATUS(how) > 128)) {
        if (!stopped_by) stopped_by = SIGINT;
        return sb_store_spend(j->folder, seconds(&used->ru_utime) + seconds(&used->ru_stime), error);
    }
    sb_status found = sb_path_join(path, j->folder, output_name, error);
    if (found != SB_OK) return found;
    sb_process_describe(how, ended);
    sb_process_last_line(path, "no output", last_line, sizeof last_line);
    snprintf(reason, sizeof reason, "%s: %s", ended, last_line);
    printf("%s: failed, %s\n", label, reason);
    c->failed++;
    return sb_store_fail(j->folder, reason, error);
}

/* Waits for one run to end. */
static sb_status wait_one(launcher *c, sb_error *error)
{
    int how, signalled = 0;
    pid_t process;
    struct rusage used = {0};
    while ((process = wait4(-1, &how, 0, &used)) < 0 && errno == EINTR)
        if (stopped_by && !signalled++)
            for (int i = 0; i < c->size; i++)
                if (c->jobs[i].process) kill(c->jobs[i].process, SIGTERM);
    for (int i = 0; i < c->size; i++)
        if (process > 0 && c->jobs[i].process == process) return end(c, &c->jobs[i], how, &used, error);
    return process < 0 ? sb_fail(error, SB_FAILED, "cannot wait for a run: %s", strerror(errno)) : SB_OK;
}

static job *free_place(launcher *c)
{
    for (int i = 0; i < c->size; i++)
        if (!c->jobs[i].process) return &c->jobs[i];
    return NULL;
}

static sb_status work(launcher *c, const sb_request *requests, size_t count, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < count && !stopped_by; i++) {
        if (sb_store_find(c->store, &requests[i], false, folder)) continue;
        while (status == SB_OK && !free_place(c)) status = wait_one(c, error);
        if (status == SB_OK && !stopped_by) status = begin(c, &requests[i], free_place(c), error);
    }
    while (c->busy && (status == SB_OK || !stopped_by)) {
        sb_status ended = wait_one(c, status == SB_OK ? error : NULL);
        if (status == SB_OK) status = ended;
        if (ended != SB_OK) break;
    }
    return status;
}

sb_status sb_launch(const sb_store *store, const sb_request *requests, size_t count, int jobs, size_t *failed,
                    sb_error *error)
{
    struct sigaction now = {.sa_handler = stop}, interrupt, terminate;
    launcher c = {.store = store, .size = jobs, .jobs = sb_alloc((size_t)jobs, sizeof(job))};
    if (!c.jobs) return sb_fail_memory(error, "runs");
    stopped_by = 0;
    sigaction(SIGINT, &now, &interrupt);
    sigaction(SIGTERM, &now, &terminate);
    sb_status status = work(&c, requests, count, error);
    sigaction(SIGINT, &interrupt, NULL);
    sigaction(SIGTERM, &terminate, NULL);
    sb_free(c.jobs);
    *failed = c.failed;
    if (status == SB_OK && stopped_by)
        status = sb_fail(error, SB_INTERRUPTED, "stopped; the same command continues from here");
    return status;
}
