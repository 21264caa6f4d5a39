#include "program.h"

#include "process.h"

#include "base/stop.h"

#include <errno.h>
#include <ftw.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

static int remove_one(const char *path, const struct stat *status, int kind, struct FTW *place)
{
    (void)status;
    (void)kind;
    (void)place;
    return remove(path);
}

/* Waits for the end of the process; a signal to stop is passed on, in case only this process got it. False: the exit
   status is unknown. */
static bool wait_for(pid_t process, int *ended)
{
    bool signalled = false;
    for (pid_t found; (found = waitpid(process, ended, WNOHANG)) != process;) {
        if (found < 0 && errno != EINTR) return false;
        if (sb_stop_signal() && !signalled) signalled = kill(process, SIGTERM) == 0;
        usleep(10000);
    }
    return true;
}

static sb_status start_and_wait(const char *program, const char *const *arguments, const char *folder, sb_error *error)
{
    char output[SB_PATH_MAX], how[32], last_line[400];
    pid_t process;
    sb_status status = sb_path_join(output, folder, "output.txt", error);
    if (status == SB_OK) status = sb_process_start(program, arguments, output, SIGTERM, &process, error);
    if (status != SB_OK) return status;
    int ended = 0;
    const bool known = wait_for(process, &ended);
    if (sb_stop_signal()) return sb_stop_fail(error, "while shorebreak was running");
    if (known && WIFEXITED(ended) && WEXITSTATUS(ended) == 0) return SB_OK;
    sb_process_describe(ended, how);
    sb_process_last_line(output, "no output", last_line, sizeof last_line);
    return sb_fail(error, SB_FAILED, "%.400s: ended with %s: %s", program, how, last_line);
}

static sb_status run_in(const sb_bench_program *run, const char *folder, sb_error *error)
{
    static const char *const quiet[] = {"render.interval=0", "output.plots=false", "output.particle_interval=0"};
    char program[SB_PATH_MAX], threads[16], out[SB_PATH_MAX];
    const char *arguments[64];
    int count = 0;
    sb_status status = sb_process_beside("shorebreak", program, error);
    if (status == SB_OK) status = sb_path_join(out, folder, "run", error);
    if (status != SB_OK) return status;
    snprintf(threads, sizeof threads, "%d", run->threads);
    const char *const first[] = {program, "run", run->scene, "--quiet", "--out", out, "--threads", threads};
    for (size_t i = 0; i < sizeof first / sizeof first[0]; i++) arguments[count++] = first[i];
    for (size_t i = 0; i < sizeof quiet / sizeof quiet[0]; i++) {
        arguments[count++] = "--set";
        arguments[count++] = quiet[i];
    }
    for (size_t i = 0; i < SB_BENCH_SETTINGS_MAX && run->settings[i]; i++) {
        arguments[count++] = "--set";
        arguments[count++] = run->settings[i];
    }
    if (run->preset) {
        arguments[count++] = "--preset";
        arguments[count++] = run->preset;
    }
    arguments[count] = NULL;
    return start_and_wait(program, arguments, folder, error);
}

sb_status sb_bench_program_run(const sb_bench_program *run, char **summary, sb_error *error)
{
    char path[SB_PATH_MAX], folder[] = "/tmp/shorebreak-bench-XXXXXX";
    size_t length;
    if (!mkdtemp(folder)) return sb_fail(error, SB_FAILED, "%s: cannot make a folder", folder);
    sb_status status = run_in(run, folder, error);
    if (status == SB_OK) status = sb_path_join(path, folder, "run/summary.json", error);
    if (status == SB_OK) status = sb_file_read(path, (size_t)1 << 26, summary, &length, error);
    nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
    return status;
}
