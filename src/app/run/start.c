/* Everything before the first step. */
#include "app/check/fit.h"
#include "app/check/room.h"
#include "app/check/team.h"
#include "app/check/warnings.h"
#include "app/checkpoint/checkpoint.h"
#include "app/checkpoint/lock.h"
#include "app/cluster/cluster.h"
#include "app/grid/water.h"
#include "app/run/parts.h"
#include "app/run/run.h"
#include "app/run/spent.h"
#include "app/steering/steering.h"
#include "output/log/summary.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static sb_status write_scene(const run *r, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_run_path(r, "scene.yaml", path, error);
    return status == SB_OK ? sb_scene_write(r->scene, path, error) : status;
}

/* Writes a summary with the status "running", which stays until the run ends. */
static sb_status write_running(const run *r, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_run_path(r, "summary.json", path, error);
    return status == SB_OK ? sb_summary_write_running(path, r->scene, error) : status;
}

/* The state from which a run begins. */
typedef enum origin {
    NOTHING,    /* a new run */
    SETTLING,   /* a state during settling, without measurements */
    CHECKPOINT, /* a checkpoint of a step */
} origin;

/* Finds the state from which to begin. Without a checkpoint the run starts from the beginning. */
static sb_status look_for_checkpoints(const run *r, bool resume, origin *from, sb_error *error)
{
    size_t found = 0;
    sb_status status = resume ? sb_checkpoint_count(r, &found, error) : SB_OK;
    *from = !resume || status != SB_OK ? NOTHING : found > 0 ? CHECKPOINT : SETTLING;
    if (*from == SETTLING && !sb_checkpoint_settling_exists(r)) {
        sb_run_report(r, "%s: no checkpoint to resume from; the run starts from the beginning", r->directory);
        *from = NOTHING;
    }
    return status;
}

static sb_status clear_earlier_run(run *r, sb_error *error)
{
    if (r->earlier.count > 0)
        sb_run_report(r, "%s: the files of the earlier run are removed, and a new run starts", r->directory);
    return sb_run_files_remove(r->directory, &r->earlier, error);
}

/* Locks the directory, because two runs would overwrite each other's files, and checks that the run may use it. */
static sb_status open_directory(run *r, const sb_run_options *options, origin *from, sb_error *error)
{
    r->made_directory = access(r->directory, F_OK) != 0;
    sb_status status = sb_make_directories(r->directory, error);
    if (status == SB_OK) status = sb_lock_directory(r->directory, "another directory", &r->lock, error);
    if (status == SB_OK) status = sb_checkpoint_begin(r, error);
    if (status == SB_OK) status = sb_run_check_directory(r, options, error);
    return status == SB_OK ? look_for_checkpoints(r, options->resume, from, error) : status;
}

/* Removes the files of an earlier run, unless it is resumed. Call it once the simulation has been made. */
static sb_status take_directory(run *r, origin from, sb_error *error)
{
    char path[SB_PATH_MAX];
    const bool resume = from != NOTHING;
    /* What may fail comes first, so that a failure leaves the earlier run in place. */
    sb_status status = from == CHECKPOINT ? SB_OK : write_scene(r, error);
    if (status == SB_OK && !resume) status = clear_earlier_run(r, error);
    if (status == SB_OK) status = sb_run_path(r, "run.jsonl", path, error);
    if (status == SB_OK)
        status = resume ? sb_runlog_append(path, &r->log, error) : sb_runlog_open(path, &r->log, error);
    if (status == SB_OK && r->checkpoints.on) status = sb_make_directories(r->checkpoints.folder, error);
    return status;
}

/* The top of the colour map depends on the scene, not on each picture, so that all pictures of a run match. */
static void resolve(run *r)
{
    r->resolved.render.speed_max = sb_model_speed_scale(r->scene, &r->model);
}

static sb_status build_model(run *r, bool resume, sb_error *error)
{
    sb_status status = sb_fit_check(r->scene, error);
    if (status != SB_OK) return status;
    sb_run_report(r, "sampling surfaces and filling the domain with water");
    status = sb_cluster_build(r, error);
    if (status != SB_OK) return status;
    for (size_t w = 0; w < r->model.warning_count; w++)
        fprintf(stderr, "shorebreak: warning: %s\n", r->model.warnings[w]);
    resolve(r);
    return r->checkpoints.on || resume ? sb_checkpoint_identify(r, error) : SB_OK;
}

/* Makes the simulation and checks all that could prevent the first step, before the files of an earlier run are
 * removed. */
