/* What would keep a run from writing its files, found before it begins. */
#include "app/run_state.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Written before the first step, as the tables are. */
static const char *const first[] = {"scene.yaml", "run.jsonl", NULL};

/* A scene that a run wrote may be written again by it. */
static bool is_own_scene(const char *path)
{
    char line[sizeof SB_SCENE_WRITTEN] = "";
    FILE *file = fopen(path, "r");
    const bool read = file && fgets(line, sizeof line, file);
    if (file) fclose(file);
    return read && strcmp(line, SB_SCENE_WRITTEN) == 0;
}

static sb_status check_file(const run *r, const char *name, sb_error *error)
{
    char path[SB_PATH_MAX];
    struct stat found, scene;
    sb_status status = sb_run_path(r, name, path, error);
    if (status != SB_OK || lstat(path, &found) != 0) return status;
    if (!S_ISREG(found.st_mode))
        return sb_fail(error, SB_FAILED, "%.500s: is %s, expected a file of a run or nothing", path,
                       S_ISLNK(found.st_mode)   ? "a symbolic link"
                       : S_ISDIR(found.st_mode) ? "a directory"
                                                : "no regular file");
    if (r->scene->path && stat(r->scene->path, &scene) == 0 && scene.st_dev == found.st_dev &&
        scene.st_ino == found.st_ino && !is_own_scene(path))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: is the scene itself, which the run would overwrite, expected another directory by "
                       "--out",
                       path);
    return SB_OK;
}

sb_status sb_run_unobstructed(const run *r, sb_error *error)
{
    sb_status status = SB_OK;
    if (access(r->directory, W_OK | X_OK) != 0)
        return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", r->directory, strerror(errno));
    for (size_t i = 0; status == SB_OK && first[i]; i++) status = check_file(r, first[i], error);
    for (size_t i = 0; status == SB_OK && sb_csv_names[i]; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s.csv", sb_csv_names[i]);
        status = check_file(r, name, error);
    }
    return status;
}

/* A folder that is made when it has its first file, or is there already. */
static sb_status check_folder(const run *r, const char *name, sb_error *error)
{
    char path[SB_PATH_MAX];
    struct stat found;
    sb_status status = sb_run_path(r, name, path, error);
    if (status != SB_OK) return status;
    if (lstat(path, &found) != 0)
        return errno == ENOENT ? SB_OK : sb_fail(error, SB_FAILED, "%.500s: cannot read: %s", path, strerror(errno));
    if (!S_ISDIR(found.st_mode))
        return sb_fail(error, SB_FAILED, "%.500s: is %s, expected a directory of the run's own", path,
                       S_ISLNK(found.st_mode) ? "a symbolic link" : "not a directory");
    if (access(path, W_OK | X_OK) != 0)
        return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", path, strerror(errno));
    return SB_OK;
}

sb_status sb_run_folders_free(const run *r, sb_error *error)
{
    const sb_scene *scene = r->scene;
    const bool draws = scene->render.interval > 0 && scene->render.camera_count > 0;
    sb_status status = SB_OK;
    if (scene->output.particle_interval > 0) status = check_folder(r, "particles", error);
    if (status == SB_OK && scene->measure.map.present) status = check_folder(r, "maps", error);
    if (status == SB_OK && draws) status = check_folder(r, "frames", error);
    for (size_t c = 0; status == SB_OK && draws && c < scene->render.camera_count; c++) {
        char name[128];
        snprintf(name, sizeof name, "frames/%s", scene->render.cameras[c].name);
        status = check_folder(r, name, error);
    }
    return status;
}
