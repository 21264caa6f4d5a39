#include "tank.h"

#include "base/memory.h"
#include "base/random.h"

#include <assert.h>
#include <stdio.h>

static void set_numerics(sb_numerics *n)
{
    *n = (sb_numerics){
        .kernel = sb_kernel_find("cubic"),
        .support = 2,
        .solver = SB_SOLVER_CHEBYSHEV,
        .tolerance_rule = SB_TOLERANCE_PRESSURE,
        .tolerance = 0.005,
        .min_iterations = 2,
        .max_iterations = 500,
        .relaxation = 0.5,
        .warm_start = 0.9,
        .source_relaxation = 0.3,
        .cfl = 0.4,
        .time_step_rule = SB_TIME_STEP_DEPTH,
        .time_step_factor = 0.1,
        .artificial_viscosity = 0.01,
        .wall_gamma = 0.7,
        .wall_offset = 0.5,
    };
}

static void add_wall(sb_model *m, size_t *capacity, sb_vec3 at)
{
    sb_vec3 *grown = m->wall_position;
    assert(sb_grow((void **)&grown, capacity, m->wall_count + 1, sizeof *grown) == 0);
    m->wall_position = grown;
    m->wall_position[m->wall_count++] = at;
}

/* All points of the shell of a lattice box whose index is -1 or n along some axis. */
static void add_shell(sb_model *m, int dimensions, double dr, const long n[3])
{
    size_t capacity = 0;
    long y0 = dimensions == 2 ? 0 : -1, y1 = dimensions == 2 ? 0 : n[1];
    for (long x = -1; x <= n[0]; x++)
        for (long y = y0; y <= y1; y++)
            for (long z = -1; z <= n[2]; z++) {
                bool shell = x == -1 || x == n[0] || z == -1 || z == n[2] ||
                             (dimensions == 3 && (y == -1 || y == n[1]));
                if (shell)
                    add_wall(m, &capacity, sb_vec(((double)x + 0.5) * dr,
                                                  dimensions == 2 ? 0 : ((double)y + 0.5) * dr,
                                                  ((double)z + 0.5) * dr));
            }
}

void tank_make(tank *t, int dimensions, double dr, sb_vec3 size, double wet_length, double depth,
               double jitter)
{
    *t = (tank){0};
    sb_scene *s = &t->scene;
    sb_model *m = &t->model;
    s->dimensions = dimensions;
    s->resolution = dr;
    s->duration = 1;
    s->fluid = (sb_fluid_properties){.density = 1000, .gravity = 9.81};
    set_numerics(&s->numerics);
    s->domain.max = size;
    s->domain.side[SB_Z_MAX] = SB_SIDE_OPEN;
    m->max = size;
    m->still_depth = depth;
    const long n[3] = {lround(size.x / dr), lround(size.y / dr), lround(size.z / dr)};
    const long wet[3] = {lround(wet_length / dr), dimensions == 2 ? 1 : n[1], lround(depth / dr)};
    size_t count = (size_t)(wet[0] * wet[1] * wet[2]);
    m->fluid_position = sb_alloc(count, sizeof *m->fluid_position);
    m->fluid_velocity = sb_alloc(count, sizeof *m->fluid_velocity);
    m->fluid_pressure = sb_alloc(count, sizeof *m->fluid_pressure);
    m->bodies = sb_alloc(1, sizeof *m->bodies);
    assert(m->fluid_position && m->fluid_velocity && m->fluid_pressure && m->bodies);
    for (long x = 0; x < wet[0]; x++)
        for (long y = 0; y < wet[1]; y++)
            for (long z = 0; z < wet[2]; z++) {
                size_t i = m->fluid_count++;
                double d[3];
                for (uint64_t axis = 0; axis < 3; axis++)
                    d[axis] = jitter * (2 * sb_random(7, 3 * i + axis) - 1);
                m->fluid_position[i] = sb_vec(((double)x + 0.5 + d[0]) * dr,
                                              dimensions == 2 ? 0 : ((double)y + 0.5 + d[1]) * dr,
                                              ((double)z + 0.5 + d[2]) * dr);
                m->fluid_pressure[i] = 1000 * 9.81 * (depth - m->fluid_position[i].z);
            }
    add_shell(m, dimensions, dr, n);
    m->body_count = 1;
    m->bodies[0] = (sb_model_body){.count = m->wall_count, .wavemaker = -1, .report = true};
    snprintf(m->bodies[0].name, sizeof m->bodies[0].name, "tank");
}

void tank_free(tank *t)
{
    sb_free(t->model.fluid_position);
    sb_free(t->model.fluid_velocity);
    sb_free(t->model.fluid_pressure);
    sb_free(t->model.wall_position);
    sb_free(t->model.bodies);
    *t = (tank){0};
}
