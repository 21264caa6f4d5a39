/* After the last step: completes all files of the run, however it ended. */
#include "app/cluster/cluster.h"
#include "app/frames/missed.h"
#include "app/grid/maps.h"
#include "app/grid/report.h"
#include "app/run/parts.h"
#include "app/run/spent.h"
#include "app/steering/steering.h"
#include "base/memory.h"
#include "base/stop.h"
#include "output/log/summary.h"
#include "output/maps/maps.h"
#include "output/plots/plots.h"
#include "output/plots/video.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>

static void keep_first(sb_status *status, sb_error *error, sb_status found, const sb_error *reason)
{
    if (found == SB_OK || *status == SB_FAILED) return;
    *status = found;
    *error = *reason;
}

/* Logs the time and memory saved by leaving out what the scene does not need. */
static void log_saved(run *r)
{
    const sb_skipped *const lists[] = {sb_sim_skipped(r->sim), r->measure ? sb_measure_skipped(r->measure) : NULL,
                                       r->off};
    const sb_stage_time *stages;
    const size_t count = sb_sim_stages(r->sim, &stages);
    const sb_saved saved = sb_saved_sum(lists, sizeof lists / sizeof *lists, stages, count);
    sb_runlog_saved(r->log, &saved);
}

/* Writes the state before the step that failed, so that the user can examine the failure. */
static void write_last_state(run *r)
{
    const sb_particle_format *format = &sb_particles_vtp;
    char path[SB_PATH_MAX], name[SB_PARTICLE_NAME_MAX];
    sb_error reason = {0};
    sb_frame *frame = sb_cluster_snapshot(r);
    if (!frame) return;
    sb_particle_format_file(format, 0, name);
    if (sb_make_folder(path, r->directory, SB_PARTICLE_FOLDER, &reason) == SB_OK &&
        sb_run_path(r, name, path, &reason) == SB_OK && format->write(path, frame, 0, &reason) == SB_OK)
        sb_runlog_event(r->log, "last_good_state", "%s", name);
    else
        sb_run_warn(r, "%s", reason.text);
    sb_frame_release(frame);
}

/* Counts the particles within solids by the winding numbers of the meshes, independently of boundary particles. */
static sb_status count_inside(run *r, sb_error *error)
{
    sb_frame *frame = sb_cluster_snapshot(r);
    sb_vec3 *displacement = sb_alloc(r->model.body_count, sizeof *displacement);
    sb_inside_report any = {0}, deep = {0};
    sb_status status = SB_OK;
    if (!frame || !displacement) {
        status = sb_fail_memory(error, "the count of particles within solids");
        goto done;
    }
    for (size_t b = 0; b < r->model.body_count; b++) displacement[b] = frame->bodies[b].displacement;
    /* Boundary particles lie behind the physical surface by the offset; a particle beyond them has crossed the wall. */
    double boundary_depth = fmax(r->scene->numerics.wall_offset, 0.5) * r->scene->resolution;
    status =
        sb_model_first_inside(&r->model, frame->position, frame->count, frame->origin, displacement, 0, &any, error);
    if (status == SB_OK)
        status = sb_model_first_inside(&r->model, frame->position, frame->count, frame->origin, displacement,
                                       boundary_depth, &deep, error);
    if (status != SB_OK) goto done;
    r->inside_known = true;
    r->inside = any.count;
    r->crossed = deep.count;
    sb_runlog_event(r->log, "walls", "%zu particle centres within solids, %zu of them beyond the boundary particles",
                    any.count, deep.count);
    if (deep.count > 0) {
        const float *at = frame->position + 3 * deep.first;
        sb_run_warn(r, "%zu particles passed through walls, the first %.3g m into \"%.63s\" near (%.5g, %.5g, %.5g) m",
                    deep.count, deep.depth, r->model.bodies[deep.body].name, frame->origin.x + (double)at[0],
                    frame->origin.y + (double)at[1], frame->origin.z + (double)at[2]);
    }
done:
    sb_free(displacement);
    sb_frame_release(frame);
    return status;
}

/* Largest share of the particles that may be lost through walls. Lost water reduces forces and depths; above this share
   they count as wrong, and the run fails. */
