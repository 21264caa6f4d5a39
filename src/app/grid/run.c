/* A run of the depth-averaged model from scene to summary. */
#include "app/check/team.h"
#include "app/checkpoint/lock.h"
#include "app/cluster/cluster.h"
#include "app/grid/record.h"
#include "app/grid/report.h"
#include "app/run/parts.h"
#include "base/stop.h"
#include "output/plots/plots.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

enum { LOG_STEPS = 100, SPEED_STEPS = 20 }; /* steps between lines of the log, between looks at the speed */

/* r: directory, log and progress, as those of a run with particles. */
typedef struct grid_run {
    run r;
    sb_offshore *water;
    sb_grid_facts facts;
    sb_offshore_told_list told;
    sb_grid_record record;
    double setup, speed; /* s; m/s, greatest speed lately */
    uint64_t iterations;
    size_t breaking;
} grid_run;

static void warn(void *context, const char *text)
{
    sb_run_warn(context, "%s", text);
}

static sb_status open_directory(run *r, const sb_run_options *options, sb_error *error)
{
    if (options->resume)
        return sb_fail(error, SB_BAD_INPUT,
                       "--resume: a run of offshore has no checkpoints, expected --overwrite, or a new directory");
    if (options->live_port > 0)
        return sb_fail(error, SB_BAD_INPUT,
                       "--live: a run of offshore is not shown in browsers, expected a scene without offshore");
    r->made_directory = access(r->directory, F_OK) != 0;
    sb_status status = sb_make_directories(r->directory, error);
    if (status == SB_OK) status = sb_lock_directory(r->directory, "another directory", &r->lock, error);
    return status == SB_OK ? sb_run_check_directory(r, options, error) : status;
}

static sb_status take_directory(run *r, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_run_path(r, "scene.yaml", path, error);
    if (status == SB_OK) status = sb_scene_write(r->scene, path, error);
    if (status == SB_OK && r->earlier.count > 0)
        sb_run_report(r, "%s: the files of the earlier run are removed, and a new run starts", r->directory);
    if (status == SB_OK) status = sb_run_files_remove(r->directory, &r->earlier, error);
    if (status == SB_OK) status = sb_run_path(r, "run.jsonl", path, error);
    if (status == SB_OK) status = sb_runlog_open(path, &r->log, error);
    if (status == SB_OK) status = sb_run_path(r, "summary.json", path, error);
    return status == SB_OK ? sb_summary_write_running(path, r->scene, error) : status;
}

static sb_status start(grid_run *g, const sb_run_options *options, sb_error *error)
{
    run *r = &g->r;
    sb_status status = open_directory(r, options, error);
    if (status == SB_OK) status = sb_grid_water_create(r->scene, &g->water, &g->facts, &g->told, error);
    if (status == SB_OK) status = take_directory(r, error);
    if (status != SB_OK) return status;
    sb_team_warnings(warn, r);
    sb_grid_water_warnings(r->scene, &g->facts, &g->told, warn, r);
    sb_run_report(r, "%zu x %zu cells of %g m, %zu wet, up to %g m deep, %s", g->facts.columns, g->facts.rows,
                  r->scene->offshore.cell, g->facts.wet, g->facts.deepest,
                  r->scene->offshore.dispersion ? "Serre-Green-Naghdi" : "shallow water");
    sb_runlog_event(r->log, "start", "shorebreak %s, offshore: %zu x %zu cells of %g m, %zu wet, %s, %d threads",
                    SB_VERSION, g->facts.columns, g->facts.rows, r->scene->offshore.cell, g->facts.wet,
                    r->scene->offshore.dispersion ? "Serre-Green-Naghdi" : "shallow water", omp_get_max_threads());
    status = sb_grid_record_begin(&g->record, r->scene, r->directory, g->water, error);
    g->setup = sb_progress_wall(&r->progress);
    sb_progress_resume(&r->progress, 0);
    return status;
}

static double fastest(const sb_offshore *water)
{
    const sb_offshore_view v = sb_offshore_read(water);
    double square = 0;
    for (size_t j = 0; j < v.rows; j++)
        for (size_t i = 0; i < v.columns; i++) {
            const size_t at = j * v.stride + i;
            const double h = v.h[at];
            if (h > 10 * v.dry_depth) square = fmax(square, (v.hu[at] * v.hu[at] + v.hv[at] * v.hv[at]) / (h * h));
        }
    return sqrt(square);
}