static sb_status make_simulation(run *r, bool resume, sb_error *error)
{
    r->picture_times.render = &r->scene->render;
    sb_status status = sb_pictures_begin(&r->pictures, r->scene, &r->model, r->directory, error);
    r->pictures.beside_simulation = true;
    if (status == SB_OK) status = sb_cluster_create(r, resume, error);
    return status == SB_OK ? sb_run_check_folders(r, error) : status;
}

static void warn(void *context, const char *text)
{
    sb_run_warn(context, "%s", text);
}

static void note_mesh_guards(run *r)
{
    const char *gaps = sb_mesh_fence_gaps();
    bool reads = false;
    for (size_t b = 0; b < r->scene->body_count; b++) reads = reads || r->scene->bodies[b].shape == SB_SHAPE_MESH;
    if (reads && gaps) sb_runlog_event(r->log, "skipped", "%s", gaps);
}

static sb_status note_start(run *r, sb_error *error)
{
    sb_run_report(r, "%zu fluid and %zu boundary particles, %zu bodies", r->model.fluid_count, r->model.wall_count,
                  r->model.body_count);
    sb_runlog_start(r->log, r->scene, &r->model, omp_get_max_threads(), sb_sim_bytes(r->sim));
    sb_status status = sb_scene_warnings(r->scene, warn, r, error);
    if (status != SB_OK) return status;
    if (sb_scene_nested(r->scene)) sb_grid_wave_warnings(r->scene, warn, r);
    status = sb_model_warnings(r->scene, &r->model, warn, r, error);
    if (status != SB_OK) return status;
    if (r->earlier.others == 1)
        sb_run_warn(r, "%.500s/%.300s: is not a file of a run; it is kept", r->directory, r->earlier.first_other);
    else if (r->earlier.others > 1)
        sb_run_warn(r, "%.500s/%.300s and %zu more: are not files of a run; they are kept", r->directory,
                    r->earlier.first_other, r->earlier.others - 1);
    sb_runlog_event(r->log, "build", "%s", r->checkpoints.build);
    sb_runlog_skipped(r->log, r->off);
    note_mesh_guards(r);
    sb_cluster_log_start(r);
    sb_runlog_skipped(r->log, sb_sim_skipped(r->sim));
    r->setup_seconds = sb_progress_wall(&r->progress);
    return SB_OK;
}

/* The command line as it was given, so that a report can show it. */
static void note_arguments(run *r, const sb_run_options *options)
{
    char folder[SB_PATH_MAX];
    if (options->argument_count > 0)
        sb_runlog_arguments(r->log, getcwd(folder, sizeof folder), options->argument_count, options->arguments);
}

static void watch_settling(void *context, int done, int most, double speed)
{
    run *r = context;
    sb_progress_settling(&r->progress, done, most, speed);
    sb_run_inform_stream(r);
    sb_steering_take(r);
    if (sb_checkpoint_due(r, (uint64_t)done)) sb_checkpoint_write_settling(r);
    sb_cluster_heed(r);
}

/* Estimates the number of steps. Falling or surging water has a speed of about 2 sqrt(gD). */
static void plan(run *r)
{
    int done = 0;
    const double dt = sb_sim_longest_step(r->scene, &r->model, 2 * sb_model_wave_speed(r->scene, &r->model));
    sb_sim_settling(r->sim, &done);
    sb_progress_plan(&r->progress, sb_sim_settle_expected(r->scene), done, ceil(r->scene->duration / dt));
}

/* Settles the water, starts the measurements and writes the first rows of the tables. */
static sb_status begin(run *r, sb_error *error)
{
    plan(r);
    if (sb_sim_settles(r->scene)) sb_run_report(r, "settling");
    sb_status status = sb_cluster_settle(r, watch_settling, error);
    sb_progress_settled(&r->progress);
    sb_progress_resume(&r->progress, 0); /* the time of settling does not count in the speed of steps */
    r->settling_seconds = sb_progress_wall(&r->progress) - r->setup_seconds;
    sb_spent_settled(r);
    if (sb_sim_report(r->sim)->lost > 0)
        sb_run_warn(r, "%llu of %zu particles were lost through walls of the domain during settling",
                    (unsigned long long)sb_sim_report(r->sim)->lost, r->model.fluid_count);
    if (status != SB_OK) return status;
    if (sb_sim_settles(r->scene)) {
        const sb_rest rest = sb_sim_rest(r->sim);
        sb_runlog_event(r->log, "settled", "after %d steps, highest speed %.3g m/s: %s", rest.steps, rest.speed,
                        rest.ended);
    }
    status = sb_cluster_measure(r, true, error);
    if (status != SB_OK) return status;
    sb_model_free_particles(&r->model);
    sb_runlog_skipped(r->log, sb_measure_skipped(r->measure));
    r->first_energy = sb_cluster_energy(r);
    status = sb_csv_open(r->directory, r->scene, &r->model, &r->csv, error);
    if (status == SB_OK) status = sb_csv_write(r->csv, sb_measure_latest(r->measure), error);
    return status == SB_OK ? sb_insets_add(&r->pictures.insets, sb_measure_latest(r->measure), error) : status;
}

