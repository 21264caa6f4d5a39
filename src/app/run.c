#include "app/run.h"

#include "app/consumers.h"
#include "app/interrupt.h"
#include "base/memory.h"
#include "measure/measure.h"
#include "output/csv.h"
#include "output/esri.h"
#include "output/plots.h"
#include "output/profile.h"
#include "output/progress.h"
#include "output/summary.h"
#include "output/video.h"
#include "output/vtp.h"
#include "sim/sim.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

enum {
    FILE_QUEUE = 3,    /* frames that wait for disk or renderer before the simulation does */
    STREAM_QUEUE = 4,  /* beyond these the stream drops the oldest */
    LOG_STEPS = 100    /* steps between the log's periodic lines */
};

typedef struct run {
    sb_scene resolved;     /* a shallow copy of the caller's, with what only the model can tell */
    const sb_scene *scene; /* it */
    const char *directory;
    sb_model model;
    sb_sim *sim;
    sb_measure *measure;
    sb_csv *csv;
    sb_runlog *log;
    sb_progress progress;
    sb_recorder recorder;
    sb_pictures pictures;
    sb_streamer streamer;
    sb_consumer consumers[3]; /* files, pictures, stream: those the scene asks for are started */
    sb_energy first_energy;
    uint64_t iterations, capped, frames;
    uint64_t steps;           /* of this process */
    double particle_steps, setup_seconds, settling_seconds;
    const char *off[4];       /* consumers that are not there, ended by NULL */
    bool inside_known;
    uint64_t inside, crossed; /* particles within solids at the end */
} run;

enum { RECORDER, PICTURES, STREAMER, CONSUMERS };

static sb_status in_directory(char path[SB_PATH_MAX], const run *r, const char *name, sb_error *error)
{
    return sb_path_join(path, r->directory, name, error);
}

/* ---- before the first step ---- */

static sb_status write_scene(const run *r, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = in_directory(path, r, "scene.yaml", error);
    return status == SB_OK ? sb_scene_write(r->scene, path, error) : status;
}

static sb_status open_directory(run *r, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_make_directories(r->directory, error);
    if (status == SB_OK)
        status = write_scene(r, error);
    if (status == SB_OK)
        status = in_directory(path, r, "run.jsonl", error);
    return status == SB_OK ? sb_runlog_open(path, &r->log, error) : status;
}

/* The colour map's top is the scene's, not each picture's: later pictures of this run shall match. */
static sb_status resolve(run *r, sb_error *error)
{
    double depth = fmax(r->model.still_depth, r->scene->resolution);
    if (r->resolved.render.speed_max > 0)
        return SB_OK;
    r->resolved.render.speed_max = 2 * sqrt(fmax(r->scene->fluid.gravity, 1) * depth);
    return write_scene(r, error);
}

static void say(const run *r, const char *text)
{
    if (r->progress.stream)
        fprintf(r->progress.stream, "%s\n", text);
}

static void warn(run *r, const char *text)
{
    sb_runlog_warning(r->log, "%s", text);
    fprintf(stderr, "shorebreak: warning: %s\n", text);
}

static sb_status start_streamer(run *r, sb_error *error)
{
    sb_error reason = {0};
    if (sb_stream_create(&r->scene->stream, r->scene->title, &r->streamer.stream, &reason) != SB_OK) {
        warn(r, reason.text);
        return SB_OK;
    }
    sb_consumer_work work = sb_streamer_work(&r->streamer);
    return sb_consumer_start(&r->consumers[STREAMER], &work, r->scene->stream.interval, STREAM_QUEUE,
                             SB_QUEUE_DROP_OLDEST, error);
}

/* Threads of consumers are made before OpenMP binds anything. */
static sb_status start_consumers(run *r, sb_error *error)
{
    const sb_scene *scene = r->scene;
    r->recorder = (sb_recorder){.directory = r->directory};
    r->pictures = (sb_pictures){
        .scene = scene, .model = &r->model, .directory = r->directory, .camera = -1};
    r->streamer = (sb_streamer){.scene = scene, .run_name = scene->title, .log = r->log};
    sb_status status = SB_OK;
    size_t skipped = 0;
    if (scene->stream.enabled)
        status = start_streamer(r, error);
    else
        r->off[skipped++] = "stream: off, no LCM thread";
    if (status == SB_OK && scene->output.particle_interval > 0) {
        sb_consumer_work work = sb_recorder_work(&r->recorder);
        status = sb_consumer_start(&r->consumers[RECORDER], &work, scene->output.particle_interval,
                                   FILE_QUEUE, SB_QUEUE_WAIT, error);
    } else {
        r->off[skipped++] = "particle files: off, no thread";
    }
    if (status == SB_OK && scene->render.interval > 0 && scene->render.camera_count > 0) {
        sb_consumer_work work = sb_pictures_work(&r->pictures);
        status = sb_consumer_start(&r->consumers[PICTURES], &work, scene->render.interval, FILE_QUEUE,
                                   SB_QUEUE_WAIT, error);
    } else {
        r->off[skipped++] = "pictures: off, no thread, no graphics memory";
    }
    sb_runlog_skipped(r->log, r->off);
    return status;
}

