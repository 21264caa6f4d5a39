#include "trial_store.h"

#include "base/clock.h"
#include "base/memory.h"
#include "process.h"

#include <errno.h>
#include <fcntl.h>
#include <omp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ARGUMENTS = 2 * SB_TRIAL_SETTINGS + 16, POLL = 5000 /* us */ };

static const double stop_time = 60;                  /* s that a run may take to stop after SIGTERM */
static const rlim_t address_space = (rlim_t)4 << 30; /* bytes; a trial must not exhaust the machine's memory */

typedef struct worker {
    pid_t process; /* 0: the slot is free */
    const sb_job *job;
    sb_outcome outcome;
    double start;
    bool stop_sent, killed;
} worker;

static volatile sig_atomic_t stopped_by;

static void stop(int number)
{
    stopped_by = number;
}

static void redirect(const char *path, int flags, int to)
{
    int file = open(path, flags, 0644);
    if (file < 0 || dup2(file, to) < 0) _exit(126);
    close(file);
}

/* In the child process: runs shorebreak on the trial's scene. */
static _Noreturn void run_program(const sb_trial_store *store, const sb_trial *t, const char *folder)
{
    char *arguments[ARGUMENTS], scene[SB_PATH_MAX];
    int count = 0;
    if (sb_path_join(scene, store->assets, t->scene, NULL) != SB_OK) _exit(126);
    const char *const first[] = {"shorebreak", t->kind == SB_TRIAL_CHECK ? "check" : "run", scene};
    const char *const more[] = {"--quiet", "--out", folder};
    for (int i = 0; i < 3; i++) arguments[count++] = (char *)first[i];
    for (int i = 0; i < 3 && t->kind == SB_TRIAL_RUN; i++) arguments[count++] = (char *)more[i];
    for (size_t i = 0; i < t->setting_count; i++) {
        arguments[count++] = (char *)"--set";
        arguments[count++] = (char *)t->settings[i];
    }
    arguments[count] = NULL;
    execv(store->program, arguments);
    _exit(127);
}

/* In the child process: runs the simulation step by step; the message and exit status at its end are those of
 * shorebreak. */
