#include "round.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/random.h"
#include "process.h"

#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

/* What the run says goes to <out>.txt. */
static void said_path(const sb_kill_run *run, char path[SB_PATH_MAX])
{
    snprintf(path, SB_PATH_MAX, "%.4000s.txt", run->out);
}

static sb_status start(const sb_kill_run *run, pid_t *process, sb_error *error)
{
    const char *const arguments[] = {
        "shorebreak", "run",    run->scene,
        "--out",      run->out, "--quiet",
        "--resume",   "--set",  run->pictures ? "render.interval=0.2" : "render.interval=0",
        NULL};
    char said[SB_PATH_MAX];
    said_path(run, said);
    return sb_process_start(run->program, arguments, said, SIGKILL, process, error);
}

static sb_status broken(const sb_kill_run *run, int how, sb_error *error)
{
    char ended[32], path[SB_PATH_MAX], words[512];
    said_path(run, path);
    sb_process_describe(how, ended);
    sb_process_last_words(path, "", words, sizeof words);
    return sb_fail(error, SB_FAILED, "%.300s: ended with %s: %.400s", run->out, ended, words);
}

/* Starts the run, waits for `patience` s and then kills. *killed: it had not ended by itself. */
static sb_status watch(const sb_kill_run *run, double patience, bool *killed, sb_error *error)
{
    pid_t process;
    int how = 0;
    sb_status status = start(run, &process, error);
    if (status != SB_OK) return status;
    const double deadline = sb_clock() + patience;
    while (sb_clock() < deadline) {
        if (waitpid(process, &how, WNOHANG) == process) {
            *killed = false;
            return WIFEXITED(how) && WEXITSTATUS(how) == 0 ? SB_OK : broken(run, how, error);
        }
        const double left = deadline - sb_clock();
        usleep(left > 0.002 ? 1000 : left > 0 ? (useconds_t)(1e6 * left) : 0);
    }
    kill(process, SIGKILL);
    waitpid(process, &how, 0);
    *killed = WIFSIGNALED(how); /* it may have ended in between */
    return *killed || WEXITSTATUS(how) == 0 ? SB_OK : broken(run, how, error);
}

static const double FOREVER = 3600; /* s: a run that takes an hour hangs, or is no scene for this */

sb_status sb_kill_none(const sb_kill_run *run, double *seconds, sb_error *error)
{
    const double begun = sb_clock();
    bool killed;
    sb_status status = watch(run, FOREVER, &killed, error);
    *seconds = sb_clock() - begun;
    return status == SB_OK && killed ? sb_fail(error, SB_FAILED, "%.300s: did not end within an hour", run->out)
                                     : status;
}

sb_status sb_kill_some(const sb_kill_run *run, sb_kill_moments *moments, int most, int *kills, sb_error *error)
{
    sb_status status = SB_OK;
    bool killed = true;
    for (int k = 0; status == SB_OK && killed && k < most; k++) {
        const double moment = moments->longest * sb_random(moments->seed, moments->drawn++);
        status = watch(run, moment, &killed, error);
        *kills += killed;
    }
    double seconds;
    return status == SB_OK && killed ? sb_kill_none(run, &seconds, error) : status;
}
