#include "measure/measure.h"

#include "base/memory.h"
#include "measure/patch.h"
#include "measure/state.h"

static sb_measure_view view_of(sb_measure *measure, const sb_sim *sim, double lag)
{
    return (sb_measure_view){measure->scene, sim, measure->model->min, measure->model->max, lag, &measure->cloud};
}

static void note_skipped(sb_measure *measure)
{
    const sb_measure_settings *settings = &measure->scene->measure;
    bool reported = false;
    for (size_t b = 0; b < measure->model->body_count; b++) reported = reported || measure->bodies[b].report;
    size_t n = 0;
    if (!reported) measure->skipped[n++].what = "forces: no body reports";
    if (!settings->gauge_count) measure->skipped[n++].what = "wave gauges: none";
    if (!settings->probe_count) measure->skipped[n++].what = "probes: none";
    if (!settings->plane_count) measure->skipped[n++].what = "volume through planes: none";
    if (!settings->runup_count) measure->skipped[n++].what = "run-up lines: none";
    if (!settings->map.present) measure->skipped[n++].what = "maps: none";
}

static sb_status prepare_bodies(sb_measure *measure, sb_error *error)
{
    size_t count = measure->model->body_count;
    measure->states = sb_alloc(count, sizeof *measure->states);
    measure->bodies = sb_alloc(count, sizeof *measure->bodies);
    if (!measure->states || !measure->bodies) return sb_fail_memory(error, "body records");
    for (size_t b = 0; b < count; b++) {
        const sb_model_body *body = &measure->model->bodies[b];
        body_state *state = &measure->states[b];
        measure->bodies[b].report = body->report;
        /* A terrain has no faces at which water could stand. */
        state->faces = body->report && sb_model_body_walls(measure->model, b) > 0 && body->role != SB_ROLE_TERRAIN;
        measure->bodies[b].layers = state->faces ? 0 : (double)NAN;
        if (state->faces) state->footprint = sb_footprint_of(measure->model, b);
    }
    return SB_OK;
}

/* What gauges, run-up lines and probes need of boundary particles. */
static sb_status prepare_places(sb_measure *measure, sb_error *error)
{
    const sb_measure_settings *settings = &measure->scene->measure;
    sb_status status = SB_OK;
    if (settings->gauge_count) {
        measure->floors = sb_alloc(settings->gauge_count, sizeof *measure->floors);
        measure->gauges = sb_alloc(settings->gauge_count, sizeof *measure->gauges);
        if (!measure->floors || !measure->gauges) return sb_fail_memory(error, "measure.gauges");
    }
    for (size_t i = 0; status == SB_OK && i < settings->gauge_count; i++)
        if (settings->gauges[i].water == SB_GAUGE_PARTICLES)
            status = sb_floors_find(measure->scene, measure->model, settings->gauges[i].x, settings->gauges[i].y,
                                    &measure->floors[i], error);
    if (settings->runup_count) {
        measure->shores = sb_alloc(settings->runup_count, sizeof *measure->shores);
        if (!measure->shores) return sb_fail_memory(error, "measure.runups");
    }
    for (size_t i = 0; status == SB_OK && i < settings->runup_count; i++)
        status = sb_shore_find(measure->scene, measure->model, &settings->runups[i], &measure->shores[i], error);
    if (settings->probe_count) {
        measure->patches = sb_alloc(settings->probe_count, sizeof(sb_patch *));
        measure->probes = sb_alloc(settings->probe_count, sizeof *measure->probes);
        if (!measure->patches || !measure->probes) return sb_fail_memory(error, "measure.probes");
    }
    for (size_t i = 0; status == SB_OK && i < settings->probe_count; i++)
        status = sb_patch_create(measure->scene, measure->model, &settings->probes[i], &measure->patches[i], error);
    return status;
}

static sb_status start_fields(sb_measure *measure, const sb_measure_view *view, sb_error *error)
{
    const sb_measure_settings *settings = &measure->scene->measure;
    sb_status status = SB_OK;
    if (settings->plane_count) {
        measure->planes = sb_alloc(settings->plane_count, sizeof *measure->planes);
        measure->counters = sb_alloc(settings->plane_count, sizeof(sb_plane_counter *));
        if (!measure->planes || !measure->counters) return sb_fail_memory(error, "measure.planes");
    }
    for (size_t i = 0; status == SB_OK && i < settings->plane_count; i++)
        status = sb_plane_counter_create(view, &settings->planes[i], &measure->counters[i], error);
    if (status == SB_OK && settings->map.present) status = sb_map_create(view, measure->model, &measure->map, error);
    return status;
}