static void report_step(grid_run *g, double taken)
{
    const sb_offshore_effort effort = sb_offshore_find_effort(g->water);
    g->iterations += effort.iterations;
    g->breaking = effort.breaking > g->breaking ? effort.breaking : g->breaking;
    if (effort.steps % SPEED_STEPS == 1) g->speed = fastest(g->water);
    const sb_step_report report = {.step = effort.steps,
                                   .time = sb_offshore_read(g->water).time,
                                   .time_step = taken,
                                   .iterations = (int)effort.iterations,
                                   .max_speed = g->speed};
    sb_progress_update(&g->r.progress, &report);
    if (effort.steps % LOG_STEPS != 0) return;
    const sb_offshore_balance balance = sb_offshore_find_balance(g->water);
    sb_run_ensure_log(&g->r);
    sb_runlog_event(
        g->r.log, "step",
        "step %llu, t = %.9g s, dt = %.4g s, volume %.12g m3, imbalance %.3g m3, %llu iterations, %zu cells "
        "breaking",
        (unsigned long long)effort.steps, report.time, taken, balance.now, sb_grid_imbalance(&balance),
        (unsigned long long)effort.iterations, effort.breaking);
}

static sb_status advance(grid_run *g, sb_error *error)
{
    const double duration = g->r.scene->duration;
    double time = 0, taken;
    while (time < duration * (1 - 1e-12)) {
        if (sb_stop_signal())
            return sb_fail(error, SB_INTERRUPTED, "stopped by a %s at t = %g s", sb_stop_cause(), time);
        sb_status status = sb_offshore_step(g->water, duration - time, &taken, error);
        if (status == SB_OK) status = sb_grid_record_step(&g->record, g->water, taken, error);
        if (status == SB_OK) status = sb_runlog_check(g->r.log, error);
        if (status != SB_OK) return status;
        time = sb_offshore_read(g->water).time;
        report_step(g, taken);
    }
    return SB_OK;
}

static void keep_first(sb_status *status, sb_error *error, sb_status found, const sb_error *reason)
{
    if (found == SB_OK || *status == SB_FAILED) return;
    *status = found;
    *error = *reason;
}

static sb_status write_summary(const grid_run *g, sb_status status, const char *reason, sb_error *error)
{
    char path[SB_PATH_MAX];
    const double wall = sb_progress_wall(&g->r.progress);
    const sb_grid_summary summary = {.scene = g->r.scene,
                                     .water = g->water,
                                     .facts = &g->facts,
                                     .status = status,
                                     .reason = status == SB_OK ? NULL : reason,
                                     .wall = wall,
                                     .processor = (double)clock() / CLOCKS_PER_SEC,
                                     .setup = g->setup,
                                     .stepping = wall - g->setup,
                                     .iterations = g->iterations,
                                     .breaking = g->breaking,
                                     .frames = g->record.frames.count,
                                     .threads = omp_get_max_threads()};
    const sb_status found = sb_run_path(&g->r, "summary.json", path, error);
    return found == SB_OK ? sb_grid_summary_write(path, &summary, error) : found;
}

static void finish(grid_run *g, sb_status *status, sb_error *error)
{
    run *r = &g->r;
    sb_error reason = {0};
    if (!r->log) return;
    const sb_offshore_effort effort = sb_offshore_find_effort(g->water);
    const sb_step_report last = {.step = effort.steps,
                                 .time = sb_offshore_read(g->water).time,
                                 .iterations = (int)effort.iterations,
                                 .max_speed = fastest(g->water)};
    sb_progress_end(&r->progress, &last);
    keep_first(status, error, sb_grid_record_end(&g->record, g->water, &reason), &reason);
    keep_first(status, error, write_summary(g, *status, error->text, &reason), &reason);
    if (r->scene->output.plots) sb_plots_write(r->directory, r->scene, r->log);
    sb_runlog_end(r->log, *status, *status == SB_OK ? NULL : error->text);
    keep_first(status, error, sb_runlog_close(r->log, &reason), &reason);
}

sb_status sb_grid_run(const sb_scene *scene, const char *directory, const sb_run_options *options, sb_error *error)
{
    grid_run g = {.r = {.resolved = *scene, .directory = directory, .lock = -1}};
    sb_error local = {0};
    g.r.scene = &g.r.resolved;
    sb_progress_begin(&g.r.progress, options->quiet ? NULL : stdout, scene->duration);
    sb_cluster_watch();
    sb_status status = start(&g, options, &local);
    if (status == SB_OK) status = advance(&g, &local);
    finish(&g, &status, &local);
    sb_particle_list_free(&g.record.frames);
    sb_offshore_destroy(g.water);
    sb_offshore_told_free(&g.told);
    sb_run_files_free(&g.r.earlier);
    if (g.r.made_directory && status != SB_OK) rmdir(directory); /* fails, as it should, if there are files */
    if (g.r.lock >= 0) close(g.r.lock);
    if (status != SB_OK && error) *error = local;
    return status;
}
