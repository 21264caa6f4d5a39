#include "commander.h"

#include "base/clock.h"
#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const double TIMEOUT = 60; /* s, until a run takes commands */

static char output[4096];

static int send(const char *directory, const char *command)
{
    char line[2048];
    snprintf(line, sizeof line, "exec '%s/shorebreak-control' --timeout 20 '%s' %s 2>&1", SB_BINARY_DIR,
             in_folder("%s", directory), command);
    FILE *pipe = popen(line, "r");
    assert_non_null(pipe);
    output[fread(output, 1, sizeof output - 1, pipe)] = 0;
    const int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

const char *commander_send(int status, const char *directory, const char *command)
{
    const int got = send(directory, command);
    if (got != status) fail_msg("%s: exit status %d, expected %d: %s", command, got, status, output);
    return output;
}

pid_t commander_start(const char *scene, const char *directory, const char *const *options)
{
    enum { MOST = 24 };
    char prefix[64];
    const char *arguments[MOST] = {"run",     scene,   "--control", "--out", directory,
                                   "--quiet", "--set", prefix,      "--set", "control.paused=true"};
    snprintf(prefix, sizeof prefix, "stream.prefix=test-%ld", (long)getpid());
    for (size_t n = 10; *options && n + 1 < MOST; n++) arguments[n] = *options++;
    const pid_t process = program_start(arguments);
    const double end = sb_clock() + TIMEOUT;
    while (send(directory, "pause") != 0 && sb_clock() < end) {
        if (strstr(output, "multicast route")) {
            kill(process, SIGTERM);
            outcome o = program_finish(process);
            outcome_free(&o);
            skip();
        }
        if (kill(process, 0) != 0 || waitpid(process, NULL, WNOHANG) != 0) fail_msg("the run has ended: %s", output);
        usleep(20000);
    }
    return process;
}

static bool is_helper(long process)
{
    char path[64], name[32] = "";
    snprintf(path, sizeof path, "/proc/%ld/comm", process);
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%31s", name) != 1) *name = 0;
    if (file) fclose(file);
    return strcmp(name, "shorebreak-live") == 0;
}

pid_t child_of(pid_t process)
{
    char path[80];
    long child = 0;
    snprintf(path, sizeof path, "/proc/%ld/task/%ld/children", (long)process, (long)process);
    FILE *file = fopen(path, "r");
    bool found = false;
    while (file && !found && fscanf(file, "%ld", &child) == 1) found = is_helper(child);
    if (file) fclose(file);
    return found ? (pid_t)child : 0;
}

bool is_there(pid_t process)
{
    char path[64], state = 'X';
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    FILE *file = fopen(path, "r");
    if (!file) return false;
    if (fscanf(file, "%*d %*[^)]) %c", &state) != 1) state = 'X';
    fclose(file);
    return state != 'X' && state != 'Z';
}

pid_t next_helper(pid_t run, pid_t before)
{
    const double end = sb_clock() + TIMEOUT;
    pid_t helper = child_of(run);
    while ((helper == 0 || helper == before) && is_there(run) && sb_clock() < end) {
        usleep(10000);
        helper = child_of(run);
    }
    return helper == before ? 0 : helper;
}

char *event_of(const char *directory, const char *event, size_t *count)
{
    char name[80], start[80];
    snprintf(name, sizeof name, "%s/run.jsonl", directory);
    snprintf(start, sizeof start, "{\"event\":\"%s\",", event);
    char *log = text_of(name), *found = NULL;
    *count = 0;
    for (char *line = log, *next; line && *line; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = 0;
        char *text = strstr(line, "\"text\":");
        if (strncmp(line, start, strlen(start)) != 0 || !text) continue;
        sb_free(found);
        found = sb_strdup(text + strlen("\"text\":"));
        ++*count;
    }
    sb_free(log);
    return found;
}

void assert_same_hash(const char *one, const char *other)
{
    const char *const names[] = {one, other};
    char hash[2][64] = {"", ""};
    for (int i = 0; i < 2; i++) {
        char name[80];
        snprintf(name, sizeof name, "%s/summary.json", names[i]);
        char *text = text_of(name);
        const char *at = strstr(text, "\"state_hash\"");
        assert_non_null(at);
        snprintf(hash[i], sizeof hash[i], "%.35s", at);
        sb_free(text);
    }
    assert_string_equal(hash[0], hash[1]);
}
