/* Makes the records of each interval from the states of the measurements. */
#include "base/memory.h"
#include "measure/patch.h"
#include "measure/state.h"

static const size_t record_size[LISTS] = {
    sizeof(sb_force_record),      sizeof(sb_gauge_record), sizeof(sb_probe_record),
    sizeof(sb_flow_record),       sizeof(sb_runup_record), sizeof(sb_energy_record),
    sizeof(sb_reflection_record), sizeof(sb_water_record), sizeof(sb_absorber_record)};

static void *append(sb_measure *measure, int kind)
{
    list *l = &measure->lists[kind];
    if (sb_grow(&l->items, &l->capacity, l->count + 1, record_size[kind]) != 0) return NULL;
    return (char *)l->items + l->count++ * record_size[kind];
}

static sb_vec3 between(sb_vec3 a, sb_vec3 b, double fraction)
{
    return sb_madd(a, fraction, sb_sub(b, a));
}

static sb_body_impulse impulse_at(const sb_body_impulse *a, const sb_body_impulse *b, double fraction)
{
    return (sb_body_impulse){.pressure = between(a->pressure, b->pressure, fraction),
                             .friction = between(a->friction, b->friction, fraction),
                             .moment = between(a->moment, b->moment, fraction)};
}

/* Records the mean forces of the interval that ends at the given fraction of the last step. */
static sb_status record_forces(sb_measure *measure, const sb_sim *sim, double time, double fraction, sb_error *error)
{
    double rate = 1 / measure->interval;
    for (size_t b = 0; b < measure->model->body_count; b++) {
        sb_body_record *body = &measure->bodies[b];
        body_state *state = &measure->states[b];
        if (!body->report) continue;
        sb_body_impulse end = impulse_at(&state->last, sb_sim_impulse(sim, b), fraction);
        sb_force_record *record = append(measure, FORCES);
        if (!record) return sb_fail_memory(error, "force records");
        record->body = b;
        record->time = time;
        record->pressure = sb_scale(sb_sub(end.pressure, state->boundary.pressure), rate);
        record->friction = sb_scale(sb_sub(end.friction, state->boundary.friction), rate);
        record->moment = sb_scale(sb_sub(end.moment, state->boundary.moment), rate);
        record->force = sb_add(record->pressure, record->friction);
        state->boundary = end;
        body->force = record->force;
        body->torque = record->moment;
        double size = sb_norm(record->force);
        if (size > body->peak) {
            body->peak = size;
            body->peak_time = time;
        }
    }
    return SB_OK;
}

static sb_status record_flows(sb_measure *measure, double time, double fraction, sb_error *error)
{
    for (size_t i = 0; i < measure->scene->measure.plane_count; i++) {
        plane_state *plane = &measure->planes[i];
        sb_flow_record *record = append(measure, FLOWS);
        if (!record) return sb_fail_memory(error, "flow records");
        double volume = plane->last + fraction * (plane->now - plane->last);
        *record = (sb_flow_record){i, time, volume, (volume - plane->boundary) / measure->interval};
        plane->boundary = volume;
    }
    return SB_OK;
}

static sb_status record_probe(sb_measure *measure, const sb_measure_view *view, size_t probe, double time,
                              double fraction, sb_error *error)
{
    sb_probe_record *record = append(measure, PROBES);
    if (!record) return sb_fail_memory(error, "probe records");
    record->probe = probe;
    record->time = time;
    /* At the creation there is no interval yet. */
    const bool mean = fraction >= 0 && sb_patch_on_wall(measure->patches[probe]);
    record->pressure = mean ? sb_wall_probe_mean(measure, probe, fraction) : (double)NAN;
    return sb_probe_read(view, &measure->scene->measure.probes[probe], measure->patches[probe], &record->velocity,
                         &record->pressure, error);
}

