/* Saves and loads the state of the measurements: totals, maxima, intervals in progress and due times. */
#include "measure/state.h"

#define SECTION "measure"

/* An impulse is saved as nine doubles. */
enum { IMPULSE = sizeof(sb_body_impulse) / sizeof(double) };

static void put_bodies(const sb_measure *measure, sb_archive_out *out)
{
    sb_put_count(out, measure->model->body_count);
    for (size_t b = 0; b < measure->model->body_count; b++) {
        const body_state *state = &measure->states[b];
        const sb_body_record *body = &measure->bodies[b];
        sb_put_list(out, &state->start, IMPULSE, sizeof(double));
        sb_put_list(out, &state->boundary, IMPULSE, sizeof(double));
        sb_put_list(out, &state->last, IMPULSE, sizeof(double));
        sb_put_real(out, body->peak);
        sb_put_real(out, body->peak_time);
        sb_put_vector(out, body->impulse);
        sb_put_vector(out, body->moment);
        sb_put_vector(out, body->force);
        sb_put_vector(out, body->torque);
        sb_put_real(out, body->layers);
        sb_put_real(out, state->approach.weight);
        sb_put_real(out, state->approach.layers);
    }
}

static void take_bodies(sb_measure *measure, sb_archive_in *in)
{
    const size_t count = measure->model->body_count;
    if (sb_take_count(in, SIZE_MAX) != count)
        sb_archive_refuse(in, "forces on a different number of bodies, expected %zu", count);
    for (size_t b = 0; b < count; b++) {
        body_state *state = &measure->states[b];
        sb_body_record *body = &measure->bodies[b];
        sb_take_list(in, &state->start, IMPULSE, sizeof(double));
        sb_take_list(in, &state->boundary, IMPULSE, sizeof(double));
        sb_take_list(in, &state->last, IMPULSE, sizeof(double));
        body->peak = sb_take_real(in);
        body->peak_time = sb_take_real(in);
        body->impulse = sb_take_vector(in);
        body->moment = sb_take_vector(in);
        body->force = sb_take_vector(in);
        body->torque = sb_take_vector(in);
        body->layers = sb_take_real(in);
        state->approach.weight = sb_take_real(in);
        state->approach.layers = sb_take_real(in);
    }
}

void sb_measure_save(const sb_measure *measure, sb_archive_out *out)
{
    sb_archive_section(out, SECTION);
    sb_put_real(out, measure->time);
    sb_put_count(out, measure->next);
    sb_put_real(out, measure->momentum_imbalance);
    put_bodies(measure, out);
    sb_put_count(out, measure->scene->measure.plane_count);
    for (size_t i = 0; i < measure->scene->measure.plane_count; i++) {
        sb_put_list(out, &measure->planes[i], sizeof measure->planes[i] / sizeof(double), sizeof(double));
        sb_plane_counter_save(measure->counters[i], out);
    }
    sb_put_count(out, measure->scene->measure.gauge_count);
    for (size_t i = 0; i < measure->scene->measure.gauge_count; i++) {
        sb_put_flag(out, measure->gauges[i].had_value);
        sb_put_real(out, measure->gauges[i].deepest);
    }
    sb_put_count(out, measure->scene->measure.probe_count);
    for (size_t i = 0; i < measure->scene->measure.probe_count; i++) {
        sb_put_real(out, measure->probes[i].boundary);
        sb_put_real(out, measure->probes[i].last);
    }
    sb_reflections_save(measure, out);
    sb_put_flag(out, measure->map != NULL);
    if (measure->map) sb_map_save(measure->map, out);
    if (measure->loads) sb_loads_save(measure->loads, out);
}

static sb_status take_planes(sb_measure *measure, sb_archive_in *in, sb_error *error)
{
    const size_t count = measure->scene->measure.plane_count;
    sb_status status = SB_OK;
    if (sb_take_count(in, SIZE_MAX) != count)
        sb_archive_refuse(in, "a different number of flow planes, expected %zu", count);
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        sb_take_list(in, &measure->planes[i], sizeof measure->planes[i] / sizeof(double), sizeof(double));
        status = sb_plane_counter_load(measure->counters[i], in, error);
    }
    return status;
}

static void take_gauges(sb_measure *measure, sb_archive_in *in)
{
    const size_t count = measure->scene->measure.gauge_count;
    if (sb_take_count(in, SIZE_MAX) != count)
        sb_archive_refuse(in, "a different number of gauges, expected %zu", count);
    for (size_t i = 0; i < count; i++) {
        measure->gauges[i].had_value = sb_take_flag(in);
        measure->gauges[i].deepest = sb_take_real(in);
    }
}

static void take_probes(sb_measure *measure, sb_archive_in *in)
{
    const size_t count = measure->scene->measure.probe_count;
    if (sb_take_count(in, SIZE_MAX) != count)
        sb_archive_refuse(in, "a different number of probes, expected %zu", count);
    for (size_t i = 0; i < count; i++) {
        measure->probes[i].boundary = sb_take_real(in);
        measure->probes[i].last = measure->probes[i].now = sb_take_real(in);
    }
}

static void forget_latest(sb_measure *measure)
{
    sb_records_clear(measure);
    measure->latest = (sb_measure_records){0};
}

sb_status sb_measure_load(sb_measure *measure, sb_archive_in *in, sb_error *error)
{
    sb_status status = sb_archive_enter(in, SECTION, error);
    if (status != SB_OK) return status;
    forget_latest(measure);
    measure->time = sb_take_real(in);
    measure->next = sb_take_count(in, (uint64_t)1 << 53);
    measure->momentum_imbalance = sb_take_real(in);
    /* The next row lies within about an interval of the time. Otherwise a step would write rows without end. */
    const double due = (double)measure->next * measure->interval;
    if (!(measure->time >= 0 && due > measure->time * (1 - 1e-6) - measure->interval &&
          due <= measure->time * (1 + 1e-6) + 2 * measure->interval))
        sb_archive_refuse(in, "the next rows at %g s, but the time is %g s", due, measure->time);
    take_bodies(measure, in);
    status = take_planes(measure, in, error);
    if (status != SB_OK) return status;
    take_gauges(measure, in);
    take_probes(measure, in);
    sb_reflections_load(measure, in);
    if (sb_take_flag(in) != (measure->map != NULL))
        sb_archive_refuse(in, measure->map ? "no map, expected one" : "a map, expected none");
    if (measure->map) sb_map_load(measure->map, in);
    if (measure->loads) sb_loads_load(measure->loads, in);
    return sb_archive_leave(in, error);
}
