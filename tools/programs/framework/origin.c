#include "origin.h"

#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

void sb_origin_commit(const char *source, char commit[64])
{
    int ends[2];
    snprintf(commit, 64, "unknown");
    if (pipe(ends) != 0) return;
    char *const arguments[] = {"git",     "-C",          (char *)source, "describe", "--always",
                               "--dirty", "--abbrev=10", "--exclude=*",  NULL};
    pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        if (!freopen("/dev/null", "w", stderr)) _exit(126);
        execvp("git", arguments);
        _exit(127);
    }
    close(ends[1]);
    FILE *output = fdopen(ends[0], "r");
    char line[64];
    if (output && fgets(line, sizeof line, output)) {
        line[strcspn(line, "\n")] = '\0';
        if (line[0]) snprintf(commit, 64, "%s", line);
    }
    if (output) fclose(output);
    if (child > 0) waitpid(child, NULL, 0);
}

void sb_origin_machine(char machine[128])
{
    char line[256], model[96] = "unknown processor";
    FILE *in = fopen("/proc/cpuinfo", "r");
    while (in && fgets(line, sizeof line, in)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(model, sizeof model, "%.90s", colon + 2);
        break;
    }
    if (in) fclose(in);
    snprintf(machine, 128, "%s, %d cores", model, sb_origin_cores());
}

int sb_origin_cores(void)
{
    return (int)sysconf(_SC_NPROCESSORS_ONLN);
}

double sb_origin_load(void)
{
    double load;
    return getloadavg(&load, 1) == 1 ? load : (double)NAN;
}

sb_status sb_hash_file(const char *path, uint64_t *hash, sb_error *error)
{
    char *bytes;
    size_t length;
    sb_status status = sb_file_read(path, (size_t)1 << 31, &bytes, &length, error);
    if (status != SB_OK) return status;
    *hash = sb_hash(*hash, bytes, length);
    sb_free(bytes);
    return SB_OK;
}