/* Records the water along the recorded planes; `row` is the number of the interval that ends. */
static sb_status record_waters(sb_measure *measure, const sb_measure_view *view, double time, uint64_t row,
                               sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t i = 0; i < measure->scene->measure.plane_count; i++) {
        const size_t count = sb_plane_records_points(measure, i, row);
        for (size_t p = 0; status == SB_OK && p < count; p++) {
            sb_water_record *record = append(measure, WATERS);
            if (!record) return sb_fail_memory(error, "records of planes");
            status = sb_plane_records_read(measure, view, i, p, time, record, error);
        }
    }
    return status;
}

/* Adds the gauges' records of this instant, which are the last ones, to the sets of reflections. */
static sb_status record_reflections(sb_measure *measure, double time, sb_error *error)
{
    const sb_measure_settings *settings = &measure->scene->measure;
    const list *rows = &measure->lists[GAUGES];
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < settings->reflection_count; i++) {
        const sb_reflection_record *found;
        const sb_gauge_record *gauges = (const sb_gauge_record *)rows->items + (rows->count - settings->gauge_count);
        status = sb_reflections_add(measure, i, gauges, time, &found, error);
        for (int h = 0; status == SB_OK && found && h < settings->reflections[i].harmonics; h++) {
            sb_reflection_record *record = append(measure, REFLECTIONS);
            if (!record) return sb_fail_memory(error, "reflection records");
            *record = found[h];
        }
    }
    return status;
}

/* Records gauges, probes and run-up lines at one instant: a fraction of the last step, or, if negative, the creation.
 */
static sb_status record_instants(sb_measure *measure, const sb_measure_view *view, double time, double fraction,
                                 sb_error *error)
{
    const sb_measure_settings *settings = &measure->scene->measure;
    const sb_sea *sea = &measure->scene->sea;
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < settings->gauge_count; i++) {
        sb_gauge_record *record = append(measure, GAUGES);
        if (!record) return sb_fail_memory(error, "gauge records");
        record->gauge = i;
        record->time = time;
        double water = 0;
        if (settings->gauges[i].water == SB_GAUGE_GRID)
            record->z = sb_grid_gauge_read(view->sim, measure->scene, &settings->gauges[i], time);
        else
            status = sb_gauge_read(view, settings->gauges[i].x, settings->gauges[i].y, &measure->floors[i], &record->z,
                                   &water, error);
        record->eta = sea->present ? record->z - sea->level : (double)NAN;
        gauge_state *state = &measure->gauges[i];
        if (isnan(record->z))
            state->deepest = fmax(state->deepest, water);
        else
            state->had_value = true;
    }
    if (status == SB_OK) status = record_reflections(measure, time, error);
    for (size_t i = 0; status == SB_OK && i < settings->probe_count; i++)
        status = record_probe(measure, view, i, time, fraction, error);
    for (size_t i = 0; status == SB_OK && i < settings->runup_count; i++) {
        sb_runup_record *record = append(measure, RUNUPS);
        if (!record) return sb_fail_memory(error, "run-up records");
        record->line = i;
        record->time = time;
        status = sb_runup_read(view, &settings->runups[i], &measure->shores[i], record, error);
    }
    return status;
}

static sb_status record_energy(sb_measure *measure, const sb_sim *sim, sb_error *error)
{
    sb_energy_record *record = append(measure, ENERGIES);
    if (!record) return sb_fail_memory(error, "energy records");
    sb_energy energy = sb_sim_energy(sim);
    *record = (sb_energy_record){.time = sb_sim_report(sim)->time,
                                 .kinetic = energy.kinetic,
                                 .potential = energy.potential,
                                 .mass = energy.mass,
                                 .momentum = energy.momentum,
                                 .ledger = *sb_sim_ledger(sim),
                                 .momentum_imbalance = measure->momentum_imbalance};
    measure->momentum_imbalance = 0;
    return SB_OK;
}

