#include "app/run/run.h"

#include "app/checkpoint/checkpoint.h"
#include "app/cluster/cluster.h"
#include "app/frames/missed.h"
#include "app/grid/frame.h"
#include "app/grid/picture.h"
#include "app/run/parts.h"
#include "app/steering/picture_now.h"
#include "app/steering/steering.h"
#include "base/stop.h"
#include "output/log/profile.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { LOG_STEPS = 100 }; /* steps between the periodic lines of the log */

/* Completes the simulation's part of a frame; NULL without memory. */
static sb_frame *complete_frame(const run *r, sb_frame *frame, sb_error *error)
{
    if (!frame) {
        sb_fail_memory(error, "a frame");
        return NULL;
    }
    frame->index = r->frames;
    if (sb_measure_fill_frame(r->measure, frame, error) != SB_OK) {
        sb_frame_release(frame);
        return NULL;
    }
    frame->status.wall_seconds = sb_run_wall(r);
    frame->status.eta_seconds = sb_progress_eta(&r->progress);
    return frame;
}

static sb_frame *make_frame(run *r, sb_error *error)
{
    return complete_frame(r, sb_cluster_snapshot(r), error);
}

static void log_picture(run *r, unsigned drawn, double time)
{
    const sb_step_report *report = sb_sim_report(r->sim);
    static const char text[] = "t = %.9g s, from step %llu at t = %.9g s";
    const unsigned long long step = report->step;
    if (drawn & SB_FRAME_FILM) sb_runlog_event(r->log, "picture", text, time, step, report->time);
    if (drawn & SB_FRAME_STILL) sb_runlog_event(r->log, "still", text, time, step, report->time);
}

/* Pictures show the water at their exact times, which lie within the step: a film runs evenly. */
static sb_status feed_pictures(run *r, sb_error *error)
{
    sb_consumer *consumer = &r->consumers[PICTURES];
    while (sb_consumer_due(consumer, sb_sim_report(r->sim)->time)) {
        const double time = consumer->next;
        sb_frame *frame = make_frame(r, error);
        if (!frame) return SB_FAILED;
        frame->drawn = sb_picture_times_take(&r->picture_times);
        sb_frame_carry(frame, time);
        if (sb_grid_picture_add(r->sim, r->scene, frame, error) != SB_OK) {
            sb_frame_release(frame);
            return SB_FAILED;
        }
        log_picture(r, frame->drawn, time);
        sb_consumer_feed(consumer, frame);
        sb_frame_release(frame);
        consumer->next = sb_picture_times_next(&r->picture_times);
    }
    return SB_OK;
}

/* The other ranks write their pieces of the next particle file; the recorder gets the particles of rank 0. */
static sb_status feed_pieces(run *r, sb_error *error)
{
    sb_consumer *consumer = &r->consumers[RECORDER];
    sb_frame *frame;
    sb_error reason = {0};
    sb_consumer_drain(consumer);            /* the recorder, and the number of its next file, are then at rest */
    const bool rests = !consumer->given_up; /* else the thread may still use the recorder, and misses this frame */
    if (rests && sb_recorder_clear_pieces(&r->recorder, &reason) == SB_OK)
        sb_cluster_write_pieces(r, sb_recorder_next(&r->recorder), &frame, &reason);
    else
        frame = sb_sim_snapshot_own(r->sim);
    frame = complete_frame(r, frame, error);
    if (!frame) return SB_FAILED;
    if (rests) r->recorder.failure = reason;
    sb_consumer_feed(consumer, frame);
    sb_frame_release(frame);
    return SB_OK;
}

/* Gives a snapshot to all consumers that are due. */
static sb_status feed(run *r, sb_error *error)
{
    const double time = sb_sim_report(r->sim)->time;
    const bool apart = r->recorder.ranks > 1 && sb_consumer_due(&r->consumers[RECORDER], time);
    bool due = false, others = false;
    for (int c = 0; c < CONSUMERS; c++) {
        due |= sb_consumer_due(&r->consumers[c], time);
        others |= c != PICTURES && !(c == RECORDER && apart) && sb_consumer_due(&r->consumers[c], time);
    }
    if (!due) return SB_OK;
    sb_cluster_find_pressures(r);
    r->frames++;
    sb_status status = feed_pictures(r, error);
    if (status == SB_OK && apart) status = feed_pieces(r, error);
    if (status != SB_OK || !others) return status;
    sb_frame *frame = make_frame(r, error);
    if (!frame) return SB_FAILED;
    for (int c = 0; c < CONSUMERS; c++)
        if (c != PICTURES && sb_consumer_due(&r->consumers[c], time)) sb_consumer_feed(&r->consumers[c], frame);
    sb_frame_release(frame);
    return SB_OK;
}

/* Reports the first few particles that left, each with its position. A particle that passed a wall gives a warning. */
static void report_departures(run *r)
{
    const sb_departures *all = sb_sim_departures(r->sim);
    for (; r->departures < all->count; r->departures++) {
        const sb_departure *one = &all->first[r->departures];
        char text[200];
        snprintf(text, sizeof text,
                 "particle %u left through the %s %s at t = %.6g s, at (%.6g, %.6g, %.6g) m with %.3g m/s",
                 one->particle, one->lost ? "wall" : "open side", sb_side_names[one->side], one->time, one->position.x,
                 one->position.y, one->position.z, one->speed);
        if (one->lost)
            sb_run_warn(r, "%s", text);
        else
            sb_runlog_event(r->log, "left", "%s", text);
    }
}