sb_status sb_measure_prepare(const sb_scene *scene, const sb_model *model, sb_measure **measure, sb_error *error)
{
    sb_measure *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "measurements");
    made->scene = scene;
    made->model = model;
    made->interval = scene->measure.interval;
    sb_status status = prepare_bodies(made, error);
    if (status == SB_OK) status = prepare_places(made, error);
    if (status == SB_OK) status = sb_plane_records_create(made, error);
    if (status != SB_OK) {
        sb_measure_destroy(made);
        return status;
    }
    *measure = made;
    return SB_OK;
}

sb_status sb_measure_start(sb_measure *measure, sb_sim *sim, sb_error *error)
{
    measure->time = sb_sim_report(sim)->time;
    measure->next = (uint64_t)floor(measure->time / measure->interval + 1e-9) + 1;
    for (size_t b = 0; b < measure->model->body_count; b++) {
        body_state *state = &measure->states[b];
        state->start = state->boundary = state->last = *sb_sim_impulse(sim, b);
    }
    sb_measure_view view = view_of(measure, sim, 0);
    sb_status status = start_fields(measure, &view, error);
    if (status == SB_OK) status = sb_reflections_create(measure, error);
    if (status == SB_OK && measure->scene->render.loads)
        status = sb_loads_create(measure->scene, measure->model, &measure->loads, error);
    if (status == SB_OK) status = sb_wall_probes_start(measure, sim, error);
    if (status == SB_OK) status = sb_records_start(measure, &view, error);
    if (status != SB_OK) return status;
    note_skipped(measure);
    sb_records_publish(measure);
    return SB_OK;
}

sb_status sb_measure_create(const sb_scene *scene, const sb_model *model, sb_sim *sim, sb_measure **measure,
                            sb_error *error)
{
    sb_measure *made = NULL;
    sb_status status = sb_measure_prepare(scene, model, &made, error);
    if (status == SB_OK) status = sb_measure_start(made, sim, error);
    if (status == SB_OK)
        *measure = made;
    else
        sb_measure_destroy(made);
    return status;
}

void sb_measure_destroy(sb_measure *measure)
{
    if (!measure) return;
    for (size_t i = 0; measure->counters && i < measure->scene->measure.plane_count; i++)
        sb_plane_counter_destroy(measure->counters[i]);
    sb_records_free(measure);
    for (size_t i = 0; measure->patches && i < measure->scene->measure.probe_count; i++)
        sb_patch_destroy(measure->patches[i]);
    for (size_t i = 0; measure->floors && i < measure->scene->measure.gauge_count; i++)
        sb_floors_free(&measure->floors[i]);
    for (size_t i = 0; measure->shores && i < measure->scene->measure.runup_count; i++)
        sb_shore_free(&measure->shores[i]);
    sb_free(measure->shores);
    sb_free(measure->floors);
    sb_free(measure->gauges);
    sb_free(measure->patches);
    sb_free(measure->probes);
    sb_free(measure->counters);
    sb_free(measure->planes);
    sb_free(measure->states);
    sb_free(measure->bodies);
    sb_reflections_destroy(measure);
    sb_plane_records_destroy(measure);
    sb_map_destroy(measure->map);
    sb_loads_destroy(measure->loads);
    sb_cloud_free(&measure->cloud);
    sb_free(measure);
}

/* Makes all records that are due at `time`, an instant within the last step. */
static sb_status record_boundary(sb_measure *measure, const sb_sim *sim, double time, sb_error *error)
{
    double now = sb_sim_report(sim)->time, taken = now - measure->time;
    double fraction = taken > 0 ? (time - measure->time) / taken : 1;
    fraction = fraction < 0 ? 0 : fraction > 1 ? 1 : fraction;
    sb_measure_view view = view_of(measure, sim, (1 - fraction) * taken);
    return sb_records_interval(measure, &view, time, fraction, error);
}

/* Ends the step: its values become those of the last step. */
static void advance(sb_measure *measure, const sb_sim *sim)
{
    measure->time = sb_sim_report(sim)->time;
    for (size_t b = 0; b < measure->model->body_count; b++) {
        body_state *state = &measure->states[b];
        state->last = *sb_sim_impulse(sim, b);
        /* The impulse covers the finished intervals, so that it equals the sum of the rows times the interval. */
        const sb_body_impulse *finished = measure->bodies[b].report ? &state->boundary : &state->last;
        sb_vec3 end = sb_add(finished->pressure, finished->friction);
        sb_vec3 start = sb_add(state->start.pressure, state->start.friction);
        measure->bodies[b].impulse = sb_sub(end, start);
        measure->bodies[b].moment = sb_sub(finished->moment, state->start.moment);
    }
    for (size_t i = 0; i < measure->scene->measure.plane_count; i++) measure->planes[i].last = measure->planes[i].now;
    for (size_t i = 0; i < measure->scene->measure.probe_count; i++) measure->probes[i].last = measure->probes[i].now;
    if (measure->loads) sb_loads_advance(measure->loads);
}