static sb_status record_absorbers(sb_measure *measure, const sb_sim *sim, sb_error *error)
{
    for (size_t b = 0; b < measure->model->body_count; b++) {
        const sb_absorption one = sb_sim_absorption(sim, b);
        if (!one.absorbs) continue;
        sb_absorber_record *record = append(measure, ABSORBERS);
        if (!record) return sb_fail_memory(error, "records of absorbing paddles");
        *record = (sb_absorber_record){b, sb_sim_report(sim)->time, one.offset, one.drift, one.law};
    }
    return SB_OK;
}

static sb_status record_layers(sb_measure *measure, const sb_measure_view *view, sb_error *error)
{
    for (size_t b = 0; b < measure->model->body_count; b++) {
        body_state *state = &measure->states[b];
        if (!state->faces) continue;
        sb_status status =
            sb_face_approach(view, &state->footprint, sb_sim_body_displacement(view->sim, b), &state->approach, error);
        if (status != SB_OK) return status;
        if (state->approach.weight > 0) measure->bodies[b].layers = state->approach.layers / state->approach.weight;
    }
    return SB_OK;
}

sb_status sb_records_start(sb_measure *measure, const sb_measure_view *view, sb_error *error)
{
    sb_status status = record_instants(measure, view, measure->time, -1, error);
    if (status == SB_OK) status = record_waters(measure, view, measure->time, measure->next - 1, error);
    if (status == SB_OK) status = record_flows(measure, measure->time, 0, error);
    if (status == SB_OK) status = sb_records_step(measure, view, error);
    return status;
}

sb_status sb_records_interval(sb_measure *measure, const sb_measure_view *view, double time, double fraction,
                              sb_error *error)
{
    sb_status status = record_forces(measure, view->sim, time, fraction, error);
    if (measure->loads) sb_loads_boundary(measure->loads, fraction, measure->interval);
    if (status == SB_OK) status = record_flows(measure, time, fraction, error);
    if (status == SB_OK) status = record_instants(measure, view, time, fraction, error);
    if (status == SB_OK) status = record_waters(measure, view, time, measure->next, error);
    return status;
}

sb_status sb_records_step(sb_measure *measure, const sb_measure_view *view, sb_error *error)
{
    sb_status status = record_layers(measure, view, error);
    if (status == SB_OK) status = record_energy(measure, view->sim, error);
    if (status == SB_OK) status = record_absorbers(measure, view->sim, error);
    return status;
}

void sb_records_clear(sb_measure *measure)
{
    for (int k = 0; k < LISTS; k++) measure->lists[k].count = 0;
}

void sb_records_publish(sb_measure *measure)
{
    const list *lists = measure->lists;
    measure->latest = (sb_measure_records){.force_count = lists[FORCES].count,
                                           .forces = lists[FORCES].items,
                                           .gauge_count = lists[GAUGES].count,
                                           .gauges = lists[GAUGES].items,
                                           .probe_count = lists[PROBES].count,
                                           .probes = lists[PROBES].items,
                                           .flow_count = lists[FLOWS].count,
                                           .flows = lists[FLOWS].items,
                                           .runup_count = lists[RUNUPS].count,
                                           .runups = lists[RUNUPS].items,
                                           .energy_count = lists[ENERGIES].count,
                                           .energies = lists[ENERGIES].items,
                                           .reflection_count = lists[REFLECTIONS].count,
                                           .reflections = lists[REFLECTIONS].items,
                                           .water_count = lists[WATERS].count,
                                           .waters = lists[WATERS].items,
                                           .absorber_count = lists[ABSORBERS].count,
                                           .absorbers = lists[ABSORBERS].items};
}

void sb_records_free(sb_measure *measure)
{
    for (int k = 0; k < LISTS; k++) sb_free(measure->lists[k].items);
}

size_t sb_records_bytes(const sb_measure *measure)
{
    size_t bytes = 0;
    for (int k = 0; k < LISTS; k++) bytes += measure->lists[k].capacity * record_size[k];
    return bytes;
}