static sb_status one_step(run *r, sb_error *error)
{
    sb_status status = sb_cluster_step(r, error);
    if (status != SB_OK) return status;
    const sb_step_report *report = sb_sim_report(r->sim);
    r->iterations += (uint64_t)report->iterations;
    r->compression += report->compression;
    r->compression_max = fmax(r->compression_max, report->compression_max);
    r->steps++;
    r->particle_steps += (double)report->fluid_count;
    r->capped += report->capped;
    report_departures(r);
    status = sb_cluster_observe(r, error);
    if (status == SB_OK) status = sb_csv_write(r->csv, sb_measure_latest(r->measure), error);
    if (status == SB_OK) status = sb_insets_add(&r->pictures.insets, sb_measure_latest(r->measure), error);
    sb_run_inform_stream(r);
    if (status == SB_OK) status = feed(r, error);
    if (status == SB_OK) status = sb_grid_frame_of_run(r, error);
    sb_missed_report(r);
    if (report->step % LOG_STEPS == 0) {
        sb_run_ensure_log(r);
        sb_run_log_step(r);
        sb_cluster_log(r);
    }
    if (status == SB_OK) status = sb_runlog_check(r->log, error);
    if (status == SB_OK && sb_checkpoint_due(r, report->step)) sb_checkpoint_write(r);
    sb_progress_update(&r->progress, report);
    return status;
}

static sb_status advance(run *r, sb_error *error)
{
    sb_run_inform_stream(r);
    sb_status status = feed(r, error);
    if (status == SB_OK) status = sb_grid_frame_of_run(r, error);
    report_departures(r);
    while (status == SB_OK && sb_sim_report(r->sim)->time < r->scene->duration * (1 - 1e-12)) {
        sb_steering_take(r);
        sb_cluster_heed(r);
        if (sb_stop_signal())
            return sb_fail(error, SB_INTERRUPTED, "stopped by a %s at t = %g s", sb_stop_cause(),
                           sb_sim_report(r->sim)->time);
        if (sb_sim_report(r->sim)->fluid_count == 0)
            return sb_fail(error, SB_FAILED, "t = %g s: all water has left the domain", sb_sim_report(r->sim)->time);
        status = one_step(r, error);
    }
    return status;
}

static void print_profile(const run *r)
{
    sb_profile profile = {
        .steps = r->steps,
        .iterations = r->iterations - r->iterations_before,
        .particle_steps = r->particle_steps,
        .settling_particles = r->model.fluid_count,
        .setup = r->setup_seconds,
        .settling = r->settling_seconds,
        .wall = sb_progress_wall(&r->progress),
        .simulated = sb_sim_report(r->sim)->time,
        .bytes = sb_cluster_bytes(r),
        .threads = omp_get_max_threads(),
        .skipped = {sb_sim_skipped(r->sim), r->measure ? sb_measure_skipped(r->measure) : NULL, r->off},
    };
    profile.stage_count = sb_sim_stages(r->sim, &profile.stages);
    sb_profile_print(stdout, &profile);
    sb_cluster_print(r);
}

/* Saves a checkpoint, also during settling, and adds to the message of a stopped run how to resume it. */
static void save_at_end(run *r, sb_status status, sb_error *error)
{
    int done;
    if (!r->sim || (status != SB_OK && status != SB_INTERRUPTED)) return;
    if (sb_sim_settling(r->sim, &done))
        sb_checkpoint_write_settling(r);
    else if (r->csv)
        sb_checkpoint_write(r);
    const size_t length = strlen(error->text);
    if (status == SB_INTERRUPTED && (r->checkpoints.current || r->checkpoints.settling))
        snprintf(error->text + length, sizeof error->text - length,
                 "; to resume: shorebreak run %.200s/scene.yaml --out %.200s --resume", r->directory, r->directory);
}

/* Frees what the threads of consumers use, unless one of them still exists. */
static void release_shared(run *r, bool *thread_remains)
{
    bool remains = sb_consumer_thread_remains(&r->requested.consumer);
    for (int c = 0; c < CONSUMERS; c++) remains |= sb_consumer_thread_remains(&r->consumers[c]);
    if (remains) {
        if (thread_remains) *thread_remains = true;
        return;
    }
    sb_picture_now_free(r);
    sb_pictures_free(&r->pictures);
    sb_particle_list_free(&r->recorder.list); /* of a run that was not resumed: no thread has used it */
    sb_model_free(&r->model);
}

sb_status sb_run(const sb_scene *scene, const char *directory, const sb_run_options *options, sb_error *error)
{
    run r = {.resolved = *scene, .directory = directory, .lock = -1};
    r.scene = &r.resolved;
    r.checkpoints.any_build = options->other_build;
    r.steering.live_port = options->live_port;
    r.steering.live_address = options->live_address;
    r.cluster.ranks = options->ranks;
    sb_error local = {0};
    sb_progress_begin(&r.progress, options->quiet ? NULL : stdout, scene->duration);
    sb_cluster_watch();
    sb_status status = sb_run_start(&r, options, &local);
    if (status == SB_OK) status = advance(&r, &local);
    save_at_end(&r, status, &local);
    sb_run_finish(&r, &status, &local);
    sb_cluster_dismiss(&r);
    if (options->profile && r.sim) print_profile(&r);
    sb_checkpoint_end(&r);
    sb_measure_destroy(r.prepared);
    sb_measure_destroy(r.measure);
    sb_sim_destroy(r.sim);
    release_shared(&r, options->thread_remains);
    sb_particle_list_free(&r.grid_frames);
    sb_run_files_free(&r.earlier);
    if (r.made_directory && status != SB_OK) rmdir(r.directory); /* fails, as it should, if there are files */
    if (r.lock >= 0) close(r.lock);
    if (status != SB_OK && error) *error = local;
    return status;
}