static sb_status prepare(run *r, sb_error *error)
{
    say(r, "sampling surfaces and filling the sea");
    sb_status status = sb_model_build(r->scene, &r->model, error);
    if (status != SB_OK)
        return status;
    status = resolve(r, error);
    if (status != SB_OK)
        return status;
    for (size_t w = 0; w < r->model.warning_count; w++)
        fprintf(stderr, "shorebreak: warning: %s\n", r->model.warnings[w]);
    status = start_consumers(r, error);
    if (status == SB_OK)
        status = sb_sim_create(r->scene, &r->model, &r->sim, error);
    if (status != SB_OK)
        return status;
    char text[160];
    snprintf(text, sizeof text, "%zu fluid and %zu boundary particles, %zu bodies", r->model.fluid_count,
             r->model.wall_count, r->model.body_count);
    say(r, text);
    sb_runlog_start(r->log, r->scene, &r->model, omp_get_max_threads(), sb_sim_bytes(r->sim));
    sb_runlog_skipped(r->log, sb_sim_skipped(r->sim));
    r->setup_seconds = sb_progress_wall(&r->progress);
    if (sb_sim_settles(r->scene))
        say(r, "settling");
    status = sb_sim_settle(r->sim, error);
    r->settling_seconds = sb_progress_wall(&r->progress) - r->setup_seconds;
    if (status != SB_OK)
        return status;
    sb_runlog_event(r->log, "settled", "highest speed %.3g m/s", sb_sim_report(r->sim)->max_speed);
    status = sb_measure_create(r->scene, &r->model, r->sim, &r->measure, error);
    if (status != SB_OK)
        return status;
    sb_runlog_skipped(r->log, sb_measure_skipped(r->measure));
    r->first_energy = sb_sim_energy(r->sim);
    status = sb_csv_open(r->directory, r->scene, &r->model, &r->csv, error);
    if (status == SB_OK)
        status = sb_csv_write(r->csv, sb_measure_latest(r->measure), error);
    return status;
}

/* ---- steps ---- */

/* One snapshot for all consumers that are due. */
static sb_status feed(run *r, sb_error *error)
{
    double time = sb_sim_report(r->sim)->time;
    bool due = false;
    for (int c = 0; c < CONSUMERS; c++)
        due |= sb_consumer_due(&r->consumers[c], time);
    if (!due)
        return SB_OK;
    sb_frame *frame = sb_sim_snapshot(r->sim);
    if (!frame)
        return sb_fail_memory(error, "a frame");
    frame->index = ++r->frames;
    sb_measure_fill_frame(r->measure, frame);
    frame->status.wall_seconds = sb_progress_wall(&r->progress);
    frame->status.eta_seconds = sb_progress_eta(&r->progress);
    for (int c = 0; c < CONSUMERS; c++)
        if (sb_consumer_due(&r->consumers[c], time))
            sb_consumer_feed(&r->consumers[c], frame);
    sb_frame_release(frame);
    return SB_OK;
}

static void log_step(run *r, bool hash)
{
    const sb_step_report *report = sb_sim_report(r->sim);
    const sb_energy energy = sb_sim_energy(r->sim);
    sb_runlog_state state = {.report = report, .energy = &energy, .has_hash = hash};
    state.stage_count = sb_sim_stages(r->sim, &state.stages);
    state.hash = hash ? sb_sim_hash(r->sim) : 0;
    sb_runlog_step(r->log, &state);
}

static sb_status one_step(run *r, sb_error *error)
{
    sb_status status = sb_sim_step(r->sim, error);
    if (status != SB_OK)
        return status;
    const sb_step_report *report = sb_sim_report(r->sim);
    r->iterations += (uint64_t)report->iterations;
    r->steps++;
    r->particle_steps += (double)report->fluid_count;
    r->capped += report->capped;
    status = sb_measure_step(r->measure, r->sim, error);
    if (status == SB_OK)
        status = sb_csv_write(r->csv, sb_measure_latest(r->measure), error);
    if (status == SB_OK)
        status = feed(r, error);
    if (report->step % LOG_STEPS == 0)
        log_step(r, true);
    if (status == SB_OK)
        status = sb_runlog_check(r->log, error);
    sb_progress_update(&r->progress, report);
    return status;
}

