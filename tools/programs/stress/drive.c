#include "drive.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/log/summary.h"
#include "trial.h"

#include <math.h>

enum { CHECK_INTERVAL = 25 }; /* steps between checks of every particle */

const sb_drive sb_drive_plain = {0};

/* Counts particles behind the boundary particles of sides that are walls: those sides have no mesh. */
static uint64_t beyond_sides(const sb_driven *d, const sb_frame *frame, double depth)
{
    const sb_vec3 min = d->scene.domain.min, max = d->scene.domain.max;
    const double bound[SB_SIDES] = {min.x, max.x, min.y, max.y, min.z, max.z};
    const double origin[] = {frame->origin.x, frame->origin.y, frame->origin.z};
    uint64_t beyond = 0;
    for (size_t i = 0; i < frame->count; i++) {
        bool out = false;
        for (size_t s = 0; s < SB_SIDES; s++) {
            const double at = origin[s / 2] + (double)frame->position[3 * i + s / 2];
            if (d->scene.domain.side[s] != SB_SIDE_WALL || (s / 2 == 1 && d->scene.dimensions == 2)) continue;
            out |= (s % 2 ? at - bound[s] : bound[s] - at) > depth;
        }
        beyond += out;
    }
    return beyond;
}

static void check_particles(sb_driven *d)
{
    uint64_t bad = 0;
    sb_frame *frame = sb_sim_snapshot(d->sim);
    for (size_t i = 0; frame && i < 3 * frame->count; i++)
        bad += !isfinite(frame->position[i]) || !isfinite(frame->velocity[i]) || !isfinite(frame->pressure[i / 3]);
    if (bad > d->not_finite) d->not_finite = bad;
    sb_vec3 *moved = sb_alloc(d->model.body_count, sizeof *moved);
    for (size_t b = 0; moved && b < d->model.body_count; b++) moved[b] = sb_sim_body_displacement(d->sim, b);
    const double depth = fmax(d->scene.numerics.wall_offset, 0.5) * d->scene.resolution;
    sb_inside_report any = {0}, deep = {0};
    if (frame && moved && !bad &&
        sb_model_first_inside(&d->model, frame->position, frame->count, frame->origin, moved, 0, &any, NULL) == SB_OK &&
        sb_model_first_inside(&d->model, frame->position, frame->count, frame->origin, moved, depth, &deep, NULL) ==
            SB_OK) {
        if (any.count > d->inside) d->inside = any.count;
        deep.count += beyond_sides(d, frame, depth);
        if (deep.count > d->through) d->through = deep.count;
    }
    sb_free(moved);
    sb_frame_release(frame);
}

static void add_step(sb_driven *d)
{
    const sb_step_report *r = sb_sim_report(d->sim);
    d->iterations += (uint64_t)r->iterations;
    d->capped += r->capped;
    d->error_sum += r->error_mean;
    d->momentum_imbalance = fmax(d->momentum_imbalance, r->momentum_imbalance);
    if (!r->capped && r->tolerance > 0) d->error_share = fmax(d->error_share, r->error_mean / r->tolerance);
    if (!r->capped && !(r->error_mean <= r->tolerance)) d->unreported++;
    const sb_energy e = sb_sim_energy(d->sim);
    d->energy_peak = fmax(d->energy_peak, e.kinetic + e.potential);
    d->top_speed = fmax(d->top_speed, r->max_speed);
    if (r->time > 0.5 * d->scene.duration && e.mass > 0) {
        d->late_speed += sqrt(2 * e.kinetic / e.mass);
        d->late_samples += 1;
    }
    if (!isfinite(e.kinetic + e.potential) || !isfinite(r->max_speed) || !isfinite(r->error_mean)) d->not_finite++;
}

static sb_status advance(sb_driven *d, const sb_drive *drive, sb_error *error)
{
    sb_status status = SB_OK;
    const sb_step_report *r = sb_sim_report(d->sim);
    while (status == SB_OK && r->time < d->scene.duration * (1 - 1e-12) && r->fluid_count > 0) {
        d->last_time = r->time;
        status = sb_sim_step(d->sim, error);
        if (status != SB_OK) break;
        add_step(d);
        if (drive->watch) drive->watch(d);
        if (r->step % CHECK_INTERVAL == 0) check_particles(d);
    }
    check_particles(d);
    return status;
}

