#include "app/checkpoint/checkpoint.h"

#include "app/checkpoint/parts.h"
#include "app/cluster/cluster.h"
#include "app/frames/missed.h"
#include "app/grid/frame.h"
#include "app/run/parts.h"
#include "app/run/spent.h"
#include "base/clock.h"
#include "base/memory.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- the folder ---- */

sb_status sb_checkpoint_path(const run *r, uint64_t step, char path[SB_PATH_MAX], sb_error *error)
{
    char name[64];
    snprintf(name, sizeof name, "%09" PRIu64 SB_CHECKPOINT_SUFFIX, step);
    return sb_path_join(path, r->checkpoints.folder, name, error);
}

sb_status sb_checkpoint_settling_path(const run *r, char path[SB_PATH_MAX], sb_error *error)
{
    return sb_path_join(path, r->checkpoints.folder, SB_CHECKPOINT_SETTLING SB_CHECKPOINT_SUFFIX, error);
}

bool sb_checkpoint_settling_exists(const run *r)
{
    char path[SB_PATH_MAX];
    return sb_checkpoint_settling_path(r, path, NULL) == SB_OK && access(path, F_OK) == 0;
}

/* Also removes the temporary file of a run that was killed while it wrote one. */
static sb_status remove_settling(const run *r, sb_error *error)
{
    static const char *const names[] = {SB_CHECKPOINT_SETTLING SB_CHECKPOINT_SUFFIX,
                                        SB_CHECKPOINT_SETTLING SB_CHECKPOINT_SUFFIX ".tmp"};
    char path[SB_PATH_MAX];
    sb_status status = SB_OK;
    for (size_t k = 0; status == SB_OK && k < sizeof names / sizeof *names; k++) {
        status = sb_path_join(path, r->checkpoints.folder, names[k], error);
        if (status == SB_OK && unlink(path) != 0 && errno != ENOENT && errno != ENOTDIR)
            status = sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", path, strerror(errno));
    }
    return status;
}

static int newest_first(const void *left, const void *right)
{
    const uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a < b) - (a > b);
}

/* Reads the step from a checkpoint's file name. */
static bool is_checkpoint(const char *name, uint64_t *step)
{
    char *end;
    if (strspn(name, "0123456789") == 0) return false;
    errno = 0;
    *step = strtoull(name, &end, 10);
    return errno == 0 && strcmp(end, SB_CHECKPOINT_SUFFIX) == 0;
}

sb_status sb_checkpoint_list(const run *r, uint64_t **steps, size_t *count, sb_error *error)
{
    DIR *folder = opendir(r->checkpoints.folder);
    const struct dirent *entry;
    size_t capacity = 0;
    uint64_t step;
    sb_status status = SB_OK;
    *steps = NULL;
    *count = 0;
    if (!folder)
        return errno == ENOENT
                   ? SB_OK
                   : sb_fail(error, SB_BAD_INPUT, "%.500s: cannot read: %s", r->checkpoints.folder, strerror(errno));
    while (status == SB_OK && (entry = readdir(folder))) {
        if (!is_checkpoint(entry->d_name, &step)) continue;
        if (sb_grow((void **)steps, &capacity, *count + 1, sizeof **steps) != 0)
            status = sb_fail_memory(error, "the list of checkpoints");
        else
            (*steps)[(*count)++] = step;
    }
    closedir(folder);
    if (*count > 1) qsort(*steps, *count, sizeof **steps, newest_first);
    return status;
}

sb_status sb_checkpoint_count(const run *r, size_t *count, sb_error *error)
{
    uint64_t *steps;
    sb_status status = sb_checkpoint_list(r, &steps, count, error);
    sb_free(steps);
    return status;
}

/* Removes all checkpoints except the newest `keep`. */
static sb_status remove_older(const run *r, size_t keep, sb_error *error)
{
    char path[SB_PATH_MAX];
    uint64_t *steps;
    size_t count;
    sb_status status = sb_checkpoint_list(r, &steps, &count, error);
    for (size_t i = keep; status == SB_OK && steps && i < count; i++) {
        status = sb_checkpoint_path(r, steps[i], path, error);
        if (status == SB_OK && unlink(path) != 0 && errno != ENOENT)
            status = sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", path, strerror(errno));
    }
    sb_free(steps);
    return status;
}

void sb_checkpoint_remove_later(run *r)
{
    sb_error reason = {0};
    if (sb_remove_numbered(r->checkpoints.folder, SB_CHECKPOINT_SUFFIX, r->checkpoints.last_step, &reason) != SB_OK)
        sb_run_warn(r, "%s", reason.text);
}