static sb_status advance(run *r, sb_error *error)
{
    sb_status status = feed(r, error);
    while (status == SB_OK && sb_sim_report(r->sim)->time < r->scene->duration * (1 - 1e-12)) {
        if (sb_interrupt_signal())
            return sb_fail(error, SB_INTERRUPTED, "stopped by a signal at t = %g s",
                           sb_sim_report(r->sim)->time);
        if (sb_sim_report(r->sim)->fluid_count == 0)
            return sb_fail(error, SB_FAILED, "t = %g s: all water has left the domain",
                           sb_sim_report(r->sim)->time);
        status = one_step(r, error);
    }
    return status;
}

/* ---- after the last step ---- */

static void keep_first(sb_status *status, sb_error *error, sb_status found, const sb_error *reason)
{
    if (found == SB_OK || *status == SB_FAILED)
        return;
    *status = found;
    *error = *reason;
}

/* The state before the step that failed, for a look at what went wrong. */
static void write_last_state(run *r)
{
    char path[SB_PATH_MAX];
    sb_error reason = {0};
    sb_frame *frame = sb_sim_snapshot(r->sim);
    if (!frame)
        return;
    if (in_directory(path, r, "particles", &reason) == SB_OK &&
        sb_make_directories(path, &reason) == SB_OK &&
        in_directory(path, r, "particles/last-good.vtp", &reason) == SB_OK &&
        sb_vtp_write(path, frame, &reason) == SB_OK)
        sb_runlog_event(r->log, "last_good_state", "particles/last-good.vtp");
    else
        warn(r, reason.text);
    sb_frame_release(frame);
}

/* An independent look at the walls: winding numbers of the meshes, not boundary particles. */
static sb_status count_inside(run *r, sb_error *error)
{
    sb_frame *frame = sb_sim_snapshot(r->sim);
    sb_vec3 *displacement = sb_alloc(r->model.body_count, sizeof *displacement);
    sb_inside_report any = {0}, deep = {0};
    sb_status status = SB_OK;
    if (!frame || !displacement) {
        status = sb_fail_memory(error, "the look at the walls");
        goto done;
    }
    for (size_t b = 0; b < r->model.body_count; b++)
        displacement[b] = frame->bodies[b].displacement;
    /* The sheet of boundary particles lies behind the wall by the offset; beyond it water has crossed. */
    double sheet = fmax(r->scene->numerics.wall_offset, 0.5) * r->scene->resolution;
    status = sb_model_first_inside(&r->model, frame->position, frame->count, frame->origin, displacement, 0,
                                   &any, error);
    if (status == SB_OK)
        status = sb_model_first_inside(&r->model, frame->position, frame->count, frame->origin, displacement,
                                       sheet, &deep, error);
    if (status != SB_OK)
        goto done;
    r->inside_known = true;
    r->inside = any.count;
    r->crossed = deep.count;
    sb_runlog_event(r->log, "walls", "%zu particle centres within solids, %zu of them beyond the boundary particles",
                    any.count, deep.count);
    if (deep.count > 0) {
        const float *at = frame->position + 3 * deep.first;
        char text[256];
        snprintf(text, sizeof text, "%zu particles passed through walls, the first %.3g m into \"%.63s\" near (%.5g, %.5g, %.5g) m",
                 deep.count, deep.depth, r->model.bodies[deep.body].name, frame->origin.x + (double)at[0],
                 frame->origin.y + (double)at[1], frame->origin.z + (double)at[2]);
        warn(r, text);
    }
done:
    sb_free(displacement);
    sb_frame_release(frame);
    return status;
}

static void stop_consumers(run *r, sb_status *status, sb_error *error)
{
    for (int c = 0; c < CONSUMERS; c++) {
        sb_consumer *consumer = &r->consumers[c];
        if (!consumer->started)
            continue;
        uint64_t dropped = sb_frame_queue_dropped(consumer->queue);
        double waited = sb_frame_queue_waited(consumer->queue);
        sb_consumer_stop(consumer);
        sb_runlog_event(r->log, "consumer", "%s: %llu frames, %llu dropped, simulation waited %.2f s",
                        consumer->work.name, (unsigned long long)consumer->handled,
                        (unsigned long long)dropped, waited);
        if (atomic_load(&consumer->failed)) {
            sb_error reason = {0};
            sb_fail(&reason, SB_FAILED, "%s: %.900s", consumer->work.name, consumer->error.text);
            warn(r, reason.text);
            keep_first(status, error, SB_FAILED, &reason);
        }
    }
}

