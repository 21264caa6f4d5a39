#include "process.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

static void redirect(const char *path, int flags, int to)
{
    const int file = open(path, flags, 0644);
    if (file < 0 || dup2(file, to) < 0) _exit(126);
}

sb_status sb_process_start(const char *program, const char *const *arguments, const char *output,
                           int parent_death_signal, pid_t *process, sb_error *error)
{
    fflush(NULL);
    *process = fork();
    if (*process < 0) return sb_fail(error, SB_FAILED, "cannot start %.400s: %s", program, strerror(errno));
    if (*process > 0) return SB_OK;
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(output, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    dup2(STDOUT_FILENO, STDERR_FILENO);
    close_range(STDERR_FILENO + 1, ~0U, 0); /* the program must not inherit sockets and files */
    prctl(PR_SET_PDEATHSIG, parent_death_signal);
    execv(program, (char **)arguments);
    _exit(127);
}

sb_status sb_process_claim(const char *folder, sb_error *error)
{
    char path[SB_PATH_MAX];
    FILE *log = NULL;
    sb_status status = sb_make_directories(folder, error);
    if (status == SB_OK) status = sb_path_join(path, folder, "run.jsonl", error);
    if (status == SB_OK) status = sb_file_open(path, "a", &log, error);
    if (log) fclose(log);
    return status;
}

sb_status sb_process_beside(const char *name, char path[SB_PATH_MAX], sb_error *error)
{
    char own[SB_PATH_MAX], folder[SB_PATH_MAX];
    if (!realpath("/proc/self/exe", own))
        return sb_fail(error, SB_FAILED, "cannot find the path of this program: %s", strerror(errno));
    sb_path_folder(folder, own);
    return name ? sb_path_join(path, folder, name, error) : sb_path_join(path, "", own, error);
}

void sb_process_describe(int how, char text[32])
{
    const bool exited = WIFEXITED(how);
    snprintf(text, 32, "%s %d", exited ? "status" : "signal", exited ? WEXITSTATUS(how) : WTERMSIG(how));
}

void sb_process_last_line(const char *output, const char *none, char *text, size_t size)
{
    char line[512];
    snprintf(text, size, "%s", none);
    FILE *in = fopen(output, "r");
    while (in && fgets(line, sizeof line, in)) {
        line[strcspn(line, "\r\n")] = '\0';
        if (line[0]) snprintf(text, size, "%s", line);
    }
    if (in) fclose(in);
}
