/* What an earlier run has left in a directory where a new one begins. */
#include "app/run_state.h"
#include "output/esri.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_ENDINGS = 3 };

/* By name, so that nothing of the user's goes; ".tmp" was being written when a run was killed. Log and scene are
   overwritten at once, numbered files are below. */
static const struct {
    const char *folder, *const *names, *endings[MOST_ENDINGS];
} left[] = {
    {".", (const char *const[]){"summary.json", NULL}, {"", ".tmp"}},
    {".", sb_csv_names, {".csv"}},
    {".", (const char *const[]){"particles.pvd", NULL}, {"", ".tmp"}},
    {"particles", (const char *const[]){"last-good.vtp", NULL}, {"", ".tmp"}},
    {"maps", sb_map_names, {".asc", ".asc.tmp", ".png"}},
    {"plots", sb_csv_names, {".png", ".dat", ".gp"}},
    {"plots", sb_map_names, {".gp"}},
    {"plots", (const char *const[]){"part", NULL}, {".png"}},
};

static const char *const folders[] = {"particles", "maps", "plots", "frames"};

/* A link stays: where the new run would write through it, that is refused. */
static sb_status remove_file(const char *folder, const char *name, const char *ending, sb_error *error)
{
    char path[SB_PATH_MAX];
    struct stat found;
    const int length = snprintf(path, sizeof path, "%s/%s%s", folder, name, ending);
    if (length >= (int)sizeof path)
        return sb_fail(error, SB_BAD_INPUT, "%.64s...: path longer than %d bytes", path, SB_PATH_MAX);
    if (lstat(path, &found) != 0 || !S_ISREG(found.st_mode)) return SB_OK;
    if (unlink(path) != 0 && errno != ENOENT)
        return sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", path, strerror(errno));
    return SB_OK;
}

/* A folder of the run's own, not one that a link leads to. */
static bool is_folder(const char *path)
{
    struct stat found;
    return lstat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

static sb_status remove_named(const run *r, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < sizeof left / sizeof *left; i++) {
        const bool top = strcmp(left[i].folder, ".") == 0;
        status = sb_run_path(r, left[i].folder, folder, error);
        if (status != SB_OK || (!top && !is_folder(folder))) continue;
        for (size_t n = 0; left[i].names[n]; n++)
            for (size_t e = 0; status == SB_OK && e < MOST_ENDINGS && left[i].endings[e]; e++)
                status = remove_file(folder, left[i].names[n], left[i].endings[e], error);
    }
    return status;
}

/* One camera's pictures, and the film made of them. */
static sb_status remove_camera(const run *r, const char *frames, const char *camera, sb_error *error)
{
    char folder[SB_PATH_MAX], part[SB_PATH_MAX];
    sb_status status = sb_path_join(folder, frames, camera, error);
    if (status != SB_OK || !is_folder(folder)) return status;
    snprintf(part, sizeof part, ".%.255s", camera);
    status = sb_remove_numbered(folder, ".png", 0, error);
    if (status == SB_OK) status = remove_file(r->directory, camera, ".mp4", error);
    if (status == SB_OK) status = remove_file(r->directory, part, ".part.mp4", error);
    (void)rmdir(folder); /* unless something else is in it */
    return status;
}

/* Of the cameras that the earlier scene had, or that were drawn later. */
static sb_status remove_cameras(const run *r, sb_error *error)
{
    char frames[SB_PATH_MAX];
    const struct dirent *entry;
    sb_status status = sb_run_path(r, "frames", frames, error);
    if (status != SB_OK || !is_folder(frames)) return status;
    DIR *folder = opendir(frames);
    if (!folder) return sb_fail(error, SB_FAILED, "%.500s: cannot read: %s", frames, strerror(errno));
    while (status == SB_OK && (entry = readdir(folder)))
        if (entry->d_name[0] != '.') status = remove_camera(r, frames, entry->d_name, error);
    closedir(folder);
    return status;
}

static sb_status remove_particles(const run *r, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_status status = sb_run_path(r, "particles", folder, error);
    return status == SB_OK && is_folder(folder) ? sb_remove_numbered(folder, ".vtp", 0, error) : status;
}

sb_status sb_run_clear(run *r, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_checkpoint_remove_all(r, error);
    if (status == SB_OK) status = remove_named(r, error);
    if (status == SB_OK) status = remove_particles(r, error);
    if (status == SB_OK) status = remove_cameras(r, error);
    for (size_t i = 0; status == SB_OK && i < sizeof folders / sizeof *folders; i++) {
        status = sb_run_path(r, folders[i], path, error);
        if (status == SB_OK) (void)rmdir(path); /* unless something else is in it */
    }
    return status;
}
