#include "round.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/random.h"
#include "process.h"

#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

/* The output of the run goes to <out>.txt. */
static void output_path(const sb_kill_run *run, char path[SB_PATH_MAX])
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
    char output[SB_PATH_MAX];
    output_path(run, output);
    return sb_process_start(run->program, arguments, output, SIGKILL, process, error);
}

static sb_status fail_run(const sb_kill_run *run, int how, sb_error *error)
{
    char ended[32], path[SB_PATH_MAX], last_line[512];
    output_path(run, path);
    sb_process_describe(how, ended);
    sb_process_last_line(path, "", last_line, sizeof last_line);
    return sb_fail(error, SB_FAILED, "%.300s: ended with %s: %.400s", run->out, ended, last_line);
}

/* Starts the run and kills it after `seconds`. *killed: it had not ended before. */
static sb_status watch(const sb_kill_run *run, double seconds, bool *killed, sb_error *error)
{
    pid_t process;
    int how = 0;
    sb_status status = start(run, &process, error);
    if (status != SB_OK) return status;
    const double deadline = sb_clock() + seconds;
    while (sb_clock() < deadline) {
        if (waitpid(process, &how, WNOHANG) == process) {
            *killed = false;
            return WIFEXITED(how) && WEXITSTATUS(how) == 0 ? SB_OK : fail_run(run, how, error);
        }
        const double left = deadline - sb_clock();
        usleep(left > 0.002 ? 1000 : left > 0 ? (useconds_t)(1e6 * left) : 0);
    }
    kill(process, SIGKILL);
    waitpid(process, &how, 0);
    *killed = WIFSIGNALED(how); /* it may have ended in between */
    return *killed || WEXITSTATUS(how) == 0 ? SB_OK : fail_run(run, how, error);
}

static const double FOREVER = 3600; /* s; a run of an hour hangs, or the scene is not suitable */

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
