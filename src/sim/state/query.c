/* Samples of the water for gauges and probes. */
#include "base/memory.h"
#include "sim/state/gather.h"
#include "sim/state/particle.h"

#include <math.h>

static sb_fluid_sample sample_at(const sb_sim *sim, size_t i, sb_vec3 position)
{
    const sb_particle p = sb_particle_at(sim, i);
    const sb_f4 v = p.velocity;
    /* Density sums do not exist before the first step. */
    const double density = (double)(sim->work.lists_current ? p.density : sim->constant.rest_density);
    return (sb_fluid_sample){
        .position = position,
        .velocity = sb_vec((double)v[0], (double)v[1], (double)v[2]),
        .pressure = (double)p.pressure,
        .density = density,
        .id = p.id,
    };
}

sb_fluid_sample sb_sim_particle(const sb_sim *sim, size_t i)
{
    sb_record place = sb_space_wrap(&sim->space, sb_particle_at(sim, i).position);
    return sample_at(sim, i, sb_space_position(&sim->space, place));
}

/* Cell index of a coordinate, limited to the grid. */
static int64_t cell_index(const sb_space *space, double distance, int axis)
{
    double index = floor(distance / space->cell);
    double most = (double)((int64_t)1 << space->bits[axis]) - 1;
    return (int64_t)(index < 0 ? 0 : index > most ? most : index);
}

/* Least range of images beyond a periodic side, in spacings: gauges need four, and particles move within a step. */
static const double IMAGES_RANGE = 8;

typedef struct query {
    sb_vec3 min, max;
    sb_fluid_sample *samples;
    size_t capacity, found;
    /* With several domains: what this one finds, and the number of the present cell. */
    bool several, out_of_memory;
    uint64_t cell;
    sb_placed_sample *placed;
    size_t room;
} query;

static bool within(const query *q, sb_vec3 p)
{
    return p.x >= q->min.x && p.y >= q->min.y && p.z >= q->min.z && p.x <= q->max.x && p.y <= q->max.y &&
           p.z <= q->max.z;
}

/* Position of a particle's image, `away` quanta from it. */
static sb_vec3 image_place(const sb_space *space, sb_record record, const int64_t away[3])
{
    return sb_vec(space->origin.x + (double)(record[0] + away[0]) * space->quantum,
                  space->origin.y + (double)(record[1] + away[1]) * space->quantum,
                  space->origin.z + (double)(record[2] + away[2]) * space->quantum);
}

static void keep(query *q, sb_fluid_sample sample)
{
    if (!q->several) {
        if (q->found < q->capacity) q->samples[q->found] = sample;
    } else if (sb_grow((void **)&q->placed, &q->room, q->found + 1, sizeof *q->placed) == 0)
        q->placed[q->found] = (sb_placed_sample){q->cell, sample};
    else
        q->out_of_memory = true;
    q->found += !q->out_of_memory;
}

/* Finds the particles of one cell, numbered from `base`, whose images are in the box. */
static void query_cell(const sb_sim *sim, query *q, const sb_cells *cells, uint64_t code, size_t base,
                       const int64_t away[3])
{
    const int64_t cell = sb_cells_find(cells, code);
    if (cell < 0) return;
    for (size_t i = base + cells->begin[cell]; i < base + cells->begin[cell + 1]; i++) {
        const sb_vec3 p = image_place(&sim->space, sb_particle_at(sim, i).position, away);
        if (!within(q, p)) continue;
        keep(q, sample_at(sim, i, p));
    }
}

/* Finds the particles whose images, `away` quanta from them, are in the box. */
static void query_images(const sb_sim *sim, query *q, const int64_t away[3])
{
    const sb_space *space = &sim->space;
    /* The cells are those of the step's start: search as far around as a particle can have moved since. */
    const double margin = sim->state.max_speed * sim->state.time_step + space->quantum;
    const sb_vec3 low = sb_sub(q->min, space->origin), high = sb_sub(q->max, space->origin);
    const double from[3] = {low.x, low.y, low.z}, to[3] = {high.x, high.y, high.z};
    int64_t a[3], b[3];
    for (int axis = 0; axis < 3; axis++) {
        const double shift = (double)away[axis] * space->quantum;
        const double least = from[axis] - shift - margin, most = to[axis] - shift + margin;
        const double side = sb_space_low(space) * space->quantum, length = space->period[axis] * space->quantum;
        if (length > 0 && (most < side || least > side + length)) return;
        a[axis] = cell_index(space, least, axis);
        b[axis] = cell_index(space, most, axis);
    }
    for (int64_t z = a[2]; z <= b[2]; z++)
        for (int64_t y = a[1]; y <= b[1]; y++)
            for (int64_t x = a[0]; x <= b[0]; x++) {
                q->cell++;
                uint64_t code = (uint64_t)x | (uint64_t)y << 21 | (uint64_t)z << 42;
                query_cell(sim, q, &sim->cells, code, 0, away);
            }
}

size_t sb_sim_query(const sb_sim *sim, sb_vec3 min, sb_vec3 max, sb_fluid_sample *samples, size_t capacity)
{
    query q = {
        .min = min, .max = max, .samples = samples, .capacity = capacity, .several = sb_ranks_several(sim->ranks)};
    int64_t period[3], most[3], away[3];
    for (int axis = 0; axis < 3; axis++) {
        period[axis] = sim->space.period[axis];
        double length = (double)period[axis] * sim->space.quantum;
        most[axis] = length > 0 ? 1 + (int64_t)ceil(IMAGES_RANGE * sim->scene->resolution / length) : 0;
    }
    for (int64_t z = -most[2]; z <= most[2]; z++)
        for (int64_t y = -most[1]; y <= most[1]; y++)
            for (int64_t x = -most[0]; x <= most[0]; x++) {
                away[0] = x * period[0];
                away[1] = y * period[1];
                away[2] = z * period[2];
                query_images(sim, &q, away);
            }
    if (!q.several) return q.found;
    const size_t all =
        sb_gather_samples(sim, q.out_of_memory ? NULL : q.placed, q.out_of_memory ? 1 : q.found, samples, capacity);
    sb_free(q.placed);
    return all;
}