static bool due(const sb_measure *measure, const sb_sim *sim)
{
    return (double)measure->next * measure->interval <= sb_sim_report(sim)->time + 1e-9 * measure->interval;
}

bool sb_measure_reads_pressures(const sb_measure *measure, const sb_sim *sim)
{
    return measure->scene->measure.probe_count > 0 && due(measure, sim);
}

static sb_status add_loads(sb_measure *measure, const sb_sim *sim, sb_error *error)
{
    size_t count;
    const sb_wall_push *pushes = sb_sim_pushes(sim, &count);
    return sb_loads_step(measure->loads, pushes, count, sb_sim_report(sim)->time - measure->time, error);
}

sb_status sb_measure_step(sb_measure *measure, const sb_sim *sim, sb_error *error)
{
    sb_status status = SB_OK;
    sb_records_clear(measure);
    sb_measure_view view = view_of(measure, sim, 0);
    for (size_t i = 0; status == SB_OK && i < measure->scene->measure.plane_count; i++)
        status = sb_plane_counter_step(measure->counters[i], &view, &measure->planes[i].now, error);
    sb_wall_probes_step(measure, sim, sb_sim_report(sim)->time - measure->time);
    if (measure->loads && status == SB_OK) status = add_loads(measure, sim, error);
    if (measure->map) sb_map_step(measure->map, sim);
    measure->momentum_imbalance = fmax(measure->momentum_imbalance, sb_sim_report(sim)->momentum_imbalance);
    const bool any = due(measure, sim);
    for (; status == SB_OK && due(measure, sim); measure->next++)
        status = record_boundary(measure, sim, (double)measure->next * measure->interval, error);
    if (status == SB_OK && any) status = sb_records_step(measure, &view, error);
    advance(measure, sim);
    sb_records_publish(measure);
    return status;
}

const sb_measure_records *sb_measure_latest(const sb_measure *measure)
{
    return &measure->latest;
}

const sb_body_record *sb_measure_bodies(const sb_measure *measure)
{
    return measure->bodies;
}

const sb_map_record *sb_measure_map(const sb_measure *measure)
{
    return measure->map ? sb_map_result(measure->map) : NULL;
}

double sb_measure_gauge_missed(const sb_measure *measure, size_t gauge)
{
    const gauge_state *state = &measure->gauges[gauge];
    return state->had_value ? 0 : state->deepest;
}

const sb_face_load *sb_measure_faces(const sb_measure *measure, size_t *count)
{
    *count = 0;
    return measure->loads ? sb_loads_rows(measure->loads, count) : NULL;
}

sb_status sb_measure_fill_frame(const sb_measure *measure, sb_frame *frame, sb_error *error)
{
    for (size_t b = 0; b < frame->body_count && b < measure->model->body_count; b++) {
        frame->bodies[b].force = measure->bodies[b].force;
        frame->bodies[b].moment = measure->bodies[b].torque;
    }
    return measure->loads ? sb_loads_fill_frame(measure->loads, frame, error) : SB_OK;
}

const sb_skipped *sb_measure_skipped(const sb_measure *measure)
{
    return measure->skipped;
}

size_t sb_measure_bytes(const sb_measure *measure)
{
    size_t bytes = sizeof *measure + sb_cloud_bytes(&measure->cloud);
    bytes += measure->model->body_count * (sizeof *measure->states + sizeof *measure->bodies);
    bytes += sb_records_bytes(measure);
    for (size_t i = 0; i < measure->scene->measure.plane_count; i++)
        bytes += sizeof *measure->planes + sb_plane_counter_bytes(measure->counters[i]);
    for (size_t i = 0; i < measure->scene->measure.probe_count; i++)
        bytes += sizeof(sb_patch *) + sizeof *measure->probes + sb_patch_bytes(measure->patches[i]);
    for (size_t i = 0; i < measure->scene->measure.runup_count; i++)
        bytes += sizeof *measure->shores + measure->shores[i].capacity * sizeof *measure->shores[i].points;
    bytes += sb_reflections_bytes(measure);
    bytes += measure->loads ? sb_loads_bytes(measure->loads) : 0;
    return bytes + (measure->map ? sb_map_bytes(measure->map) : 0);
}
