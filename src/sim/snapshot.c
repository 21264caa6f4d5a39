/* What leaves the simulation: frames for consumers, samples for gauges and probes. */
#include "sim/state.h"

#include <math.h>
#include <stdio.h>

sb_frame *sb_sim_snapshot(const sb_sim *sim)
{
    const sb_model *model = sim->model;
    sb_frame *frame = sb_frame_create(sim->n, model->body_count);
    if (!frame)
        return NULL;
    const sb_vec3 shift = sb_sub(sim->space.origin, model->min);
    const double quantum = sim->space.quantum;
    frame->origin = model->min;
    frame->spacing = sim->scene->resolution;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < sim->n; i++) {
        sb_record x = sim->position[i];
        frame->position[3 * i] = (float)(x[0] * quantum + shift.x);
        frame->position[3 * i + 1] = (float)(x[1] * quantum + shift.y);
        frame->position[3 * i + 2] = (float)(x[2] * quantum + shift.z);
        for (size_t axis = 0; axis < 3; axis++)
            frame->velocity[3 * i + axis] = sim->velocity[i][axis];
        frame->pressure[i] = sim->velocity[i][3];
        frame->id[i] = sim->id[i];
    }
    for (size_t b = 0; b < model->body_count; b++) {
        sb_frame_body *body = &frame->bodies[b];
        snprintf(body->name, sizeof body->name, "%s", model->bodies[b].name);
        body->displacement = sb_sim_body_displacement(sim, b);
        body->report = model->bodies[b].report;
    }
    frame->status = (sb_frame_status){
        .step = sim->report.step,
        .time = sim->report.time,
        .duration = sim->scene->duration,
        .time_step = sim->report.time_step,
        .iterations = sim->report.iterations,
        .density_error = sim->report.error_mean,
        .max_speed = sim->report.max_speed,
        .lost_particles = sim->lost,
    };
    return frame;
}

sb_fluid_sample sb_sim_particle(const sb_sim *sim, size_t i)
{
    sb_f4 v = sim->velocity[i];
    return (sb_fluid_sample){
        .position = sb_space_position(&sim->space, sim->position[i]),
        .velocity = sb_vec((double)v[0], (double)v[1], (double)v[2]),
        .pressure = (double)v[3],
        .density = (double)sim->density[i],
        .id = sim->id[i],
    };
}

/* Cell index of a coordinate, kept on the grid. */
static int64_t cell_index(const sb_space *space, double distance, int axis)
{
    double index = floor(distance / space->cell);
    double most = (double)((int64_t)1 << space->bits[axis]) - 1;
    return (int64_t)(index < 0 ? 0 : index > most ? most : index);
}

size_t sb_sim_query(const sb_sim *sim, sb_vec3 min, sb_vec3 max, sb_fluid_sample *samples,
                    size_t capacity)
{
    const sb_space *space = &sim->space;
    /* The cells are those of the step's start: look as far around as a particle can have come. */
    double reach = sim->report.max_speed * sim->report.time_step + space->quantum;
    sb_vec3 pad = sb_vec(reach, reach, reach);
    sb_vec3 low = sb_sub(sb_sub(min, pad), space->origin), high = sb_sub(sb_add(max, pad), space->origin);
    const double from[3] = {low.x, low.y, low.z}, to[3] = {high.x, high.y, high.z};
    int64_t a[3], b[3];
    for (int axis = 0; axis < 3; axis++) {
        a[axis] = cell_index(space, from[axis], axis);
        b[axis] = cell_index(space, to[axis], axis);
    }
    size_t found = 0;
    for (int64_t z = a[2]; z <= b[2]; z++)
        for (int64_t y = a[1]; y <= b[1]; y++)
            for (int64_t x = a[0]; x <= b[0]; x++) {
                uint64_t code = (uint64_t)x | (uint64_t)y << 21 | (uint64_t)z << 42;
                int64_t cell = sb_cells_find(&sim->cells, code);
                if (cell < 0)
                    continue;
                for (uint32_t i = sim->cells.begin[cell]; i < sim->cells.begin[cell + 1]; i++) {
                    sb_vec3 p = sb_space_position(space, sim->position[i]);
                    if (p.x < min.x || p.y < min.y || p.z < min.z || p.x > max.x || p.y > max.y ||
                        p.z > max.z)
                        continue;
                    if (found < capacity)
                        samples[found] = sb_sim_particle(sim, i);
                    found++;
                }
            }
    return found;
}
