#include "app/grid/record.h"

#include "app/grid/frame.h"
#include "app/grid/maps.h"
#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/* The water at a place at a time between the last two levels. */
typedef struct instant {
    bool wet;
    sb_offshore_water water;
} instant;

static double between(const sb_offshore_sample *s, double a, double b, double time)
{
    const double span = s->time[1] - s->time[0];
    return span > 0 ? a + (b - a) * (time - s->time[0]) / span : b;
}

static instant water_at(const sb_offshore *water, double x, double y, double time)
{
    const sb_offshore_sample s = sb_offshore_at(water, x, y);
    const sb_offshore_water *a = &s.water[0], *b = &s.water[1];
    if (!s.wet[0] || !s.wet[1]) return (instant){.wet = s.wet[1] && s.time[1] <= time, .water = *b};
    return (instant){.wet = true,
                     .water = {between(&s, a->surface, b->surface, time), between(&s, a->u, b->u, time),
                               between(&s, a->v, b->v, time)}};
}

/* Walks along a line in steps of a quarter of a cell, from its first end, over water deeper than the threshold. Takes
   the newer level: rows of run-up are at most a time step late. */
static sb_runup_record runup_of(const sb_grid_record *r, const sb_offshore *water, size_t line, double time)
{
    const sb_runup_line *l = &r->scene->measure.runups[line];
    const bool flat = r->scene->dimensions == 2;
    const double dx = l->bx - l->ax, dy = flat ? 0 : l->by - l->ay, length = hypot(dx, dy);
    const size_t steps = (size_t)ceil(4 * length / r->scene->offshore.cell);
    const double none = (double)NAN, step = length / (double)steps;
    sb_runup_record found = {.line = line, .time = time, .place = {none, none, none}, .front = none};
    bool connected = true, any = false;
    double highest = -HUGE_VAL;
    for (size_t k = 0; k <= steps; k++) {
        const double x = l->ax + dx * (double)k / (double)steps, y = l->ay + dy * (double)k / (double)steps;
        const sb_offshore_sample s = sb_offshore_at(water, x, y);
        const bool wet = s.wet[1] && s.water[1].surface - s.bed >= r->scene->offshore.threshold;
        connected = connected && wet;
        any = any || wet;
        if (wet && !connected) found.apart += step;
        if (!connected) continue;
        found.front = (double)k * step;
        if (s.water[1].surface < highest) continue;
        highest = s.water[1].surface;
        found.place = sb_vec(x, flat ? 0 : y, highest);
    }
    if (any && isnan(found.front)) found.front = 0;
    return found;
}

static sb_energy_record energy_of(const sb_grid_record *r, const sb_offshore *water, double time)
{
    const sb_offshore_balance b = sb_offshore_find_balance(water);
    const double density = r->scene->fluid.density, gravity = r->scene->fluid.gravity;
    return (sb_energy_record){.time = time,
                              .kinetic = density * b.kinetic,
                              .potential = density * (b.potential - gravity * r->scene->domain.min.z * b.now),
                              .mass = density * b.now,
                              .momentum = {density * b.momentum_x, density * b.momentum_y, 0}};
}

/* Appends the rows of one instant. */
static sb_status write_rows(sb_grid_record *r, const sb_offshore *water, double time, sb_error *error)
{
    const sb_measure_settings *m = &r->scene->measure;
    const double weight = r->scene->fluid.density * r->scene->fluid.gravity, none = (double)NAN;
    for (size_t i = 0; i < m->gauge_count; i++) {
        const instant w = water_at(water, m->gauges[i].x, m->gauges[i].y, time);
        r->gauges[i] = (sb_gauge_record){i, time, w.wet ? w.water.surface - r->scene->offshore.level : none,
                                         w.wet ? w.water.surface : none};
    }
    for (size_t i = 0; i < m->probe_count; i++) {
        const instant w = water_at(water, m->probes[i].at.x, m->probes[i].at.y, time);
        const double depth = w.water.surface - m->probes[i].at.z;
        const bool under = w.wet && depth > 0;
        r->probes[i] =
            (sb_probe_record){.probe = i,
                              .time = time,
                              .velocity = under ? sb_vec(w.water.u, w.water.v, none) : sb_vec(none, none, none),
                              .pressure = under ? weight * depth : none};
    }
    for (size_t i = 0; i < m->runup_count; i++) r->runups[i] = runup_of(r, water, i, time);
    const sb_energy_record energy = energy_of(r, water, time);
    const sb_measure_records records = {.gauge_count = m->gauge_count,
                                        .probe_count = m->probe_count,
                                        .runup_count = m->runup_count,
                                        .energy_count = 1,
                                        .gauges = r->gauges,
                                        .probes = r->probes,
                                        .runups = r->runups,
                                        .energies = &energy};
    return sb_csv_write(r->csv, &records, error);
}

/* Records all that is due at the model's time. */
static sb_status record(sb_grid_record *r, const sb_offshore *water, sb_error *error)
{
    const double time = sb_offshore_read(water).time, interval = r->scene->measure.interval;
    sb_status status = SB_OK;
    while (status == SB_OK && r->next <= time * (1 + 1e-12)) {
        status = write_rows(r, water, r->next, error);
        r->next = (double)++r->rows * interval;
    }
    if (status != SB_OK || !(r->scene->output.particle_interval > 0) || time < r->next_frame * (1 - 1e-12))
        return status;
    r->next_frame = (floor(time / r->scene->output.particle_interval + 1e-9) + 1) * r->scene->output.particle_interval;
    return sb_grid_frame_write(r->directory, water, &r->frames, error);
}

sb_status sb_grid_record_begin(sb_grid_record *r, const sb_scene *scene, const char *directory,
                               const sb_offshore *water, sb_error *error)
{
    *r = (sb_grid_record){.scene = scene, .directory = directory};
    r->gauges = sb_alloc(scene->measure.gauge_count, sizeof *r->gauges);
    r->probes = sb_alloc(scene->measure.probe_count, sizeof *r->probes);
    r->runups = sb_alloc(scene->measure.runup_count, sizeof *r->runups);
    if (!r->gauges || !r->probes || !r->runups) return sb_fail_memory(error, "gauges");
    sb_status status = SB_OK;
    if (scene->offshore.maps) status = sb_offshore_maps_create(water, scene->offshore.threshold, &r->maps, error);
    if (status == SB_OK) status = sb_csv_open(directory, scene, &r->model, &r->csv, error);
    return status == SB_OK ? record(r, water, error) : status;
}

sb_status sb_grid_record_step(sb_grid_record *r, const sb_offshore *water, double taken, sb_error *error)
{
    if (r->maps) sb_offshore_maps_step(r->maps, water, taken);
    return record(r, water, error);
}

sb_status sb_grid_record_end(sb_grid_record *r, const sb_offshore *water, sb_error *error)
{
    sb_status status = r->maps ? sb_grid_maps_write(r->directory, water, r->maps, NULL, error) : SB_OK;
    sb_error late = {0};
    const sb_status closed = sb_csv_close(r->csv, &late);
    if (status == SB_OK && closed != SB_OK) {
        status = closed;
        if (error) *error = late;
    }
    sb_offshore_maps_destroy(r->maps);
    sb_free(r->gauges);
    sb_free(r->probes);
    sb_free(r->runups);
    r->csv = NULL;
    r->maps = NULL;
    r->gauges = NULL;
    r->probes = NULL;
    r->runups = NULL;
    return status;
}
