#include "round.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/random.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* What the run says goes to <out>.txt. */
static void redirect(const sb_kill_run *run)
{
    char path[SB_PATH_MAX];
    snprintf(path, sizeof path, "%.4000s.txt", run->out);
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0)
        _exit(126);
    close(file);
}

static pid_t start(const sb_kill_run *run)
{
    const char *arguments[] = {"shorebreak", "run", run->scene, "--out", run->out, "--quiet", "--resume", "--set",
                               run->pictures ? "render.interval=0.2" : "render.interval=0", NULL};
    fflush(NULL);
    pid_t process = fork();
    if (process == 0) {
        redirect(run);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        execv(run->program, (char **)(uintptr_t)arguments);
        _exit(127);
    }
    return process;
}

/* The last line that the run has said, or nothing. */
static void last_words(const sb_kill_run *run, char words[512])
{
    char path[SB_PATH_MAX], line[512];
    snprintf(path, sizeof path, "%.4000s.txt", run->out);
    FILE *file = fopen(path, "r");
    words[0] = '\0';
    while (file && fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = '\0';
        if (line[0])
            memcpy(words, line, sizeof line);
    }
    if (file)
        fclose(file);
}

/* Waits for `patience` s and then kills. *killed: it had not ended by itself. */
static sb_status watch(const sb_kill_run *run, pid_t process, double patience, bool *killed, sb_error *error)
{
    const double deadline = sb_clock() + patience;
    char words[512];
    int how = 0;
    if (process < 0)
        return sb_fail(error, SB_FAILED, "cannot start a run: %s", strerror(errno));
    while (sb_clock() < deadline) {
        if (waitpid(process, &how, WNOHANG) == process) {
            *killed = false;
            if (WIFEXITED(how) && WEXITSTATUS(how) == 0)
                return SB_OK;
            last_words(run, words);
            return sb_fail(error, SB_FAILED, "%.300s: ended with %s %d: %.400s", run->out,
                           WIFEXITED(how) ? "status" : "signal", WIFEXITED(how) ? WEXITSTATUS(how) : WTERMSIG(how),
                           words);
        }
        const double left = deadline - sb_clock();
        usleep(left > 0.002 ? 1000 : left > 0 ? (useconds_t)(1e6 * left) : 0);
    }
    kill(process, SIGKILL);
    waitpid(process, &how, 0);
    *killed = WIFSIGNALED(how); /* it may have ended in between */
    if (*killed || WEXITSTATUS(how) == 0)
        return SB_OK;
    last_words(run, words);
    return sb_fail(error, SB_FAILED, "%.300s: ended with status %d: %.400s", run->out, WEXITSTATUS(how), words);
}

static const double FOREVER = 3600; /* s: a run that takes an hour hangs, or is no scene for this */

sb_status sb_kill_none(const sb_kill_run *run, double *seconds, sb_error *error)
{
    const double begun = sb_clock();
    bool killed;
    sb_status status = watch(run, start(run), FOREVER, &killed, error);
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
        status = watch(run, start(run), moment, &killed, error);
        *kills += killed;
    }
    double seconds;
    return status == SB_OK && killed ? sb_kill_none(run, &seconds, error) : status;
}