static const double LOST_MAX = 0.01;

static uint64_t lost_of(const run *r, char *text, size_t size)
{
    const uint64_t lost = r->sim ? sb_sim_report(r->sim)->lost : 0;
    snprintf(text, size, "%llu of %zu particles were lost through walls of the domain", (unsigned long long)lost,
             r->model.fluid_count);
    return lost;
}

/* Fails the run when too much water was lost; returns whether it does. Call it before the summary is written. */
static bool check_lost(const run *r, sb_status *status, sb_error *error)
{
    char text[120];
    const double lost = (double)lost_of(r, text, sizeof text);
    const bool fails = *status == SB_OK && lost > LOST_MAX * (double)r->model.fluid_count;
    if (fails)
        *status =
            sb_fail(error, SB_FAILED, "%s, more than %g %%: its forces and depths are wrong", text, 100 * LOST_MAX);
    return fails;
}

static void report_lost(run *r)
{
    char text[120];
    if (lost_of(r, text, sizeof text) > 0) sb_run_warn(r, "%s", text);
}

/* Share of all steps: more that end above the tolerance are no single impacts. */
static const double CAPPED_MAX = 0.02;

static void warn_of_capped(run *r)
{
    const uint64_t steps = sb_sim_report(r->sim)->step;
    if (!((double)r->capped > CAPPED_MAX * (double)steps)) return;
    sb_run_warn(r,
                "in %llu of %llu steps the pressure solve stopped at numerics.max_iterations, above its tolerance: "
                "pressures, forces and the water's volume are doubtful; expected a larger max_iterations, or a larger "
                "tolerance",
                (unsigned long long)r->capped, (unsigned long long)steps);
}

/* Particle spacings. A thinner layer is only single particles. */
static const double FILM = 0.25;

/* Warns of gauges that recorded no value although water arrived. Gauges over water that was thin at the start have a
   warning already. */
static void warn_of_gauges(run *r)
{
    const sb_measure_settings *settings = &r->scene->measure;
    for (size_t i = 0; i < settings->gauge_count; i++) {
        const double depth = sb_measure_gauge_missed(r->measure, i);
        if (!(depth > FILM * r->scene->resolution) || (r->model.shallow && r->model.shallow[i])) continue;
        sb_run_warn(
            r,
            "gauge \"%s\": all its values are empty although water arrived: it was at most about %.2g m deep there, "
            "too thin for the particle spacing of %g m; expected a resolution of about %.2g m or less",
            settings->gauges[i].name, depth, r->scene->resolution, depth);
    }
}

static void stop_consumers(run *r, sb_status *status, sb_error *error)
{
    for (int c = 0; c < CONSUMERS; c++) {
        sb_consumer *consumer = &r->consumers[c];
        if (!consumer->started) continue;
        uint64_t dropped = sb_frame_queue_dropped(consumer->queue);
        double waited = sb_frame_queue_waited(consumer->queue), processor = sb_consumer_processor(consumer);
        sb_consumer_stop(consumer);
        sb_runlog_event(r->log, "consumer",
                        "%s: %llu frames, %llu missed, %llu dropped, simulation waited %.2f s, processor %.3f s",
                        consumer->work.name, (unsigned long long)consumer->handled,
                        (unsigned long long)consumer->trouble.missed, (unsigned long long)dropped, waited, processor);
        if (consumer->given_up && consumer->work.stop_timeout > 0)
            sb_run_warn(r,
                        "%s: timed out after %g s: the receiver accepts no more data, and the last frames are not sent",
                        consumer->work.name, consumer->work.stop_timeout);
        sb_error reason = {0};
        keep_first(status, error, sb_missed_check(r, c, &reason), &reason);
    }
    sb_missed_report(r);
}