static _Noreturn void drive(const sb_trial_store *store, const sb_trial *t, const char *folder)
{
    sb_error error = {0};
    omp_set_num_threads(1);
    sb_status status = sb_drive_run(t, store->assets, folder, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    fflush(NULL);
    _exit((int)status);
}

static _Noreturn void child(const sb_trial_store *store, const sb_trial *t, const char *folder)
{
    char output[SB_PATH_MAX + 16];
    const struct rlimit most = {address_space, address_space}, none = {0, 0};
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    snprintf(output, sizeof output, "%s/output.txt", folder);
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(output, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    dup2(STDOUT_FILENO, STDERR_FILENO);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    setrlimit(RLIMIT_AS, &most);
    setrlimit(RLIMIT_CORE, &none);
    setenv("OMP_NUM_THREADS", "1", 1);
    setenv("OMP_WAIT_POLICY", "passive", 1);
    if (t->kind == SB_TRIAL_DRIVEN) drive(store, t, folder);
    run_program(store, t, folder);
}

static sb_status begin(const sb_trial_store *store, const sb_job *job, worker *w, sb_error *error)
{
    *w = (worker){.job = job, .start = sb_clock()};
    sb_status status = sb_trial_store_folder(store, job, w->outcome.folder, error);
    if (status == SB_OK) status = sb_trial_store_clear(w->outcome.folder, error);
    if (status == SB_OK) status = sb_process_claim(w->outcome.folder, error);
    if (status != SB_OK) return status;
    fflush(NULL);
    pid_t process = fork();
    if (process < 0) return sb_fail(error, SB_FAILED, "cannot start a trial: %s", strerror(errno));
    if (process == 0) child(store, job->trial, w->outcome.folder);
    w->process = process;
    return SB_OK;
}

/* Reads the last line that is not a warning, or else the last line. */
static void read_last_line(sb_outcome *o)
{
    char path[SB_PATH_MAX], line[512];
    bool no_warning = false;
    FILE *in = sb_path_join(path, o->folder, "output.txt", NULL) == SB_OK ? fopen(path, "r") : NULL;
    while (in && fgets(line, sizeof line, in)) {
        line[strcspn(line, "\r\n")] = '\0';
        bool warning = strncmp(line, "shorebreak: warning:", 20) == 0;
        if (!line[0] || (warning && no_warning)) continue;
        snprintf(o->last_line, sizeof o->last_line, "%.399s", line);
        no_warning = !warning;
    }
    if (in) fclose(in);
}

/* Whether SIGTERM ended the run before it had begun its log and handled signals. */
static bool stopped_early(const worker *w, int how)
{
    char path[SB_PATH_MAX], byte;
    return w->stop_sent && WIFSIGNALED(how) && WTERMSIG(how) == SIGTERM &&
           sb_path_join(path, w->outcome.folder, "run.jsonl", NULL) == SB_OK && sb_file_start(path, &byte, 1) == 0;
}

static void classify(worker *w, int how)
{
    sb_outcome *o = &w->outcome;
    const int status = WIFEXITED(how) ? WEXITSTATUS(how) : stopped_early(w, how) ? 128 + SIGTERM : -1;
    o->how = status == 0                                                                           ? SB_ENDS_WELL
             : status == SB_BAD_INPUT                                                              ? SB_ENDS_REFUSED
             : status == SB_FAILED                                                                 ? SB_ENDS_FAILED
             : w->stop_sent && !w->killed && (status == SB_INTERRUPTED || status == 128 + SIGTERM) ? SB_ENDS_STOPPED
                                                                                                   : 0;
    if (w->killed)
        snprintf(o->ended, sizeof o->ended,
                 w->stop_sent ? "hung: did not stop after SIGTERM" : "hung: time limit exceeded");
    else if (WIFEXITED(how))
        snprintf(o->ended, sizeof o->ended, "exit status %d", status);
    else
        snprintf(o->ended, sizeof o->ended, "signal %d", WTERMSIG(how));
}

static sb_status end(const sb_trial_store *store, worker *w, int how, sb_error *error)
{
    w->process = 0;
    if (stopped_by) return SB_OK;
    if (WIFEXITED(how) && WEXITSTATUS(how) >= 126 && WEXITSTATUS(how) <= 127)
        return sb_fail(error, SB_FAILED, "%.400s: cannot be started", store->program);
    w->outcome.there = true;
    w->outcome.wall = sb_clock() - w->start;
    classify(w, how);
    read_last_line(&w->outcome);
    printf("%s %s: %s, %.1f s\n", w->job->of->name, w->job->trial->name, w->outcome.ended, w->outcome.wall);
    return sb_trial_store_write(store, w->job, &w->outcome, error);
}

/* Sends SIGTERM to a run whose time is over; kills one that hangs. */
static void watch(worker *w)
{
    const double spent = sb_clock() - w->start, after = w->job->trial->stop_after;
    const bool late = spent > w->job->trial->time_limit || (w->stop_sent && after > 0 && spent > after + stop_time);
    if (stopped_by || late) {
        w->killed |= !stopped_by;
        kill(w->process, SIGKILL);
    } else if (after > 0 && spent > after && !w->stop_sent) {
        w->stop_sent = true;
        kill(w->process, SIGTERM);
    }
}

/* Checks all runs once; returns whether one has ended. */
static bool poll_once(const sb_trial_store *store, worker *workers, int jobs, sb_status *status, sb_error *error)
{
    bool ended = false;
    for (int i = 0; i < jobs; i++) {
        int how;
        if (!workers[i].process) continue;
        watch(&workers[i]);
        if (waitpid(workers[i].process, &how, WNOHANG) != workers[i].process) continue;
        sb_status kept = end(store, &workers[i], how, *status == SB_OK ? error : NULL);
        if (*status == SB_OK) *status = kept;
        ended = true;
    }
    return ended;
}

static int find_place(const worker *workers, int jobs, bool busy)
{
    for (int i = 0; i < jobs; i++)
        if ((workers[i].process != 0) == busy) return i;
    return -1;
}

sb_status sb_runner_run(const sb_trial_store *store, const sb_job *work, size_t count, int jobs, sb_error *error)
{
    struct sigaction now = {.sa_handler = stop}, interrupt, terminate;
    worker *workers = sb_alloc((size_t)jobs, sizeof *workers);
    if (!workers) return sb_fail_memory(error, "trials");
    stopped_by = 0;
    sigaction(SIGINT, &now, &interrupt);
    sigaction(SIGTERM, &now, &terminate);
    sb_status status = SB_OK;
    for (size_t i = 0; i < count && status == SB_OK && !stopped_by; i++) {
        if (sb_trial_store_has(store, &work[i])) continue;
        int place;
        while ((place = find_place(workers, jobs, false)) < 0)
            if (!poll_once(store, workers, jobs, &status, error)) usleep(POLL);
        if (status == SB_OK && !stopped_by) status = begin(store, &work[i], &workers[place], error);
    }
    while (find_place(workers, jobs, true) >= 0)
        if (!poll_once(store, workers, jobs, &status, error)) usleep(POLL);
    sigaction(SIGINT, &interrupt, NULL);
    sigaction(SIGTERM, &terminate, NULL);
    sb_free(workers);
    if (status == SB_OK && stopped_by)
        status = sb_fail(error, SB_INTERRUPTED, "stopped; the same command continues from here");
    return status;
}