/* Frees the simulation, so that the end of the run writes no report and the files stay as they are. */
static sb_status give_up(run *r, sb_status status)
{
    sb_cluster_release(r);
    return status;
}

/* A run passes its end by less than a step. A checkpoint further beyond the requested end is refused, because the new
   scene.yaml would state an end at which the run did not stop. */
static sb_status check_end(const run *r, sb_error *error)
{
    const sb_step_report *report = sb_sim_report(r->sim);
    const double before = report->time - report->time_step;
    if (before <= r->scene->duration * (1 + 1e-9)) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "duration: %.9g s, expected at least %.9g s, the time that the run in %.500s has simulated",
                   r->scene->duration, report->time, r->directory);
}

/* Loads a checkpoint and restores the files to what they were when it was written. */
static sb_status resume_run(run *r, sb_error *error)
{
    sb_status status = sb_cluster_measure(r, false, error);
    if (status == SB_OK) status = sb_checkpoint_load(r, error);
    if (status == SB_OK) status = check_end(r, error);
    if (status != SB_OK) return give_up(r, status);
    sb_model_free_particles(&r->model);
    r->setup_seconds = sb_progress_wall(&r->progress);
    const sb_step_report *report = sb_sim_report(r->sim);
    const bool over = report->time >= r->scene->duration * (1 - 1e-12);
    sb_progress_resume(&r->progress, report->time);
    sb_run_report(r, "resuming from step %llu, t = %.9g s%s", (unsigned long long)report->step, report->time,
                  over ? ": the run is finished; set a longer duration, e.g. with --until, to continue it" : "");
    sb_runlog_event(r->log, "resumed", "step %llu, t = %.9g s, with %d threads, state %016llx",
                    (unsigned long long)report->step, report->time, omp_get_max_threads(),
                    (unsigned long long)sb_cluster_hash(r));
    r->departures = sb_sim_departures(r->sim)->count; /* these were reported when they left */
    status = write_running(r, error);                 /* may fail, so it comes before files are changed */
    if (status != SB_OK) return give_up(r, status);
    sb_checkpoint_remove_later(r);
    status = write_scene(r, error);
    if (status == SB_OK) status = sb_csv_resume(r->directory, r->scene, &r->model, &r->tables, &r->csv, error);
    return status == SB_OK ? sb_run_start_consumers(r, error) : status;
}

/* Reports that settling is resumed. The log has the start of the run already. */
static void note_settling(run *r)
{
    int done;
    sb_sim_settling(r->sim, &done);
    sb_run_report(r, "resuming from step %d of settling, before t = 0", done);
    sb_runlog_event(r->log, "resumed", "step %d of settling, with %d threads, state %016llx", done,
                    omp_get_max_threads(), (unsigned long long)sb_cluster_hash(r));
    r->setup_seconds = sb_progress_wall(&r->progress);
}

sb_status sb_run_start(run *r, const sb_run_options *options, sb_error *error)
{
    origin from = NOTHING;
    sb_status status = open_directory(r, options, &from, error);
    if (status == SB_OK) status = build_model(r, from != NOTHING, error);
    if (status == SB_OK) status = make_simulation(r, from != NOTHING, error);
    if (status == SB_OK && from == SETTLING) status = sb_checkpoint_load_settling(r, error);
    if (status == SB_OK) status = take_directory(r, from, error);
    sb_run_name_consumers(r);
    if (status == SB_OK) sb_team_warnings(warn, r);
    if (status == SB_OK && from != CHECKPOINT) status = sb_run_start_consumers(r, error);
    if (status != SB_OK) return give_up(r, status);
    sb_model_free_start(&r->model);
    note_arguments(r, options);
    if (from == CHECKPOINT) return resume_run(r, error);
    status = write_running(r, error);
    if (status != SB_OK) return status;
    if (from == SETTLING)
        note_settling(r);
    else
        status = note_start(r, error);
    return status == SB_OK ? begin(r, error) : status;
}
