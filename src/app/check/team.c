#include "app/check/team.h"

#include "base/threads.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The number of threads that was requested. Static, because OpenMP's setting is global too. */
static int requested;
static int sharing = 1; /* processes */

void sb_team_share(int processes)
{
    sharing = processes;
}

/* The processor time that a control group allows, in cores; INFINITY: no limit is known. */
static double quota_of(const char *folder)
{
    char path[512];
    double quota = 0, period = 0;
    snprintf(path, sizeof path, "%s/cpu.max", folder);
    FILE *file = fopen(path, "r");
    const bool found = file && fscanf(file, "%lf %lf", &quota, &period) == 2 && quota > 0 && period > 0;
    if (file) fclose(file);
    return found ? quota / period : (double)INFINITY;
}

/* Reads the folder of the process's group, and the top folder, which is the own group's within a container. */
static double quota_of_group(void)
{
    double quota = quota_of("/sys/fs/cgroup");
    char line[400];
    FILE *file = fopen("/proc/self/cgroup", "r");
    while (file && fgets(line, sizeof line, file)) {
        char folder[480];
        line[strcspn(line, "\n")] = '\0';
        const char *group = strstr(line, "::");
        if (!group) continue;
        snprintf(folder, sizeof folder, "/sys/fs/cgroup%s", group + 2);
        quota = fmin(quota, quota_of(folder));
    }
    if (file) fclose(file);
    return quota;
}

int sb_team_cores(void)
{
    const double cores = fmin(omp_get_num_procs(), ceil(quota_of_group())) / sharing;
    return cores > 1 ? (int)cores : 1;
}

/* Threads that the scene's outputs need in addition to the simulation's; pictures need at least one. The count is at
   least one, because processes that read meshes and draw plots count as well. */
static int count_others(const sb_scene *scene)
{
    enum { STREAM_THREADS = 2 }; /* one opens the provider, one publishes */
    const int count = (scene->output.particle_interval > 0) +
                      (scene->render.interval > 0 && scene->render.camera_count > 0) +
                      (scene->stream.enabled ? STREAM_THREADS : 0);
    return count > 0 ? count : 1;
}

void sb_team_choose(const sb_scene *scene, int threads)
{
    if (threads > 0)
        omp_set_num_threads(threads);
    else if (!getenv("OMP_NUM_THREADS"))
        omp_set_num_threads(sb_team_cores());
    requested = omp_get_max_threads();
    const int others = count_others(scene), allowed = 1 + sb_threads_allowed(requested - 1 + others) - others;
    if (allowed < requested) omp_set_num_threads(allowed > 1 ? allowed : 1);
}

void sb_team_warnings(sb_warning_visit *visit, void *context)
{
    char text[256];
    const int threads = omp_get_max_threads(), cores = sb_team_cores();
    if (threads < requested) {
        snprintf(text, sizeof text,
                 "threads: the system allows %d of %d (see ulimit -u for processes, ulimit -v for memory): the "
                 "simulation uses %d",
                 threads, requested, threads);
        visit(context, text);
    }
    if (threads > cores) {
        snprintf(text, sizeof text,
                 "threads: %d threads on %d %s wait for each other: expected --threads %d, or fewer if other programs "
                 "are running",
                 threads, cores, cores == 1 ? "core" : "cores", cores);
        visit(context, text);
    }
}