/* One per body, which the caller frees; NULL without a paddle that absorbs. Warns of those that were stopped. */
static sb_absorption *find_absorptions(run *r)
{
    sb_absorption *all = NULL;
    for (size_t b = 0; b < r->model.body_count; b++) {
        const sb_absorption one = sb_sim_absorption(r->sim, b);
        if (!one.absorbs) continue;
        if (!all) all = sb_alloc(r->model.body_count, sizeof *all);
        if (!all) return NULL;
        all[b] = one;
        sb_runlog_event(r->log, "absorber",
                        "%s: %.4g m from its law at the end, at most %.4g m; mean of the last whole ten periods, or of "
                        "the run so far, %.3g m; %llu "
                        "steps at its reach",
                        r->model.bodies[b].name, one.offset, one.farthest, one.drift, (unsigned long long)one.limited);
        if (one.limited > 0)
            sb_run_warn(r,
                        "the absorbing paddle \"%.63s\" was stopped at its reach, or at a side of the domain, in %llu "
                        "steps, in which it reflected waves: expected a larger reach and room for it, or lower waves",
                        r->model.bodies[b].name, (unsigned long long)one.limited);
    }
    return all;
}

static sb_grid_facts_beside grid_facts(const sb_offshore *water)
{
    const sb_offshore_view v = sb_offshore_read(water);
    return (sb_grid_facts_beside){v.columns, v.rows, v.cell, sb_offshore_find_effort(water).steps,
                                  sb_grid_volume_of(water)};
}

/* Heights, periods and harmonics of a gauge that falls dry are those of its rows with water. */
static void warn_of_dry_gauges(run *r, const sb_gauge_waves *waves)
{
    const sb_measure_settings *m = &r->scene->measure;
    size_t count = 0, worst = 0;
    for (size_t g = 0; g < m->gauge_count; g++) {
        if (waves[g].rows == 0 || waves[g].dry == 0) continue;
        if (count == 0 || waves[g].dry > waves[worst].dry) worst = g;
        count++;
    }
    if (count == 0) return;
    char others[64] = "";
    if (count > 1) snprintf(others, sizeof others, " (so have %zu more, in as many rows or fewer)", count - 1);
    sb_run_warn(r,
                "waves.csv: gauge \"%.63s\" has no water in %zu of %zu rows%s, and its figures are those of the "
                "others; expected a gauge in deeper water, or another measure.waves.start",
                m->gauges[worst].name, waves[worst].dry, waves[worst].dry + waves[worst].rows, others);
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
        .spent = sb_spent_sum(r),
        .simulated = report->time,
        .steps = report->step,
        .iterations = r->iterations,
        .capped_steps = r->capped,
        .compression = r->compression,
        .compression_max = r->compression_max,
        .fluid_particles = r->model.fluid_count,
        .bytes = sb_cluster_bytes(r),
        .lost = report->lost,
        .left_domain = report->left_domain,
        .departures = sb_sim_departures(r->sim),
        .has_inside = r->inside_known,
        .inside = r->inside,
        .crossed = r->crossed,
        .threads = omp_get_max_threads(),
        .ranks = sb_ranks_count(r->cluster.ranks),
        .bodies = r->measure ? sb_measure_bodies(r->measure) : NULL,
        .first = r->first_energy,
        .last = sb_cluster_energy(r),
        .hash = sb_cluster_hash(r),
        .frames = r->recorder.count,
        .pictures = r->pictures.film.count,
        .frames_missing = sb_missed_sum(r, RECORDER).count,
        .pictures_missing = sb_missed_sum(r, PICTURES).count,
    };
    summary.work = sb_sim_ledger(r->sim);
    if (sb_scene_has_sea(r->scene)) {
        summary.crossing = sb_sim_crossing(r->sim);
        summary.particle_mass = sb_sim_particle_mass(r->sim);
    }
    sb_grid_facts_beside grid;
    if (sb_sim_grid(r->sim)) {
        grid = grid_facts(sb_sim_grid(r->sim));
        summary.grid = &grid;
    }
    sb_absorption *absorptions = find_absorptions(r);
    summary.absorptions = absorptions;
    sb_gauge_waves *waves = NULL;
    if (r->measure && r->scene->measure.waves.present &&
        sb_wave_table_write(r->directory, r->scene, &waves, &reason) != SB_OK)
        sb_run_warn(r, "waves.csv: %s", reason.text);
    if (waves) warn_of_dry_gauges(r, waves);
    summary.waves = waves;
    sb_overtopping_rate *rates = NULL;
    if (r->measure && sb_overtopping_wanted(r->scene) &&
        sb_overtopping_write(r->directory, r->scene, &rates, &reason) != SB_OK)
        sb_run_warn(r, "eurotop.csv: %s", reason.text);
    summary.rates = rates;
    sb_status found = sb_run_path(r, "summary.json", path, &reason);
    if (found == SB_OK && r->measure)
        found = sb_measure_reflections(r->measure, &summary.reflections, &summary.reflection_count, &reason);
    if (found == SB_OK) found = sb_summary_write(path, &summary, &reason);
    sb_free(absorptions);
    sb_free(waves);
    sb_free(rates);
    /* An earlier failure stays the reason. This failure is still reported, because the summary on disk says "running".
     */
    if (found != SB_OK && *status == SB_FAILED) sb_run_warn(r, "%s", reason.text);
    keep_first(status, error, found, &reason);
}

