#include "process.h"

#include "base/clock.h"
#include "base/stop.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const double LONGEST_PAUSE = 0.01; /* s */

void sb_process_add(sb_process *p, ...)
{
    va_list arguments;
    va_start(arguments, p);
    for (const char *next; (next = va_arg(arguments, const char *));)
        if (p->argument_count + 1 < SB_PROCESS_ARGUMENTS) p->arguments[p->argument_count++] = next;
    va_end(arguments);
}

void sb_process_shorebreak(sb_process *p, const char *program, const char *scene, const char *out)
{
    p->program = program;
    sb_process_add(p, "shorebreak", "run", scene, "--quiet", "--out", out, NULL);
}

void sb_process_set(sb_process *p, const char *const *settings, size_t count)
{
    for (size_t i = 0; i < count; i++) sb_process_add(p, "--set", settings[i], NULL);
}

static void redirect(const char *path, int flags, int to)
{
    const int file = open(path, flags, 0644);
    if (file < 0 || dup2(file, to) < 0) _exit(126);
    close(file);
}

static _Noreturn void child(const sb_process *p)
{
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGPIPE, SIG_DFL);
    signal(SIGXFSZ, SIG_DFL);
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(p->output, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    dup2(STDOUT_FILENO, STDERR_FILENO);
    close_range(STDERR_FILENO + 1, ~0U, 0); /* it must not inherit sockets and files */
    prctl(PR_SET_PDEATHSIG, p->death_signal);
    if (p->prepare) p->prepare();
    if (p->work) {
        const int status = p->work(p->context);
        fflush(NULL);
        _exit(status);
    }
    execv(p->program, (char **)p->arguments);
    _exit(127);
}

sb_status sb_process_start(sb_process *p, sb_error *error)
{
    fflush(NULL);
    p->start = sb_clock();
    p->id = fork();
    if (p->id == 0) child(p);
    if (p->id > 0) return SB_OK;
    p->id = 0;
    return sb_fail(error, SB_FAILED, "cannot start %.400s: %s", p->program, strerror(errno));
}

void sb_process_stop(sb_process *p, int number)
{
    bool *sent = number == SIGKILL ? &p->killed : &p->stop_sent;
    if (*sent || !p->id || kill(p->id, number) != 0) return;
    *sent = true;
    if (number != SIGKILL) p->stop_time = sb_clock() - p->start;
}

/* Time (s from the start) of the next limit, and its signal. */
static double next_limit(const sb_process *p, int *number)
{
    const double limit = p->time_limit > 0 ? p->time_limit : HUGE_VAL;
    const double hung = p->stop_sent && p->grace > 0 ? p->stop_time + p->grace : HUGE_VAL;
    const double stop = !p->stop_sent && p->stop_after > 0 ? p->stop_after : HUGE_VAL;
    *number = stop < limit && stop < hung ? SIGTERM : SIGKILL;
    return p->killed ? HUGE_VAL : fmin(stop, fmin(limit, hung));
}

static double seconds(const struct timeval *time)
{
    return (double)time->tv_sec + 1e-6 * (double)time->tv_usec;
}

bool sb_process_poll(sb_process *p)
{
    struct rusage used = {0};
    int number;
    if (!p->id) return true;
    const pid_t ended = wait4(p->id, &p->how, WNOHANG, &used);
    p->wall = sb_clock() - p->start;
    if (ended == p->id || (ended < 0 && errno != EINTR)) {
        if (ended < 0) p->how = 0x7f; /* nothing is known: it counts as failed */
        p->cpu = seconds(&used.ru_utime) + seconds(&used.ru_stime);
        p->id = 0;
        return true;
    }
    if (p->wall >= next_limit(p, &number)) sb_process_stop(p, number);
    return false;
}

void sb_process_pause(const sb_process *p)
{
    int number;
    const double left = next_limit(p, &number) - (sb_clock() - p->start);
    if (left > 0) usleep((useconds_t)(1e6 * fmin(left, LONGEST_PAUSE)));
}

void sb_process_wait(sb_process *p)
{
    while (!sb_process_poll(p)) {
        if (sb_stop_signal()) sb_process_stop(p, SIGTERM);
        sb_process_pause(p);
    }
}

int sb_process_status(const sb_process *p)
{
    return WIFEXITED(p->how) ? WEXITSTATUS(p->how) : -1;
}

void sb_process_last_line(const sb_process *p, const char *none, char *text, size_t size)
{
    static const char warning[] = "shorebreak: warning:";
    char line[512];
    bool any = false;
    snprintf(text, size, "%s", none);
    FILE *in = fopen(p->output, "r");
    while (in && fgets(line, sizeof line, in)) {
        line[strcspn(line, "\r\n")] = '\0';
        const bool warns = strncmp(line, warning, sizeof warning - 1) == 0;
        if (!line[0] || (warns && any)) continue;
        snprintf(text, size, "%s", line);
        any = !warns;
    }
    if (in) fclose(in);
}

void sb_process_reason(const sb_process *p, const char *between, const char *none, char *text, size_t size)
{
    char last[512];
    sb_process_last_line(p, none, last, sizeof last);
    if (WIFEXITED(p->how))
        snprintf(text, size, "status %d%s%s", WEXITSTATUS(p->how), between, last);
    else
        snprintf(text, size, "signal %d%s%s", WTERMSIG(p->how), between, last);
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

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)kind;
    (void)where;
    return remove(path);
}

sb_status sb_folder_remove(const char *folder, sb_error *error)
{
    if (access(folder, F_OK) == 0 && nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS) != 0)
        return sb_fail(error, SB_FAILED, "%.400s: %s", folder, strerror(errno));
    return SB_OK;
}

sb_status sb_process_beside(const char *name, char path[SB_PATH_MAX], sb_error *error)
{
    char own[SB_PATH_MAX], folder[SB_PATH_MAX];
    if (!realpath("/proc/self/exe", own))
        return sb_fail(error, SB_FAILED, "cannot find the path of this program: %s", strerror(errno));
    sb_path_folder(folder, own);
    return name ? sb_path_join(path, folder, name, error) : sb_path_join(path, "", own, error);
}
