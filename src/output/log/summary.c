#include "output/log/summary.h"

#include "base/file.h"
#include "base/memory.h"
#include "output/log/trust.h"
#include "physics/records/reflection.h"
#include "scene/presets.h"

static double ratio(double a, double b)
{
    return b > 0 ? a / b : 0;
}

/* The box around the body at t = 0. */
static void put_box(sb_json *json, const sb_model *model, size_t body)
{
    sb_vec3 min, max;
    if (!sb_model_box(model, body, &min, &max)) return;
    sb_json_vector(json, "min_m", min);
    sb_json_vector(json, "max_m", max);
}

static void put_bodies(sb_json *json, const sb_summary *summary)
{
    sb_json_open(json, "bodies", '[');
    for (size_t b = 0; summary->bodies && b < summary->model->body_count; b++) {
        const sb_body_record *body = &summary->bodies[b];
        if (!body->report) continue;
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "name", summary->model->bodies[b].name);
        sb_json_number(json, "peak_N", body->peak);
        sb_json_number(json, "peak_time_s", body->peak_time);
        sb_json_number(json, "impulse_Ns", sb_norm(body->impulse));
        sb_json_vector(json, "impulse_vector_Ns", body->impulse);
        sb_json_vector(json, "moment_impulse_Nms", body->moment);
        sb_json_vector(json, "moment_point_m", summary->model->bodies[b].moment_point);
        put_box(json, summary->model, b);
        sb_trust_put(json, &summary->model->bodies[b], body);
        sb_json_close(json);
    }
    sb_json_close(json);
}

void sb_summary_put_energy(sb_json *json, const char *key, const sb_energy *energy)
{
    sb_json_open(json, key, '{');
    sb_json_number(json, "kinetic_J", energy->kinetic);
    sb_json_number(json, "potential_J", energy->potential);
    sb_json_number(json, "mass_kg", energy->mass);
    sb_json_vector(json, "momentum_kg_m_s", energy->momentum);
    sb_json_close(json);
}

void sb_summary_put_work(sb_json *json, const sb_ledger *work)
{
    sb_json_open(json, "energy_work", '{');
    sb_json_number(json, "bodies_J", work->bodies);
    sb_json_number(json, "viscosity_J", work->viscosity);
    sb_json_number(json, "wall_friction_J", work->friction);
    sb_json_number(json, "pressure_solve_J", work->pressure);
    sb_json_number(json, "contact_J", work->contact);
    sb_json_number(json, "time_integration_J", work->integration);
    sb_json_number(json, "left_domain_J", work->left);
    sb_json_number(json, "packing_stress_J", work->stress);
    sb_json_number(json, "sea_J", work->sea);
    sb_json_number(json, "sponge_J", work->sponge);
    sb_json_number(json, "surface_tension_J", work->tension);
    sb_json_close(json);
}

static void put_crossing(sb_json *json, const sb_crossing *c, double mass)
{
    sb_json_open(json, "sea", '{');
    sb_json_number(json, "in_kg", (double)c->in * mass);
    sb_json_number(json, "out_kg", (double)c->out * mass);
    sb_json_vector(json, "carried_kg_m_s", c->momentum);
    sb_json_vector(json, "held_kg_m_s", c->push);
    sb_json_number(json, "carried_J", c->energy);
    sb_json_number(json, "held_J", c->held);
    sb_json_close(json);
}

/* The list "absorbers" of the paddles that absorb; nothing without one. */
static void put_absorptions(sb_json *json, const sb_summary *s)
{
    bool open = false;
    for (size_t b = 0; s->absorptions && b < s->model->body_count; b++) {
        const sb_absorption *a = &s->absorptions[b];
        if (!a->absorbs) continue;
        if (!open) sb_json_open(json, "absorbers", '[');
        open = true;
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "body", s->model->bodies[b].name);
        sb_json_number(json, "offset_m", a->offset);
        sb_json_number(json, "farthest_m", a->farthest);
        sb_json_number(json, "drift_m", a->drift);
        sb_json_number(json, "largest_drift_m", fmax(a->drift_most, fabs(a->drift)));
        sb_json_count(json, "limited_steps", a->limited);
        if (a->plates > 0) {
            sb_json_count(json, "plates", a->plates);
            sb_json_number(json, "apart_m", a->apart);
        }
        sb_json_close(json);
    }
    if (open) sb_json_close(json);
}