/* Writes the keys of a run's summary.json, and those that only a driven run can measure. */
static void put_all(sb_driven *d, sb_json *json, const sb_drive *drive, double wall)
{
    const sb_step_report *r = sb_sim_report(d->sim);
    const sb_energy last = sb_sim_energy(d->sim);
    sb_json_open(json, NULL, '{');
    sb_json_number(json, "wall_s", wall);
    sb_json_number(json, "simulated_s", r->time);
    sb_json_count(json, "steps", r->step);
    sb_json_number(json, "resolution_m", d->scene.resolution);
    sb_json_count(json, "fluid_particles", d->model.fluid_count);
    sb_json_number(json, "mean_iterations", r->step ? (double)d->iterations / (double)r->step : 0);
    sb_json_count(json, "capped_steps", d->capped);
    sb_json_count(json, "lost_particles", r->lost);
    sb_json_count(json, "inside_solids", d->inside);
    sb_json_count(json, "through_walls", d->through);
    sb_json_count(json, "left_domain", r->left_domain);
    sb_json_count(json, "unreported_solves", d->unreported);
    sb_json_count(json, "not_finite", d->not_finite);
    sb_json_number(json, "mean_density_error", r->step ? d->error_sum / (double)r->step : 0);
    sb_json_number(json, "error_over_tolerance", d->error_share);
    sb_json_number(json, "momentum_imbalance", d->momentum_imbalance);
    sb_json_number(json, "top_speed", d->top_speed);
    sb_json_number(json, "still_depth_m", d->model.still_depth);
    sb_json_number(json, "energy_peak_J", d->energy_peak);
    sb_json_number(json, "late_rms_speed", d->late_samples > 0 ? d->late_speed / d->late_samples : (double)NAN);
    sb_json_number(json, "wave_speed", sqrt(d->scene.fluid.gravity * d->model.still_depth));
    sb_json_number(json, "gravity", d->scene.fluid.gravity);
    sb_summary_put_energy(json, "energy_start", &d->first);
    sb_summary_put_energy(json, "energy_end", &last);
    sb_summary_put_work(json, sb_sim_ledger(d->sim));
    if (drive->close) drive->close(d, json);
    sb_json_close(json);
}

static sb_status write_summary(sb_driven *d, const sb_drive *drive, const char *folder, double wall, sb_error *error)
{
    sb_atomic_file file;
    sb_json json;
    sb_status status = sb_atomic_open_in(&file, folder, "summary.json", error);
    if (status != SB_OK) return status;
    sb_json_begin(&json, file.stream, true);
    put_all(d, &json, drive, wall);
    return sb_atomic_commit(&file, 0, error);
}

sb_status sb_drive_run(const sb_trial *trial, const char *assets, const char *folder, sb_error *error)
{
    sb_driven d = {.number = trial->number};
    const double start = sb_clock();
    sb_status status = sb_trial_scene(trial, assets, &d.scene, error);
    if (status == SB_OK) status = sb_model_build(&d.scene, &d.model, error);
    if (status == SB_OK && trial->drive->alter) status = trial->drive->alter(&d, error);
    if (status == SB_OK) status = sb_sim_create(&d.scene, &d.model, NULL, &d.sim, error);
    if (status == SB_OK) status = sb_sim_settle(d.sim, error);
    if (status == SB_OK) {
        d.first = sb_sim_energy(d.sim);
        d.energy_peak = d.first.kinetic + d.first.potential;
        status = advance(&d, trial->drive, error);
    }
    if (d.sim) {
        sb_status written = write_summary(&d, trial->drive, folder, sb_clock() - start, error);
        if (status == SB_OK) status = written;
    }
    sb_sim_destroy(d.sim);
    sb_model_free(&d.model);
    sb_scene_free(&d.scene);
    return status;
}
