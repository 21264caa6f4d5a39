#include "app/steering/helper.h"

#include "base/clock.h"
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static const double RESTART_SECONDS = 1; /* at least, between two starts */

enum { CHILD_PIPE = 3, ARGUMENTS = 20 };

/* The path of a program that is beside this one. */
static sb_status find_program(const char *name, char path[SB_PATH_MAX], sb_error *error)
{
    const ssize_t length = readlink("/proc/self/exe", path, SB_PATH_MAX - 64);
    char *slash = NULL;
    if (length > 0) {
        path[length] = 0;
        slash = strrchr(path, '/');
    }
    if (!slash) return sb_fail(error, SB_FAILED, "%s: this program's folder is not known", name);
    snprintf(slash + 1, (size_t)(path + SB_PATH_MAX - slash - 1), "%s", name);
    return access(path, X_OK) == 0 ? SB_OK
                                   : sb_fail(error, SB_FAILED, "%.500s: cannot be run: %s", path, strerror(errno));
}

/* The helper gets its pipe, the standard streams and nothing else; it has a process group of its own, because the run
   ends it, and not Ctrl-C. */
static int spawn(const char *path, char *const arguments[], int writing, pid_t *process)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t none, standard;
    sigemptyset(&none);
    sigfillset(&standard);
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, writing, CHILD_PIPE);
    posix_spawn_file_actions_addclosefrom_np(&files, CHILD_PIPE + 1);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &standard);
    const int refused = posix_spawn(process, path, &files, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    return refused;
}

static sb_status start(sb_helper *helper, sb_error *error)
{
    const sb_helper_setup *setup = &helper->setup;
    char path[SB_PATH_MAX], descriptor[16], run[24], counter[24], port[16];
    const char *arguments[ARGUMENTS] = {"shorebreak-live", "--command-fd", descriptor, "--run-id", run,
                                        "--counter",       counter};
    size_t count = 7;
    int ends[2];
    snprintf(descriptor, sizeof descriptor, "%d", CHILD_PIPE);
    snprintf(run, sizeof run, "%" PRId64, setup->run_id);
    snprintf(counter, sizeof counter, "%" PRId64, helper->counter);
    snprintf(port, sizeof port, "%d", setup->port);
    if (setup->port == 0) arguments[count++] = "--no-http";
    const char *const optional[][2] = {{"--port", setup->port > 0 ? port : NULL},
                                       {"--bind", setup->address},
                                       {"--url", setup->url},
                                       {"--prefix", setup->prefix},
                                       {"--token-file", setup->token_file}};
    for (size_t k = 0; k < sizeof optional / sizeof *optional; k++) {
        if (!optional[k][1] || !*optional[k][1]) continue;
        arguments[count++] = optional[k][0];
        arguments[count++] = optional[k][1];
    }
    sb_status status = find_program("shorebreak-live", path, error);
    if (status != SB_OK) return status;
    if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
        return sb_fail(error, SB_FAILED, "no pipe to shorebreak-live: %s", strerror(errno));
    const int refused = spawn(path, (char *const *)arguments, ends[1], &helper->process);
    close(ends[1]);
    if (refused) {
        close(ends[0]);
        helper->process = 0;
        return sb_fail(error, SB_FAILED, "%.500s: cannot be started: %s", path, strerror(refused));
    }
    helper->pipe = ends[0];
    helper->started = sb_clock();
    return SB_OK;
}

sb_status sb_helper_start(sb_helper *helper, const sb_helper_setup *setup, sb_error *error)
{
    *helper = (sb_helper){.setup = *setup, .pipe = -1};
    const sb_status status = start(helper, error);
    helper->on = status == SB_OK;
    return status;
}

bool sb_helper_next(sb_helper *helper, sb_command *command)
{
    while (helper->on && helper->pipe >= 0) {
        const ssize_t got = read(helper->pipe, command, sizeof *command);
        if (got < 0 && errno == EINTR) continue;
        if (got != (ssize_t)sizeof *command) return false;
        if (!sb_command_is_valid(command)) continue;
        if (command->counter > helper->counter) helper->counter = command->counter;
        return true;
    }
    return false;
}

/* Whether the helper's process has ended; collects it. */
static bool has_ended(sb_helper *helper)
{
    if (helper->process > 0 && waitpid(helper->process, NULL, WNOHANG) != 0) helper->process = 0;
    return helper->process == 0;
}

static void close_pipe(sb_helper *helper)
{
    if (helper->pipe >= 0) close(helper->pipe);
    helper->pipe = -1;
}

sb_helper_news sb_helper_watch(sb_helper *helper)
{
    if (!helper->on || !has_ended(helper)) return SB_HELPER_SAME;
    if (helper->restarts < SB_HELPER_RESTARTS && sb_clock() < helper->started + RESTART_SECONDS) return SB_HELPER_SAME;
    close_pipe(helper);
    if (helper->restarts++ < SB_HELPER_RESTARTS && start(helper, NULL) == SB_OK) return SB_HELPER_RESTARTED;
    helper->on = false;
    return SB_HELPER_LOST;
}

void sb_helper_wait(const sb_helper *helper, double seconds)
{
    /* A pipe whose writers have ended is always ready: it is then not waited for. */
    struct pollfd ready = {.fd = helper->process > 0 ? helper->pipe : -1, .events = POLLIN};
    (void)poll(&ready, 1, (int)(1e3 * seconds));
}

void sb_helper_end(sb_helper *helper)
{
    enum { POLL = 5000 }; /* us */
    if (!helper->on || helper->process == 0) return;
    const double end = sb_clock() + 1;
    kill(helper->process, SIGTERM);
    while (!has_ended(helper) && sb_clock() < end) usleep(POLL);
    if (helper->process == 0) return;
    kill(helper->process, SIGKILL);
    waitpid(helper->process, NULL, 0);
    helper->process = 0;
}

void sb_helper_close(sb_helper *helper)
{
    close_pipe(helper);
    helper->on = false;
}