static void put_waves(sb_json *json, const sb_summary *s)
{
    sb_json_open(json, "waves", '[');
    for (size_t g = 0; g < s->scene->measure.gauge_count; g++) {
        const sb_wave_heights *h = &s->waves[g].heights;
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "gauge", s->scene->measure.gauges[g].name);
        sb_json_number(json, "from_s", s->waves[g].from);
        sb_json_number(json, "to_s", s->waves[g].to);
        sb_json_count(json, "waves", h->count);
        sb_json_number(json, "mean_z_m", h->level);
        sb_json_number(json, "mean_height_m", h->mean);
        sb_json_number(json, "significant_height_m", h->significant);
        sb_json_number(json, "highest_m", h->highest);
        sb_json_number(json, "mean_period_s", h->period);
        sb_json_number(json, "spectral_height_m", h->spectral);
        sb_json_number(json, "crest_z_m", h->crest);
        sb_json_number(json, "crest_s", h->crest_time);
        sb_json_number(json, "trough_z_m", h->trough);
        sb_json_number(json, "trough_s", h->trough_time);
        sb_json_open(json, "harmonics_m", '[');
        for (int k = 0; k < sb_wave_table_harmonics(s->scene); k++) sb_json_number(json, NULL, s->waves[g].harmonic[k]);
        sb_json_close(json);
        sb_json_close(json);
    }
    sb_json_close(json);
}

static void put_rates(sb_json *json, const sb_summary *s)
{
    sb_json_open(json, "overtopping", '[');
    for (size_t p = 0; p < s->scene->measure.plane_count; p++) {
        const sb_flow_plane *plane = &s->scene->measure.planes[p];
        const sb_overtopping_rate *r = &s->rates[p];
        if (!(plane->eurotop.height > 0)) continue;
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "plane", plane->name);
        sb_json_number(json, "from_s", r->from);
        sb_json_number(json, "to_s", r->to);
        sb_json_number(json, "rate_m2_s", r->rate);
        sb_json_number(json, "eurotop_m2_s", r->formula);
        sb_json_number(json, "freeboard_m", r->freeboard);
        sb_json_number(json, "height_m", plane->eurotop.height);
        sb_json_close(json);
    }
    sb_json_close(json);
}

static void put_reflections(sb_json *json, const sb_summary *s)
{
    sb_json_open(json, "reflections", '[');
    for (size_t i = 0; i < s->reflection_count; i++) {
        const sb_reflection_record *row = &s->reflections[i];
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "name", s->scene->measure.reflections[row->set].name);
        sb_json_number(json, "from_s", row->from);
        sb_json_number(json, "to_s", row->time);
        sb_json_number(json, "period_s", row->period);
        sb_json_number(json, "incident_m", row->incident);
        sb_json_number(json, "reflected_m", row->reflected);
        sb_json_number(json, "coefficient", row->reflected / row->incident);
        sb_json_number(json, "misfit_m", row->misfit);
        sb_json_bool(json, "distinct", row->separation >= SB_SEPARATION_TRUSTED);
        if (s->scene->measure.reflections[row->set].bound && row->harmonic > 1) {
            sb_json_number(json, "bound_incident_m", row->bound_incident);
            sb_json_number(json, "bound_reflected_m", row->bound_reflected);
        }
        sb_json_close(json);
    }
    sb_json_close(json);
}

static void put_departures(sb_json *json, const sb_departures *all)
{
    sb_json_open(json, "left_by_side", '{');
    for (int side = 0; side < SB_SIDES; side++) sb_json_count(json, sb_side_names[side], all->by_side[side]);
    sb_json_close(json);
    sb_json_open(json, "first_left", '[');
    for (size_t i = 0; i < all->count; i++) {
        const sb_departure *one = &all->first[i];
        sb_json_open(json, NULL, '{');
        sb_json_number(json, "time_s", one->time);
        sb_json_count(json, "particle", one->particle);
        sb_json_text(json, "side", sb_side_names[one->side]);
        sb_json_bool(json, "through_wall", one->lost);
        sb_json_vector(json, "position_m", one->position);
        sb_json_number(json, "speed_m_s", one->speed);
        sb_json_close(json);
    }
    sb_json_close(json);
}

