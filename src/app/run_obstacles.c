/* What would keep a run from writing its files, found before it begins. */
#include "app/run_state.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Without --resume or --overwrite, which say what is meant. */
static sb_status refuse_run(const run *r, bool finished, sb_error *error)
{
    return finished ? sb_fail(error, SB_BAD_INPUT,
                              "%.500s: holds a finished run; add --overwrite to replace it, --resume with a later "
                              "--until to continue it, or name another directory by --out",
                              r->directory)
                    : sb_fail(error, SB_BAD_INPUT,
                              "%.500s: holds an unfinished run; add --resume to continue it, --overwrite to replace "
                              "it, or name another directory by --out",
                              r->directory);
}

static sb_status judge_holding(const run *r, const sb_run_manner *manner, sb_run_holds holds, const char *name,
                               sb_error *error)
{
    const bool finished = holds == SB_HOLDS_FINISHED, begun = finished || holds == SB_HOLDS_UNFINISHED;
    if (holds == SB_HOLDS_OTHERS)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: holds \"%.200s\" but no run of shorebreak; name an empty or a new directory by --out",
                       r->directory, name);
    return begun && !manner->resume && !manner->overwrite ? refuse_run(r, finished, error) : SB_OK;
}

sb_status sb_run_admit(run *r, const sb_run_manner *manner, sb_error *error)
{
    char name[SB_RUN_NAME_MAX];
    size_t count = 0;
    if (access(r->directory, W_OK | X_OK) != 0)
        return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", r->directory, strerror(errno));
    const sb_run_holds holds = sb_run_directory_holds(r->directory, name);
    sb_status status = judge_holding(r, manner, holds, name, error);
    if (status == SB_OK) status = sb_run_files_find(r->directory, r->scene, &r->left, error);
    if (!manner->overwrite) r->left.others = 0; /* only who replaces a run may wonder what stays of it */
    if (status == SB_OK && manner->resume) status = sb_checkpoint_count(r, &count, error);
    const bool continues = manner->resume && (count > 0 || sb_checkpoint_settling_there(r));
    if (status == SB_OK && !continues && r->left.foreign[0])
        status =
            sb_fail(error, SB_BAD_INPUT,
                    "%.500s/%.300s: was not written by shorebreak, and the run would overwrite it; move it away, or "
                    "name another directory by --out",
                    r->directory, r->left.foreign);
    if (status == SB_OK && manner->resume && holds == SB_HOLDS_FINISHED && !continues)
        status = sb_fail(error, SB_BAD_INPUT,
                         "%.500s: holds a finished run and no checkpoint to continue from; add --overwrite to "
                         "replace it, or name another directory by --out",
                         r->directory);
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
    if (status == SB_OK && scene->output.plots) status = check_folder(r, "plots", error);
    if (status == SB_OK && draws) status = check_folder(r, "frames", error);
    for (size_t c = 0; status == SB_OK && draws && c < scene->render.camera_count; c++) {
        char name[128];
        snprintf(name, sizeof name, "frames/%s", scene->render.cameras[c].name);
        status = check_folder(r, name, error);
    }
    return status;
}
