#include "run_store.h"

#include "base/memory.h"
#include "origin.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char failure_name[] = "failed.txt", spent_name[] = "spent.txt";

/* The folder that contains the folders of all builds for a request. */
static sb_status group_folder(const sb_store *store, const sb_request *request, char folder[SB_PATH_MAX],
                              sb_error *error)
{
    uint64_t hash = 0;
    sb_status status = sb_request_hash(request, store->assets, &hash, error);
    if (status != SB_OK) return status;
    int length = snprintf(folder, SB_PATH_MAX, "%s/runs/%s/%.6g-%s-%d-%016" PRIx64, store->out, request->of->name,
                          request->plan->resolution, sb_request_preset(request), request->seed, hash);
    return length < SB_PATH_MAX - 32 ? SB_OK : sb_fail(error, SB_BAD_INPUT, "%.400s: the path is too long", store->out);
}

sb_status sb_run_folder(const sb_store *store, const sb_request *request, char folder[SB_PATH_MAX], sb_error *error)
{
    sb_status status = group_folder(store, request, folder, error);
    if (status != SB_OK) return status;
    size_t length = strlen(folder);
    snprintf(folder + length, SB_PATH_MAX - length, "/%016" PRIx64, store->build);
    return SB_OK;
}

/* Time at which the record in this folder was written (s); -1: none. */
static double recorded(const char *folder)
{
    char path[SB_PATH_MAX];
    struct stat info;
    if (sb_path_join(path, folder, SB_RECORD_NAME, NULL) != SB_OK || stat(path, &info) != 0) return -1;
    return (double)info.st_mtim.tv_sec + 1e-9 * (double)info.st_mtim.tv_nsec;
}

bool sb_run_find(const sb_store *store, const sb_request *request, bool any_build, char folder[SB_PATH_MAX])
{
    char group[SB_PATH_MAX], path[SB_PATH_MAX];
    double newest = -1;
    if (sb_run_folder(store, request, folder, NULL) != SB_OK) return false;
    if (recorded(folder) >= 0) return true;
    if (!any_build || group_folder(store, request, group, NULL) != SB_OK) return false;
    DIR *builds = opendir(group);
    for (struct dirent *entry; builds && (entry = readdir(builds));) {
        if (entry->d_name[0] == '.' || sb_path_join(path, group, entry->d_name, NULL) != SB_OK) continue;
        double time = recorded(path);
        if (time <= newest) continue;
        newest = time;
        snprintf(folder, SB_PATH_MAX, "%s", path);
    }
    if (builds) closedir(builds);
    return newest >= 0;
}

/* Processor time (s) of the parts of a run that were stopped. */
static double spent(const char *folder)
{
    char path[SB_PATH_MAX];
    double sum = 0;
    FILE *in = sb_path_join(path, folder, spent_name, NULL) == SB_OK ? fopen(path, "r") : NULL;
    if (in && fscanf(in, "cpu_s: %lf", &sum) != 1) sum = 0;
    if (in) fclose(in);
    return sum;
}

sb_status sb_run_spend(const char *folder, double cpu, sb_error *error)
{
    return sb_record_write(folder, spent_name, error, "cpu_s: %.6g\n", spent(folder) + cpu);
}

/* "sources 0123456789abcdef" of the program that wrote the log in this folder; "unknown": no log. */
static void find_sources(const char *folder, char text[64])
{
    char path[SB_PATH_MAX], line[4096];
    snprintf(text, 64, "unknown");
    FILE *in = sb_path_join(path, folder, "run.jsonl", NULL) == SB_OK ? fopen(path, "r") : NULL;
    while (in && fgets(line, sizeof line, in)) {
        const char *at = strstr(line, "\"event\":\"build\"") ? strstr(line, "sources ") : NULL;
        if (at) snprintf(text, 64, "%.*s", (int)strcspn(at, ",\""), at);
    }
    if (in) fclose(in);
}

sb_status sb_run_forget(const char *folder, sb_error *error)
{
    static const char *const marks[] = {SB_RECORD_NAME, failure_name};
    char path[SB_PATH_MAX];
    for (int i = 0; i < 2; i++) {
        sb_status status = sb_path_join(path, folder, marks[i], error);
        if (status != SB_OK) return status;
        if (unlink(path) != 0 && errno != ENOENT) return sb_fail(error, SB_FAILED, "%.400s: %s", path, strerror(errno));
    }
    return SB_OK;
}

sb_status sb_run_finish(const sb_store *store, const char *folder, double cpu, sb_error *error)
{
    char sources[64];
    sb_status status = sb_run_forget(folder, error);
    if (status != SB_OK) return status;
    find_sources(folder, sources);
    return sb_record_write(folder, SB_RECORD_NAME, error, "commit: %s\nmachine: %s\ncpu_s: %.6g\nload: %.3g\n",
                           store->commit[0] ? store->commit : sources, store->machine, spent(folder) + cpu,
                           sb_origin_load());
}

sb_status sb_run_fail(const char *folder, const char *reason, sb_error *error)
{
    return sb_record_write(folder, failure_name, error, "%s", reason);
}

bool sb_run_failed(const sb_store *store, const sb_request *request, char *reason, size_t size)
{
    char folder[SB_PATH_MAX], path[SB_PATH_MAX], *text;
    size_t length;
    if (sb_run_folder(store, request, folder, NULL) != SB_OK ||
        sb_path_join(path, folder, failure_name, NULL) != SB_OK ||
        sb_file_read(path, 4096, &text, &length, NULL) != SB_OK)
        return false;
    text[strcspn(text, "\n")] = '\0';
    snprintf(reason, size, "%s", text);
    sb_free(text);
    return true;
}
