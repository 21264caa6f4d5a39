#include "store.h"

#include "base/memory.h"
#include "origin.h"
#include "process.h"
#include "record.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char failure_name[] = "failed.txt", spent_name[] = "spent.txt";

/* Whether the program was built together with this tool, so that it belongs to this source tree. */
static bool is_own(const char *program)
{
    char beside[SB_PATH_MAX], real[SB_PATH_MAX];
    return sb_process_beside("shorebreak", beside, NULL) == SB_OK && realpath(beside, real) &&
           strcmp(real, program) == 0;
}

sb_status sb_store_open(sb_store *store, const char *out, const char *program, const char *source, sb_error *error)
{
    sb_store made = {0};
    char real[SB_PATH_MAX];
    sb_status status = sb_make_directories(out, error);
    if (status != SB_OK) return status;
    if (!realpath(out, made.out)) return sb_fail(error, SB_FAILED, "%.400s: %s", out, strerror(errno));
    if (!realpath(program, made.program) || access(made.program, X_OK) != 0)
        return sb_fail(error, SB_BAD_INPUT, "%.400s: no such program", program);
    status = sb_path_join(real, source, "assets/validation", error);
    if (status != SB_OK) return status;
    if (!realpath(real, made.assets)) return sb_fail(error, SB_BAD_INPUT, "%.400s: %s", real, strerror(errno));
    status = sb_hash_file(made.program, &made.build, error);
    if (status != SB_OK) return status;
    if (is_own(made.program)) sb_origin_commit(source, made.commit);
    sb_origin_machine(made.machine);
    *store = made;
    return SB_OK;
}

sb_status sb_store_request_hash(const sb_store *store, const sb_request *request, char hash[17], sb_error *error)
{
    char scene[SB_PATH_MAX];
    uint64_t number = 0;
    sb_status status = sb_path_join(scene, store->assets, request->of->scene, error);
    if (status == SB_OK) status = sb_request_hash(request, scene, &number, error);
    if (status == SB_OK) snprintf(hash, 17, "%016" PRIx64, number);
    return status;
}

sb_status sb_store_defaults_hash(const sb_store *store, const sb_request *request, uint64_t *hash, sb_error *error)
{
    char scene[SB_PATH_MAX];
    sb_status status = sb_path_join(scene, store->assets, request->of->scene, error);
    return status == SB_OK ? sb_request_defaults_hash(request, scene, hash, error) : status;
}

/* The folder that contains the folders of all builds for a request. */
static sb_status group_folder(const sb_store *store, const sb_request *request, char folder[SB_PATH_MAX],
                              sb_error *error)
{
    char hash[17];
    sb_status status = sb_store_request_hash(store, request, hash, error);
    if (status != SB_OK) return status;
    int length = snprintf(folder, SB_PATH_MAX, "%s/runs/%s/%.6g-%s-%d-%s", store->out, request->of->name,
                          request->plan->resolution, request->paper ? "paper" : "default", request->seed, hash);
    return length < SB_PATH_MAX - 32 ? SB_OK : sb_fail(error, SB_BAD_INPUT, "%.400s: the path is too long", store->out);
}

sb_status sb_store_folder(const sb_store *store, const sb_request *request, char folder[SB_PATH_MAX], sb_error *error)
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

bool sb_store_find(const sb_store *store, const sb_request *request, bool any_build, char folder[SB_PATH_MAX])
{
    char group[SB_PATH_MAX], path[SB_PATH_MAX];
    double newest = -1;
    if (sb_store_folder(store, request, folder, NULL) != SB_OK) return false;
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

static sb_status write_text(const char *folder, const char *name, const char *text, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open_in(&file, folder, name, error);
    if (status != SB_OK) return status;
    fputs(text, file.stream);
    return sb_atomic_commit(&file, 0, error);
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

sb_status sb_store_spend(const char *folder, double cpu, sb_error *error)
{
    char text[64];
    snprintf(text, sizeof text, "cpu_s: %.6g\n", spent(folder) + cpu);
    return write_text(folder, spent_name, text, error);
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

sb_status sb_store_finish(const sb_store *store, const char *folder, double cpu, sb_error *error)
{
    char text[512], sources[64];
    double load;
    find_sources(folder, sources);
    if (getloadavg(&load, 1) != 1) load = (double)NAN;
    snprintf(text, sizeof text, "commit: %s\nmachine: %s\ncpu_s: %.6g\nload: %.3g\n",
             store->commit[0] ? store->commit : sources, store->machine, spent(folder) + cpu, load);
    return write_text(folder, SB_RECORD_NAME, text, error);
}

sb_status sb_store_forget(const char *folder, sb_error *error)
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

sb_status sb_store_fail(const char *folder, const char *reason, sb_error *error)
{
    return write_text(folder, failure_name, reason, error);
}

bool sb_store_failed(const sb_store *store, const sb_request *request, char *reason, size_t size)
{
    char folder[SB_PATH_MAX], path[SB_PATH_MAX], *text;
    size_t length;
    if (sb_store_folder(store, request, folder, NULL) != SB_OK ||
        sb_path_join(path, folder, failure_name, NULL) != SB_OK ||
        sb_file_read(path, 4096, &text, &length, NULL) != SB_OK)
        return false;
    text[strcspn(text, "\n")] = '\0';
    snprintf(reason, size, "%s", text);
    sb_free(text);
    return true;
}
