/* Checks before a run begins that it can write its files. */
#include "app/checkpoint/checkpoint.h"
#include "app/run/parts.h"
#include "app/run/run.h"
#include "output/particles/foam_files.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Refuses a directory that holds a run, when neither --resume nor --overwrite is given. */
static sb_status refuse_run(const run *r, bool finished, sb_error *error)
{
    return finished ? sb_fail(error, SB_BAD_INPUT,
                              "%.500s: holds a finished run; add --overwrite to replace it, --resume with a later "
                              "--until to continue it, or name another directory with --out",
                              r->directory)
                    : sb_fail(error, SB_BAD_INPUT,
                              "%.500s: holds an unfinished run; add --resume to continue it, --overwrite to replace "
                              "it, or name another directory with --out",
                              r->directory);
}

static sb_status check_contents(const run *r, const sb_run_options *options, sb_run_holds holds, const char *name,
                                sb_error *error)
{
    const bool finished = holds == SB_HOLDS_FINISHED, begun = finished || holds == SB_HOLDS_UNFINISHED;
    if (holds == SB_HOLDS_OTHERS)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: holds \"%.200s\" but no run of shorebreak; name an empty or a new directory with --out",
                       r->directory, name);
    return begun && !options->resume && !options->overwrite ? refuse_run(r, finished, error) : SB_OK;
}

sb_status sb_run_check_directory(run *r, const sb_run_options *options, sb_error *error)
{
    char name[SB_RUN_NAME_MAX];
    size_t count = 0;
    if (access(r->directory, W_OK | X_OK) != 0)
        return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", r->directory, strerror(errno));
    const sb_run_holds holds = sb_run_directory_holds(r->directory, name);
    sb_status status = check_contents(r, options, holds, name, error);
    if (status == SB_OK) status = sb_run_files_find(r->directory, r->scene, &r->earlier, error);
    if (!options->overwrite) r->earlier.others = 0; /* they are reported only when a run is replaced */
    if (status == SB_OK && options->resume) status = sb_checkpoint_count(r, &count, error);
    const bool continues = options->resume && (count > 0 || sb_checkpoint_settling_exists(r));
    if (status == SB_OK && !continues && r->earlier.foreign[0])
        status =
            sb_fail(error, SB_BAD_INPUT,
                    "%.500s/%.300s: was not written by shorebreak, and the run would overwrite it; move it away, or "
                    "name another directory with --out",
                    r->directory, r->earlier.foreign);
    if (status == SB_OK && options->resume && holds == SB_HOLDS_FINISHED && !continues)
        status = sb_fail(error, SB_BAD_INPUT,
                         "%.500s: holds a finished run and no checkpoint to continue from; add --overwrite to "
                         "replace it, or name another directory with --out",
                         r->directory);
    return status;
}

/* Checks a folder of the run, if it exists; otherwise it is made with its first file. */
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

/* Checks a folder of pictures, and the folder of each camera in it. */
static sb_status check_cameras(const run *r, const char *folder, sb_error *error)
{
    sb_status status = r->scene->render.camera_count > 0 ? check_folder(r, folder, error) : SB_OK;
    for (size_t c = 0; status == SB_OK && c < r->scene->render.camera_count; c++) {
        char name[128];
        snprintf(name, sizeof name, "%s/%s", folder, r->scene->render.cameras[c].name);
        status = check_folder(r, name, error);
    }
    return status;
}

sb_status sb_run_check_folders(const run *r, sb_error *error)
{
    const sb_scene *scene = r->scene;
    const bool film = scene->render.interval > 0, stills = scene->render.still_count > 0;
    sb_status status = SB_OK;
    if (scene->output.particle_interval > 0) status = check_folder(r, SB_PARTICLE_FOLDER, error);
    if (status == SB_OK && scene->output.particle_interval > 0 && scene->foam.enabled)
        status = check_folder(r, SB_FOAM_FOLDER, error);
    const bool grid_maps = sb_scene_nested(scene) && scene->offshore.maps;
    if (status == SB_OK && (scene->measure.map.present || grid_maps)) status = check_folder(r, "maps", error);
    if (status == SB_OK && scene->output.plots) status = check_folder(r, "plots", error);
    if (status == SB_OK && film) status = check_cameras(r, "frames", error);
    if (status == SB_OK && stills) status = check_cameras(r, "stills", error);
    return status;
}
