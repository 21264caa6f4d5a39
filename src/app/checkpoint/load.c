/* Resuming from the newest checkpoint that is undamaged, of this program and build, and of this scene. */
#include "app/checkpoint/checkpoint.h"
#include "app/checkpoint/parts.h"
#include "app/cluster/cluster.h"
#include "app/frames/missed.h"
#include "app/grid/frame.h"
#include "app/run/parts.h"
#include "app/run/spent.h"
#include "base/memory.h"

#include <inttypes.h>
#include <string.h>

/* Finds the first line in which two texts differ, cut to fit; false when the texts are equal. */
static bool first_difference(const char *a, const char *b, char line[2][200])
{
    while (*a && *b) {
        const size_t la = strcspn(a, "\n"), lb = strcspn(b, "\n");
        if (la != lb || memcmp(a, b, la) != 0) break;
        a += la + (a[la] == '\n');
        b += lb + (b[lb] == '\n');
    }
    a += strspn(a, " ");
    b += strspn(b, " ");
    snprintf(line[0], sizeof line[0], "%.*s", (int)strcspn(a, "\n"), a);
    snprintf(line[1], sizeof line[1], "%.*s", (int)strcspn(b, "\n"), b);
    return *a || *b;
}

/* A checkpoint of another build can be used, but the bits then differ: it is accepted only with --other-build. */
static sb_status check_build(run *r, const sb_archive_in *in, const char *build, sb_error *error)
{
    sb_error other = {0};
    if (strcmp(build, r->checkpoints.build) == 0) return SB_OK;
    sb_fail(&other, SB_BAD_INPUT, "%.300s: written by a build with other numerics (%.200s); this build has (%.200s)",
            in->name, build, r->checkpoints.build);
    if (!r->checkpoints.any_build)
        return sb_fail(error, SB_BAD_INPUT, "%s; to resume from it anyway, no longer bit for bit, add --other-build",
                       other.text);
    sb_run_warn(r, "%s: the run resumes from it, no longer bit for bit", other.text);
    return SB_OK;
}

/* Checks that the checkpoint is of this program, build, scene and model. */
static sb_status check_origin(run *r, sb_archive_in *in, sb_error *error)
{
    char line[2][200];
    sb_status status = sb_archive_enter(in, SB_CHECKPOINT_SCENE, error);
    if (status != SB_OK) return status;
    char *version = sb_take_text(in), *build = sb_take_text(in), *identity = sb_take_text(in);
    const uint64_t model = sb_take_count(in, UINT64_MAX);
    status = sb_archive_leave(in, error);
    if (status == SB_OK && strcmp(version, SB_VERSION) != 0)
        status =
            sb_fail(error, SB_BAD_INPUT, "%s: written by shorebreak %.40s, expected " SB_VERSION, in->name, version);
    else if (status == SB_OK && first_difference(identity, r->checkpoints.identity, line))
        status = sb_fail(error, SB_BAD_INPUT, "%s: of another scene: it has \"%s\" where this scene has \"%s\"",
                         in->name, line[0], line[1]);
    else if (status == SB_OK && model != r->checkpoints.model)
        status =
            sb_fail(error, SB_BAD_INPUT,
                    "%s: of another model: its particles at the start hash to %016" PRIx64 ", expected %016" PRIx64,
                    in->name, model, r->checkpoints.model);
    else if (status == SB_OK)
        status = check_build(r, in, build, error);
    sb_free(version);
    sb_free(build);
    sb_free(identity);
    return status;
}

/* All pictures up to the state's time have been drawn. */
static void take_picture_times(run *r, sb_archive_in *in)
{
    const double interval = r->scene->render.interval, now = sb_sim_report(r->sim)->time;
    const double film = sb_take_real(in);
    r->picture_times.film = film;
    r->picture_times.still = sb_take_count(in, r->scene->render.still_count);
    if (interval > 0 && !(film >= now * (1 - 1e-9) && film <= now + 2 * interval))
        sb_archive_refuse(in, "the next picture is due at %g s, expected within %g s from %g s", film, interval, now);
}

