/* Examines a directory before a run begins there, and removes the files of an earlier run. */
#include "app/run/files.h"

#include "base/memory.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Reads the first bytes of directory/name as text and returns their number; -1 when it is not a regular file. */
static long start_of(const char *directory, const char *name, char *text, size_t size)
{
    char path[SB_PATH_MAX];
    struct stat found;
    text[0] = '\0';
    if (sb_path_join(path, directory, name, NULL) != SB_OK || lstat(path, &found) != 0 || !S_ISREG(found.st_mode))
        return -1;
    const size_t got = sb_file_start(path, text, size - 1);
    text[got] = '\0';
    return (long)got;
}

/* The only file in the directory of a run that was killed while it wrote its first file. */
static const char beginning[] = "scene.yaml.tmp";

static bool is_empty(const char *directory, char name[SB_RUN_NAME_MAX])
{
    DIR *entries = opendir(directory);
    const struct dirent *entry;
    bool empty = true;
    while (entries && empty && (entry = readdir(entries))) {
        empty = entry->d_name[0] == '.' || strcmp(entry->d_name, beginning) == 0;
        if (!empty) snprintf(name, SB_RUN_NAME_MAX, "%s", entry->d_name);
    }
    if (entries) closedir(entries);
    return empty;
}

sb_run_holds sb_run_directory_holds(const char *directory, char name[SB_RUN_NAME_MAX])
{
    char text[2048];
    name[0] = '\0';
    if (is_empty(directory, name)) return SB_HOLDS_NOTHING;
    const bool has_scene = start_of(directory, "scene.yaml", text, sizeof text) > 0 &&
                           strncmp(text, SB_SCENE_WRITTEN, strlen(SB_SCENE_WRITTEN)) == 0;
    const long log = start_of(directory, "run.jsonl", text, sizeof text);
    const bool has_log = log > 0 && strncmp(text, SB_RUN_LOG_START, strlen(SB_RUN_LOG_START)) == 0;
    if (!has_scene && !has_log) return log == 0 ? SB_HOLDS_CLAIM : SB_HOLDS_OTHERS;
    start_of(directory, "summary.json", text, sizeof text);
    return strstr(text, "\"status\": \"done\"") ? SB_HOLDS_FINISHED : SB_HOLDS_UNFINISHED;
}

/* Removes the folder of a run's file, if it is empty. */
static void remove_folder_of(const char *directory, const char *path)
{
    char folder[SB_PATH_MAX];
    sb_path_folder(folder, path);
    if (strcmp(folder, directory) != 0) (void)rmdir(folder);
}

sb_status sb_run_files_remove(const char *directory, const sb_run_files *files, sb_error *error)
{
    static const char *const folders[] = {"frames", "stills"};
    char folder[SB_PATH_MAX];
    for (size_t i = 0; i < files->count; i++)
        if (unlink(files->own[i]) != 0 && errno != ENOENT)
            return sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", files->own[i], strerror(errno));
    for (size_t i = 0; i < files->count; i++) remove_folder_of(directory, files->own[i]);
    sb_status status = SB_OK;
    for (size_t k = 0; k < sizeof folders / sizeof *folders && status == SB_OK; k++) {
        status = sb_path_join(folder, directory, folders[k], error);
        if (status == SB_OK) (void)rmdir(folder);
    }
    return status;
}

void sb_run_files_free(sb_run_files *files)
{
    for (size_t i = 0; i < files->count; i++) sb_free(files->own[i]);
    sb_free(files->own);
    *files = (sb_run_files){0};
}
