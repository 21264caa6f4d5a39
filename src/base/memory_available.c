/* Finds the available memory of the machine, of the control group (a container's limit) and of the process. */
#include "base/memory.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static const size_t unknown = SIZE_MAX;

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t machine_available(void)
{
    FILE *file = fopen("/proc/meminfo", "r");
    char line[128];
    unsigned long kilobytes = 0;
    bool found = false;
    while (file && !found && fgets(line, sizeof line, file))
        found = sscanf(line, "MemAvailable: %lu kB", &kilobytes) == 1;
    if (file) fclose(file);
    return found ? (size_t)kilobytes * 1024 : unknown;
}

/* Reads the number in a file. "max" and any other text that is not a number mean unknown. */
static size_t number_in(const char *folder, const char *name)
{
    char path[512];
    unsigned long long bytes;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    bool found = file && fscanf(file, "%llu", &bytes) == 1;
    if (file) fclose(file);
    return found ? (size_t)bytes : unknown;
}

static size_t remaining(const char *folder, const char *limit, const char *use)
{
    size_t most = number_in(folder, limit), used = number_in(folder, use);
    if (most == unknown || used == unknown) return unknown;
    return most > used ? most - used : 0;
}

/* Reads the process's own control group and the root group: within a container, the root folder is the container's own
   group. */
static size_t group_available(void)
{
    FILE *file = fopen("/proc/self/cgroup", "r");
    char line[400];
    size_t left = least(remaining("/sys/fs/cgroup", "memory.max", "memory.current"),
                        remaining("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes"));
    while (file && fgets(line, sizeof line, file)) {
        char folder[480];
        line[strcspn(line, "\n")] = '\0';
        const char *of_all = strstr(line, "::"), *of_memory = strstr(line, ":memory:");
        if (of_all) {
            snprintf(folder, sizeof folder, "/sys/fs/cgroup%s", of_all + 2);
            left = least(left, remaining(folder, "memory.max", "memory.current"));
        } else if (of_memory) {
            snprintf(folder, sizeof folder, "/sys/fs/cgroup/memory%s", of_memory + 8);
            left = least(left, remaining(folder, "memory.limit_in_bytes", "memory.usage_in_bytes"));
        }
    }
    if (file) fclose(file);
    return left;
}

static size_t process_available(void)
{
    struct rlimit limit;
    unsigned long pages = 0;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
    FILE *file = fopen("/proc/self/statm", "r");
    bool found = file && fscanf(file, "%lu", &pages) == 1;
    if (file) fclose(file);
    size_t used = found ? (size_t)pages * (size_t)sysconf(_SC_PAGESIZE) : 0;
    return limit.rlim_cur > used ? (size_t)limit.rlim_cur - used : 0;
}

size_t sb_memory_available(void)
{
    size_t left = least(machine_available(), least(group_available(), process_available()));
    return left == unknown ? 0 : left;
}