static void put_stages(sb_json *json, const sb_spent *spent)
{
    sb_json_open(json, "stages", '[');
    for (size_t i = 0; i < spent->stage_count; i++) {
        const sb_stage_spent *stage = &spent->stage[i];
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "name", stage->name);
        sb_json_number(json, "seconds", stage->seconds);
        sb_json_count(json, "calls", stage->calls);
        sb_json_number(json, "settling_seconds", stage->settling_seconds);
        sb_json_count(json, "settling_calls", stage->settling_calls);
        sb_json_close(json);
    }
    sb_json_close(json);
}

static void put_head(sb_json *json, const sb_scene *scene, const char *status)
{
    sb_json_open(json, NULL, '{');
    sb_json_text(json, "version", SB_VERSION);
    sb_json_text(json, "preset", sb_preset_names[scene->numerics.preset]);
    sb_json_text(json, "title", scene->title);
    sb_json_text(json, "status", status);
}

static void put_all(sb_json *json, const sb_summary *s)
{
    put_head(json, s->scene, s->status == SB_OK ? "done" : s->status == SB_INTERRUPTED ? "interrupted" : "failed");
    if (s->reason) sb_json_text(json, "reason", s->reason);
    sb_json_number(json, "wall_s", s->spent.wall);
    sb_json_number(json, "processor_seconds", s->spent.processor);
    sb_json_number(json, "wall_setup_s", s->spent.setup);
    sb_json_number(json, "wall_settling_s", s->spent.settling);
    sb_json_number(json, "simulated_s", s->simulated);
    sb_json_count(json, "steps", s->steps);
    sb_json_count(json, "threads", (uint64_t)s->threads);
    sb_json_count(json, "ranks", (uint64_t)s->ranks);
    sb_json_count(json, "dimensions", (uint64_t)s->scene->dimensions);
    sb_json_bool(json, "per_metre", s->scene->dimensions == 2);
    sb_json_number(json, "resolution_m", s->scene->resolution);
    sb_json_count(json, "fluid_particles", s->fluid_particles);
    sb_json_count(json, "boundary_particles", s->model->wall_count);
    sb_json_number(json, "mean_iterations", ratio((double)s->iterations, (double)s->steps));
    sb_json_count(json, "capped_steps", s->capped_steps);
    sb_json_number(json, "compression_mean", ratio(s->compression, (double)s->steps));
    sb_json_number(json, "compression_max", s->compression_max);
    sb_json_number(json, "bytes_per_particle", ratio((double)s->bytes, (double)s->fluid_particles));
    sb_json_count(json, "peak_memory_bytes", sb_memory_peak());
    sb_json_count(json, "lost_particles", s->lost);
    if (s->has_inside) {
        sb_json_count(json, "inside_solids", s->inside);
        sb_json_count(json, "through_walls", s->crossed);
    }
    sb_json_count(json, "left_domain", s->left_domain);
    if (s->departures) put_departures(json, s->departures);
    sb_json_count(json, "particle_files", s->frames);
    sb_json_count(json, "particle_files_missing", s->frames_missing);
    sb_json_count(json, "pictures", s->pictures);
    sb_json_count(json, "pictures_missing", s->pictures_missing);
    sb_json_hash(json, "state_hash", s->hash);
    put_bodies(json, s);
    put_absorptions(json, s);
    if (s->waves) put_waves(json, s);
    if (s->rates) put_rates(json, s);
    if (s->reflection_count > 0) put_reflections(json, s);
    sb_summary_put_energy(json, "energy_start", &s->first);
    sb_summary_put_energy(json, "energy_end", &s->last);
    if (s->work) sb_summary_put_work(json, s->work);
    if (s->crossing) put_crossing(json, s->crossing, s->particle_mass);
    if (s->grid) sb_grid_beside_put(json, s->grid);
    put_stages(json, &s->spent);
    sb_json_close(json);
}

sb_status sb_summary_write_running(const char *path, const sb_scene *scene, sb_error *error)
{
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    sb_json json;
    sb_json_begin(&json, out.stream, true);
    put_head(&json, scene, "running");
    sb_json_close(&json);
    return sb_atomic_commit(&out, 1, error);
}

sb_status sb_summary_write(const char *path, const sb_summary *summary, sb_error *error)
{
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    sb_json json;
    sb_json_begin(&json, out.stream, true);
    put_all(&json, summary);
    return sb_atomic_commit(&out, 1, error);
}