/* ---- begin and end ---- */

sb_status sb_checkpoint_begin(run *r, sb_error *error)
{
    const sb_checkpoint_settings *settings = &r->scene->output.checkpoint;
    struct stat found;
    r->checkpoints = (sb_checkpoints){.on = settings->steps > 0 || settings->minutes > 0,
                                      .any_build = r->checkpoints.any_build,
                                      .written = sb_clock()};
    sb_build_numerics(r->checkpoints.build);
    sb_status status = sb_run_path(r, "checkpoints", r->checkpoints.folder, error);
    if (status == SB_OK && lstat(r->checkpoints.folder, &found) == 0 && S_ISLNK(found.st_mode))
        status = sb_fail(error, SB_FAILED, "%.500s: is a symbolic link, expected a directory of the run's own",
                         r->checkpoints.folder);
    return status;
}

sb_status sb_checkpoint_identify(run *r, sb_error *error)
{
    sb_free(r->checkpoints.identity);
    r->checkpoints.identity = NULL;
    r->checkpoints.model = sb_model_hash(&r->model);
    return sb_scene_identity(r->scene, &r->checkpoints.identity, error);
}

void sb_checkpoint_end(run *r)
{
    sb_free(r->checkpoints.identity);
    r->checkpoints.identity = NULL;
}

/* ---- writing ---- */

bool sb_checkpoint_due(const run *r, uint64_t step)
{
    const sb_checkpoint_settings *settings = &r->scene->output.checkpoint;
    return (settings->steps > 0 && step % (uint64_t)settings->steps == 0) ||
           (settings->minutes > 0 && sb_clock() - r->checkpoints.written >= 60 * settings->minutes);
}

static void put_origin(const run *r, sb_archive_out *out)
{
    sb_archive_section(out, SB_CHECKPOINT_SCENE);
    sb_put_text(out, SB_VERSION);
    sb_put_text(out, r->checkpoints.build);
    sb_put_text(out, r->checkpoints.identity);
    sb_put_count(out, r->checkpoints.model);
}

static void put_run(run *r, const sb_csv_marks *tables, sb_archive_out *out)
{
    const sb_energy *first = &r->first_energy;
    sb_archive_section(out, SB_CHECKPOINT_RUN);
    sb_spent_save(r, out);
    sb_put_count(out, r->iterations);
    sb_put_count(out, r->capped);
    sb_put_real(out, r->compression);
    sb_put_real(out, r->compression_max);
    sb_put_count(out, r->frames);
    sb_put_real(out, first->kinetic);
    sb_put_real(out, first->potential);
    sb_put_real(out, first->mass);
    sb_put_vector(out, first->momentum);
    for (int c = 0; c < CONSUMERS; c++) sb_put_real(out, r->consumers[c].next);
    sb_put_list(out, tables->bytes, SB_CSV_TABLES, sizeof *tables->bytes);
    sb_put_list(out, tables->hash, SB_CSV_TABLES, sizeof *tables->hash);
    sb_missed_save(r, out);
    sb_put_real(out, r->picture_times.film);
    sb_put_count(out, r->picture_times.still);
    sb_pictures_save(&r->pictures, out);
    sb_recorder_save(&r->recorder, out);
    sb_grid_frames_save(r, out);
}

/* Warns once of files that a user removed. The next checkpoint does not look for them again. */
static void report_gone(run *r, const sb_gone *gone)
{
    if (gone->count == 1)
        sb_run_warn(r, "%.500s: was removed during the run; the run continues without it", gone->first);
    else if (gone->count > 1)
        sb_run_warn(r, "%.500s and %" PRIu64 " more: were removed during the run; the run continues without them",
                    gone->first, gone->count - 1);
}

/* Syncs to disk all files that the checkpoint relies on, before the checkpoint is written. */
static sb_status sync_files(run *r, sb_csv_marks *tables, sb_error *error)
{
    sb_run_ensure_log(r);
    sb_consumer_drain(&r->consumers[RECORDER]);
    sb_consumer_drain(&r->consumers[PICTURES]);
    sb_status status = sb_csv_sync(r->csv, tables, error);
    sb_gone files = {0}, pictures = {0};
    if (status == SB_OK) status = sb_recorder_sync(&r->recorder, &files, error);
    if (status == SB_OK) report_gone(r, &files);
    if (status == SB_OK) status = sb_pictures_sync(&r->pictures, &pictures, error);
    if (status == SB_OK) report_gone(r, &pictures);
    if (status == SB_OK) (void)sb_file_sync(r->directory); /* names of new files; not every file system supports this */
    return status == SB_OK ? sb_runlog_sync(r->log, error) : status;
}

