#include "output/plots/tool.h"

#include "base/clock.h"
#include "base/stop.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

bool sb_tool_find(const char *name, char path[SB_PATH_MAX])
{
    const char *at = getenv("PATH");
    while (at && *at) {
        size_t length = strcspn(at, ":");
        struct stat status;
        int written = snprintf(path, SB_PATH_MAX, "%.*s/%s", (int)length, at, name);
        /* The tool is started in another directory, where a relative path would mean another file. */
        if (*at == '/' && written < SB_PATH_MAX && access(path, X_OK) == 0 && stat(path, &status) == 0 &&
            S_ISREG(status.st_mode))
            return true;
        at += length + (at[length] == ':');
    }
    return false;
}

/* Copies the last non-empty line of the stream, cut to `size`. */
static void last_line(FILE *stream, char *line, size_t size)
{
    char buffer[512];
    line[0] = '\0';
    rewind(stream);
    while (fgets(buffer, sizeof buffer, stream)) {
        buffer[strcspn(buffer, "\r\n")] = '\0';
        if (buffer[strspn(buffer, " \t")]) snprintf(line, size, "%.255s", buffer);
    }
}

static int spawn(const char *path, char *const *arguments, const char *folder, int output, pid_t *child)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, defaults;
    sigemptyset(&none);
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGINT);
    sigaddset(&defaults, SIGTERM);
    sigaddset(&defaults, SIGPIPE);
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    int result = posix_spawn_file_actions_addchdir_np(&actions, folder);
    if (result == 0) result = posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    if (result == 0) result = posix_spawn_file_actions_adddup2(&actions, output, 1);
    if (result == 0) result = posix_spawn_file_actions_adddup2(&actions, output, 2);
    if (result == 0) result = posix_spawn(child, path, &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return result;
}

/* How long a tool may continue after a request to stop the run. */
static const double GRACE = 5; /* s */

/* Waits for the child's end, and kills it when GRACE has passed. False: its exit status was collected elsewhere. */
static bool wait_for(pid_t child, int *ended)
{
    const struct timespec pause = {0, 10000000};
    double requested = 0;
    for (pid_t found; (found = waitpid(child, ended, WNOHANG)) != child;) {
        if (found < 0 && errno != EINTR) return false;
        if (sb_stop_signal() && !(requested > 0)) requested = sb_clock();
        if (requested > 0 && sb_clock() > requested + GRACE) kill(-child, SIGKILL);
        nanosleep(&pause, NULL);
    }
    return true;
}

sb_status sb_tool_run(const char *path, char *const *arguments, const char *folder, sb_error *error)
{
    FILE *output = tmpfile();
    if (!output)
        return sb_fail(error, SB_FAILED, "%s: cannot create a temporary file: %s", arguments[0], strerror(errno));
    pid_t child;
    int result = spawn(path, arguments, folder, fileno(output), &child);
    if (result != 0) {
        fclose(output);
        return sb_fail(error, SB_FAILED, "%s: cannot start: %s", arguments[0], strerror(result));
    }
    int ended = 0;
    sb_status status = SB_OK;
    if (!wait_for(child, &ended)) {
        status = sb_fail(error, SB_FAILED, "%s: its exit status is not known", arguments[0]);
    } else if (!WIFEXITED(ended) || WEXITSTATUS(ended) != 0) {
        char line[256];
        last_line(output, line, sizeof line);
        status =
            sb_fail(error, SB_FAILED, "%s: ended with %s %d: %s", arguments[0], WIFEXITED(ended) ? "status" : "signal",
                    WIFEXITED(ended) ? WEXITSTATUS(ended) : WTERMSIG(ended), line);
    }
    fclose(output);
    return status;
}
