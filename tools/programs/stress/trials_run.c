#include "battery.h"
#include "runner.h"

#include <omp.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>

static const double stop_time = 60;                  /* s that a run may take to stop after SIGTERM */
static const rlim_t address_space = (rlim_t)4 << 30; /* bytes; a trial must not exhaust the machine's memory */

typedef struct battery {
    const sb_store *store;
    const sb_job *work;
    char scene[SB_PATH_MAX], folder[SB_PATH_MAX]; /* of the trial that is started */
    const sb_trial *trial;
} battery;

static bool is_stored(void *user, size_t i)
{
    const battery *b = user;
    return sb_trial_is_stored(b->store, &b->work[i]);
}

static void prepare(void)
{
    const struct rlimit most = {address_space, address_space}, none = {0, 0};
    setrlimit(RLIMIT_AS, &most);
    setrlimit(RLIMIT_CORE, &none);
    setenv("OMP_NUM_THREADS", "1", 1);
    setenv("OMP_WAIT_POLICY", "passive", 1);
}

/* In the child process: runs the simulation step by step; the message and exit status at its end are those of
 * shorebreak. */
static int drive(const void *context)
{
    const battery *b = context;
    sb_error error = {0};
    omp_set_num_threads(1);
    sb_status status = sb_drive_run(b->trial, b->store->assets, b->folder, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    return (int)status;
}

static sb_status begin(void *user, size_t i, sb_process *process, sb_error *error)
{
    battery *b = user;
    const sb_trial *t = b->trial = b->work[i].trial;
    sb_status status = sb_trial_folder(b->store, &b->work[i], b->folder, error);
    if (status == SB_OK) status = sb_folder_remove(b->folder, error);
    if (status == SB_OK) status = sb_process_claim(b->folder, error);
    if (status == SB_OK) status = sb_path_join(b->scene, b->store->assets, t->scene, error);
    if (status == SB_OK) status = sb_path_join(process->output, b->folder, "output.txt", error);
    if (status != SB_OK) return status;
    process->program = b->store->program;
    process->prepare = prepare;
    process->death_signal = SIGTERM;
    process->time_limit = t->time_limit;
    process->stop_after = t->stop_after;
    process->grace = stop_time;
    process->work = t->kind == SB_TRIAL_DRIVEN ? drive : NULL;
    process->context = b;
    if (t->kind == SB_TRIAL_CHECK)
        sb_process_add(process, "shorebreak", "check", b->scene, NULL);
    else
        sb_process_shorebreak(process, b->store->program, b->scene, b->folder);
    for (size_t k = 0; k < t->setting_count; k++) sb_process_add(process, "--set", t->settings[k], NULL);
    return SB_OK;
}

/* Whether SIGTERM ended the run before it had begun its log and handled signals. */
static bool stopped_early(const sb_process *p, const sb_outcome *o)
{
    char path[SB_PATH_MAX], byte;
    return p->stop_sent && WIFSIGNALED(p->how) && WTERMSIG(p->how) == SIGTERM &&
           sb_path_join(path, o->folder, "run.jsonl", NULL) == SB_OK && sb_file_start(path, &byte, 1) == 0;
}

static void classify(const sb_process *p, sb_outcome *o)
{
    const int status = stopped_early(p, o) ? 128 + SIGTERM : sb_process_status(p);
    const bool stopped = status == SB_INTERRUPTED || status == 128 + SIGTERM;
    o->how = status == 0                             ? SB_ENDS_WELL
             : status == SB_BAD_INPUT                ? SB_ENDS_REFUSED
             : status == SB_FAILED                   ? SB_ENDS_FAILED
             : p->stop_sent && !p->killed && stopped ? SB_ENDS_STOPPED
                                                     : 0;
    if (p->killed)
        snprintf(o->ended, sizeof o->ended,
                 p->stop_sent ? "hung: did not stop after SIGTERM" : "hung: time limit exceeded");
    else if (WIFEXITED(p->how))
        snprintf(o->ended, sizeof o->ended, "exit status %d", status);
    else
        snprintf(o->ended, sizeof o->ended, "signal %d", WTERMSIG(p->how));
}

static sb_status end(void *user, size_t i, const sb_process *process, bool stopped, sb_error *error)
{
    const battery *b = user;
    const sb_job *job = &b->work[i];
    sb_outcome o = {.there = true, .wall = process->wall};
    const int status = sb_process_status(process);
    if (stopped) return SB_OK;
    if (status >= 126 && status <= 127)
        return sb_fail(error, SB_FAILED, "%.400s: cannot be started", b->store->program);
    sb_path_folder(o.folder, process->output);
    classify(process, &o);
    sb_process_last_line(process, "", o.last_line, sizeof o.last_line);
    printf("%s %s: %s, %.1f s\n", job->of->name, job->trial->name, o.ended, o.wall);
    return sb_trial_write(b->store, job, &o, error);
}

sb_status sb_trials_run(const sb_store *store, const sb_job *work, size_t count, sb_error *error)
{
    battery b = {.store = store, .work = work};
    const sb_runner runner = {.user = &b, .stop_signal = SIGKILL, .skip = is_stored, .begin = begin, .end = end};
    return sb_runner_run(&runner, count, store->options->jobs, error);
}