/* Makes the folder again if someone removed it. A run directory that was removed is not made again, because all of the
   run's other files are lost too. */
static sb_status ensure_folder(run *r, sb_error *error)
{
    struct stat found = {0};
    if (mkdir(r->checkpoints.folder, 0777) == 0) {
        sb_run_warn(r, "%.500s: was removed during the run; it has been made again", r->checkpoints.folder);
        return SB_OK;
    }
    if (errno != EEXIST)
        return sb_fail(error, SB_FAILED, "%.500s: cannot make directory: %s", r->checkpoints.folder, strerror(errno));
    return lstat(r->checkpoints.folder, &found) == 0 && S_ISDIR(found.st_mode)
               ? SB_OK
               : sb_fail(error, SB_FAILED, "%.500s: is %s, expected a directory of the run's own",
                         r->checkpoints.folder, sb_file_kind(found.st_mode) ? sb_file_kind(found.st_mode) : "a file");
}

static sb_status write_now(run *r, char path[SB_PATH_MAX], size_t *bytes, sb_error *error)
{
    sb_archive_out out = {0};
    sb_csv_marks tables;
    sb_status status = sync_files(r, &tables, error);
    if (status == SB_OK) status = ensure_folder(r, error);
    if (status == SB_OK) status = sb_checkpoint_path(r, sb_sim_report(r->sim)->step, path, error);
    if (status == SB_OK) status = sb_archive_create(&out, path, SB_CHECKPOINT_KIND, SB_CHECKPOINT_FORMAT, error);
    if (status != SB_OK) return status;
    put_origin(r, &out);
    put_run(r, &tables, &out);
    sb_cluster_save(r, false, &out);
    status = sb_archive_close(&out, error);
    *bytes = out.used;
    return status;
}

void sb_checkpoint_write(run *r)
{
    sb_checkpoints *c = &r->checkpoints;
    const sb_step_report *report = sb_sim_report(r->sim);
    char path[SB_PATH_MAX];
    size_t bytes = 0;
    sb_error reason = {0};
    if (!c->on || (c->current && c->last_step == report->step)) return;
    const double start = sb_clock();
    c->current = write_now(r, path, &bytes, &reason) == SB_OK;
    c->written = sb_clock();
    c->last_step = report->step;
    if (!c->current) {
        sb_run_warn(r, "no checkpoint at step %" PRIu64 ", the run continues: %s", report->step, reason.text);
        return;
    }
    sb_runlog_event(r->log, "checkpoint", "step %" PRIu64 ", t = %.9g s, %zu bytes in %.3f s: %.500s", report->step,
                    report->time, bytes, c->written - start, strrchr(path, '/') + 1);
    sb_status removed = remove_older(r, (size_t)r->scene->output.checkpoint.keep, &reason);
    if (removed == SB_OK) removed = remove_settling(r, &reason);
    if (removed != SB_OK) sb_run_warn(r, "%s", reason.text);
}

/* ---- during settling ---- */

static sb_status write_settling(run *r, size_t *bytes, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_archive_out out = {0};
    sb_status status = sb_checkpoint_settling_path(r, path, error);
    if (status == SB_OK) status = ensure_folder(r, error);
    if (status == SB_OK) status = sb_archive_create(&out, path, SB_CHECKPOINT_KIND, SB_CHECKPOINT_FORMAT, error);
    if (status != SB_OK) return status;
    put_origin(r, &out);
    sb_archive_section(&out, SB_CHECKPOINT_SETTLING);
    sb_spent_save(r, &out);
    sb_cluster_save(r, true, &out);
    status = sb_archive_close(&out, error);
    *bytes = out.used;
    return status;
}

void sb_checkpoint_write_settling(run *r)
{
    sb_checkpoints *c = &r->checkpoints;
    sb_error reason = {0};
    size_t bytes = 0;
    int done;
    if (!c->on || !sb_sim_settling(r->sim, &done)) return;
    const double start = sb_clock();
    const sb_spent before = r->before; /* the file counts all time spent so far as settling */
    r->settling_seconds = sb_progress_wall(&r->progress) - r->setup_seconds;
    sb_spent_settled(r);
    const sb_status status = write_settling(r, &bytes, &reason);
    r->before = before;
    c->written = sb_clock();
    c->settling = status == SB_OK;
    if (status == SB_OK)
        sb_runlog_event(r->log, "checkpoint", "settling, step %d, %zu bytes in %.3f s: settling.state", done, bytes,
                        c->written - start);
    else
        sb_run_warn(r, "no checkpoint during settling, the run continues: %s", reason.text);
}