/* Makes films from all pictures. This can take minutes, so a run that was stopped by a signal skips it; the films are
   made when the run is resumed. */
static sb_status make_films(const run *r, sb_status status, sb_error *error)
{
    if (r->scene->render.camera_count == 0 || r->pictures.film.count <= 1 || !r->scene->render.video) return SB_OK;
    if (status == SB_INTERRUPTED) {
        sb_runlog_event(r->log, "skipped", "films: the run was stopped; they are made when it is resumed and ends");
        return SB_OK;
    }
    for (size_t c = 0; c < r->scene->render.camera_count && !sb_stop_signal(); c++)
        sb_video_write(r->directory, r->scene->render.cameras[c].name, r->pictures.film.count,
                       r->scene->render.video_rate, r->log);
    return sb_stop_signal()
               ? sb_stop_fail(error,
                              "while films were made; all other files are complete, and --resume makes the films")
               : SB_OK;
}

/* The maps of the depth-averaged water that is the sea. */
static void write_grid_maps(const run *r, sb_status *status, sb_error *error)
{
    sb_error reason = {0};
    const sb_offshore_maps *maps = r->measure ? sb_sim_grid_maps(r->sim) : NULL;
    if (!maps) return;
    const sb_status found = sb_grid_maps_write(r->directory, sb_sim_grid(r->sim), maps, r->scene, &reason);
    keep_first(status, error, found, &reason);
}

void sb_run_finish(run *r, sb_status *status, sb_error *error)
{
    sb_error reason = {0};
    sb_run_ensure_log(r);
    if (r->sim && *status == SB_FAILED) write_last_state(r);
    sb_steering_end(r);
    stop_consumers(r, status, error);
    if (r->sim) keep_first(status, error, count_inside(r, &reason), &reason);
    if (r->csv) keep_first(status, error, sb_csv_close(r->csv, &reason), &reason);
    if (r->sim) {
        sb_run_log_step(r);
        sb_cluster_log(r);
        log_saved(r);
        sb_progress_end(&r->progress, sb_sim_report(r->sim));
    }
    if (r->measure) {
        warn_of_gauges(r);
        warn_of_capped(r);
        sb_runlog_bodies(r->log, &r->model, sb_measure_bodies(r->measure));
        const sb_map_record *map = sb_measure_map(r->measure);
        if (map) keep_first(status, error, sb_maps_write(r->directory, map, false, &reason), &reason);
    }
    write_grid_maps(r, status, error);
    const bool leaked = check_lost(r, status, error);
    if (r->sim) /* before plots and films, which take long: a user may stop the process then */
        write_summary(r, status, error);
    sb_cluster_dismiss(r); /* plots and films take long */
    if (r->measure && r->scene->output.plots) sb_plots_write(r->directory, r->scene, r->log);
    keep_first(status, error, make_films(r, *status, &reason), &reason);
    sb_steering_close(r);
    if (!leaked) report_lost(r); /* otherwise the failure's reason is the last line */
    sb_runlog_end(r->log, *status, *status == SB_OK ? NULL : error->text);
    keep_first(status, error, sb_runlog_close(r->log, &reason), &reason);
}