static sb_status take_run(run *r, sb_archive_in *in, sb_error *error)
{
    sb_energy *first = &r->first_energy;
    sb_status status = sb_archive_enter(in, SB_CHECKPOINT_RUN, error);
    if (status != SB_OK) return status;
    sb_spent_load(r, in);
    r->iterations = r->iterations_before = sb_take_count(in, UINT64_MAX);
    r->capped = sb_take_count(in, UINT64_MAX);
    r->compression = sb_take_real(in);
    r->compression_max = sb_take_real(in);
    r->frames = sb_take_count(in, UINT64_MAX);
    first->kinetic = sb_take_real(in);
    first->potential = sb_take_real(in);
    first->mass = sb_take_real(in);
    first->momentum = sb_take_vector(in);
    for (int c = 0; c < CONSUMERS; c++) r->due[c] = sb_take_real(in);
    sb_take_list(in, r->tables.bytes, SB_CSV_TABLES, sizeof *r->tables.bytes);
    sb_take_list(in, r->tables.hash, SB_CSV_TABLES, sizeof *r->tables.hash);
    sb_missed_load(r, in);
    take_picture_times(r, in);
    status = sb_pictures_load(&r->pictures, in, error);
    if (status == SB_OK) status = sb_recorder_load(&r->recorder, in, error);
    if (status == SB_OK) status = sb_grid_frames_load(r, in, error);
    if (status == SB_OK) status = sb_archive_leave(in, error);
    return status == SB_OK ? sb_csv_check(r->directory, r->scene, &r->tables, error) : status;
}

static sb_status load(run *r, uint64_t step, const char *path, sb_error *error)
{
    sb_archive_in in = {0};
    sb_status status = sb_archive_open(&in, path, SB_CHECKPOINT_KIND, SB_CHECKPOINT_FORMAT, error);
    if (status == SB_OK) status = check_origin(r, &in, error);
    if (status == SB_OK) status = sb_cluster_load(r, false, step, &in, error);
    if (status == SB_OK) status = take_run(r, &in, error);
    sb_archive_in_free(&in);
    return status;
}

static sb_status load_settling(run *r, const char *path, sb_error *error)
{
    sb_archive_in in = {0};
    int done;
    sb_status status = sb_archive_open(&in, path, SB_CHECKPOINT_KIND, SB_CHECKPOINT_FORMAT, error);
    if (status == SB_OK) status = check_origin(r, &in, error);
    if (status == SB_OK) status = sb_archive_enter(&in, SB_CHECKPOINT_SETTLING, error);
    if (status == SB_OK) {
        sb_spent_load(r, &in);
        status = sb_archive_leave(&in, error);
    }
    if (status == SB_OK) status = sb_cluster_load(r, true, 0, &in, error);
    sb_archive_in_free(&in);
    if (status == SB_OK && !sb_sim_settling(r->sim, &done))
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: its settling has ended, expected a state during settling", path);
    return status;
}

sb_status sb_checkpoint_load_settling(run *r, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_error reason = {0};
    sb_status status = sb_checkpoint_settling_path(r, path, error);
    if (status != SB_OK) return status;
    status = load_settling(r, path, &reason);
    if (status == SB_OK) return SB_OK;
    return sb_fail(error, status, status == SB_BAD_INPUT ? "no checkpoint to resume from: %.900s" : "%.900s",
                   reason.text);
}

sb_status sb_checkpoint_load(run *r, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_error newest = {0};
    uint64_t *steps;
    size_t count;
    sb_status status = sb_checkpoint_list(r, &steps, &count, error);
    bool loaded = false;
    for (size_t i = 0; status == SB_OK && !loaded && i < count; i++) {
        sb_error reason = {0};
        status = sb_checkpoint_path(r, steps[i], path, error);
        if (status != SB_OK) break;
        const sb_status found = load(r, steps[i], path, &reason);
        loaded = found == SB_OK;
        if (!loaded && i == 0) newest = reason;
        if (found == SB_FAILED) { /* no memory, or a read error: the checkpoint itself may be good */
            status = found;
            if (error) *error = reason;
        } else if (!loaded && i + 1 < count) {
            sb_run_warn(r, "%s; trying the previous checkpoint", reason.text);
        }
    }
    sb_free(steps);
    if (status == SB_OK && !loaded)
        return sb_fail(error, SB_BAD_INPUT, "no checkpoint to resume from: %.900s", newest.text);
    r->checkpoints.last_step = sb_sim_report(r->sim)->step;
    r->checkpoints.current = loaded;
    return status;
}