static void write_summary(run *r, sb_status *status, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_error reason = {0};
    const sb_step_report *report = sb_sim_report(r->sim);
    sb_summary summary = {
        .scene = r->scene,
        .model = &r->model,
        .status = *status,
        .reason = *status == SB_OK ? NULL : error->text,
        .wall = sb_progress_wall(&r->progress),
        .simulated = report->time,
        .steps = report->step,
        .iterations = r->iterations,
        .capped_steps = r->capped,
        .fluid_particles = r->model.fluid_count,
        .bytes = sb_sim_bytes(r->sim),
        .lost = report->lost,
        .left_domain = report->left_domain,
        .has_inside = r->inside_known,
        .inside = r->inside,
        .crossed = r->crossed,
        .threads = omp_get_max_threads(),
        .bodies = r->measure ? sb_measure_bodies(r->measure) : NULL,
        .first = r->first_energy,
        .last = sb_sim_energy(r->sim),
        .hash = sb_sim_hash(r->sim),
        .frames = r->recorder.count,
        .pictures = r->pictures.count,
    };
    summary.stage_count = sb_sim_stages(r->sim, &summary.stages);
    sb_status found = in_directory(path, r, "summary.json", &reason);
    if (found == SB_OK)
        found = sb_summary_write(path, &summary, &reason);
    keep_first(status, error, found, &reason);
}

static void finish(run *r, sb_status *status, sb_error *error)
{
    sb_error reason = {0};
    if (r->sim && *status == SB_FAILED)
        write_last_state(r);
    stop_consumers(r, status, error);
    if (r->sim)
        keep_first(status, error, count_inside(r, &reason), &reason);
    if (r->csv)
        keep_first(status, error, sb_csv_close(r->csv, &reason), &reason);
    if (r->sim) {
        log_step(r, true);
        sb_progress_end(&r->progress, sb_sim_report(r->sim));
    }
    if (r->measure) {
        sb_runlog_bodies(r->log, &r->model, sb_measure_bodies(r->measure));
        const sb_map_record *map = sb_measure_map(r->measure);
        if (map)
            keep_first(status, error, sb_maps_write(r->directory, map, &reason), &reason);
        if (r->scene->output.plots)
            sb_plots_write(r->directory, r->scene, r->log);
    }
    for (size_t c = 0; c < r->scene->render.camera_count && r->pictures.count > 1 && r->scene->render.video; c++)
        sb_video_write(r->directory, r->scene->render.cameras[c].name, r->scene->render.video_rate, r->log);
    if (r->sim)
        write_summary(r, status, error);
    sb_runlog_end(r->log, *status, *status == SB_OK ? NULL : error->text);
    keep_first(status, error, sb_runlog_close(r->log, &reason), &reason);
}

static void print_profile(const run *r)
{
    sb_profile profile = {
        .steps = r->steps,
        .iterations = r->iterations,
        .particle_steps = r->particle_steps,
        .settling_particles = r->model.fluid_count,
        .setup = r->setup_seconds,
        .settling = r->settling_seconds,
        .wall = sb_progress_wall(&r->progress),
        .simulated = sb_sim_report(r->sim)->time,
        .bytes = sb_sim_bytes(r->sim),
        .threads = omp_get_max_threads(),
        .skipped = {sb_sim_skipped(r->sim), r->measure ? sb_measure_skipped(r->measure) : NULL, r->off},
    };
    profile.stage_count = sb_sim_stages(r->sim, &profile.stages);
    sb_profile_print(stdout, &profile);
}

sb_status sb_run(const sb_scene *scene, const char *directory, const sb_run_voice *voice, sb_error *error)
{
    run r = {.resolved = *scene, .directory = directory};
    r.scene = &r.resolved;
    sb_error local = {0};
    sb_progress_begin(&r.progress, voice->quiet ? NULL : stdout, scene->duration);
    sb_interrupt_watch();
    sb_status status = open_directory(&r, &local);
    if (status == SB_OK)
        status = prepare(&r, &local);
    if (status == SB_OK)
        status = advance(&r, &local);
    finish(&r, &status, &local);
    if (voice->profile && r.sim)
        print_profile(&r);
    sb_measure_destroy(r.measure);
    sb_sim_destroy(r.sim);
    sb_model_free(&r.model);
    if (status != SB_OK && error)
        *error = local;
    return status;
}
