#include "fake_sim.h"

#include "base/memory.h"
#include "base/random.h"

#include <assert.h>
#include <string.h>

const sb_step_report *sb_sim_report(const sb_sim *sim)
{
    return &sim->report;
}

const sb_body_impulse *sb_sim_impulse(const sb_sim *sim, size_t body)
{
    return &sim->impulses[body];
}

sb_vec3 sb_sim_body_displacement(const sb_sim *sim, size_t body)
{
    return sim->displacements[body];
}

const sb_offshore *sb_sim_grid(const sb_sim *sim)
{
    (void)sim;
    return NULL;
}

sb_absorption sb_sim_absorption(const sb_sim *sim, size_t body)
{
    (void)sim, (void)body;
    return (sb_absorption){0};
}

sb_energy sb_sim_energy(const sb_sim *sim)
{
    return sim->energy;
}

const sb_ledger *sb_sim_ledger(const sb_sim *sim)
{
    return &sim->ledger;
}

sb_status sb_sim_record_pushes(sb_sim *sim, const sb_push_place *places, size_t count, sb_error *error)
{
    (void)places;
    (void)error;
    sim->place_count = count;
    return SB_OK;
}

const sb_wall_push *sb_sim_pushes(const sb_sim *sim, size_t *count)
{
    *count = sim->push_count;
    return sim->pushes;
}

sb_ranks *sb_sim_ranks(const sb_sim *sim)
{
    (void)sim;
    return NULL;
}

size_t sb_sim_owned(const sb_sim *sim)
{
    return sim->report.fluid_count;
}

sb_fluid_sample sb_sim_particle(const sb_sim *sim, size_t i)
{
    return sim->samples[i];
}

size_t sb_sim_query(const sb_sim *sim, sb_vec3 min, sb_vec3 max, sb_fluid_sample *samples, size_t capacity)
{
    size_t found = 0;
    for (size_t i = 0; i < sim->report.fluid_count; i++) {
        sb_vec3 p = sim->samples[i].position;
        if (p.x < min.x || p.x > max.x || p.y < min.y || p.y > max.y || p.z < min.z || p.z > max.z) continue;
        if (found < capacity) samples[found] = sim->samples[i];
        found++;
    }
    return found;
}

void fake_world_make(fake_world *world, int dimensions, double spacing, sb_vec3 min, sb_vec3 max)
{
    memset(world, 0, sizeof *world);
    world->scene.dimensions = dimensions;
    world->scene.resolution = spacing;
    world->scene.fluid = (sb_fluid_properties){.density = 1000, .gravity = 9.81};
    world->scene.numerics.kernel = sb_kernel_find("cubic");
    assert(world->scene.numerics.kernel);
    world->scene.numerics.support = 2;
    world->scene.measure.interval = 0.1;
    world->model.min = min;
    world->model.max = max;
}

void fake_world_free(fake_world *world)
{
    sb_free(world->sim.samples);
    sb_cloud_free(&world->cloud);
}

sb_measure_view fake_view(fake_world *world)
{
    return (sb_measure_view){&world->scene, &world->sim, world->model.min, world->model.max, 0, &world->cloud};
}

void fake_add(sb_sim *sim, sb_vec3 position, sb_vec3 velocity, double pressure)
{
    size_t n = sim->report.fluid_count;
    int failed = sb_grow((void **)&sim->samples, &sim->capacity, n + 1, sizeof *sim->samples);
    assert(!failed);
    (void)failed;
    sim->samples[n] = (sb_fluid_sample){position, velocity, pressure, 1000, (uint32_t)n};
    sim->report.fluid_count = n + 1;
    double speed = sb_norm(velocity);
    if (speed > sim->report.max_speed) sim->report.max_speed = speed;
}

static double noise(double jitter, double spacing, uint64_t seed, size_t index, int axis)
{
    return jitter * spacing * (2 * sb_random(seed + (uint64_t)axis, index) - 1);
}

void fake_fill(fake_world *world, sb_vec3 min, sb_vec3 max, double shift_x, double shift_y, double jitter,
               uint64_t seed)
{
    double s = world->scene.resolution;
    bool flat = world->scene.dimensions == 2;
    double weight = world->scene.fluid.density * world->scene.fluid.gravity;
    sb_sim *sim = &world->sim;
    for (double z = max.z - s / 2; z > min.z; z -= s)
        for (double y = flat ? 0 : min.y + s / 2 + shift_y * s; y < (flat ? s / 2 : max.y); y += s)
            for (double x = min.x + s / 2 + shift_x * s; x < max.x; x += s) {
                size_t n = sim->report.fluid_count;
                sb_vec3 p = {x + noise(jitter, s, seed, n, 0), flat ? 0 : y + noise(jitter, s, seed, n, 1),
                             z + noise(jitter, s, seed, n, 2)};
                fake_add(sim, p, sb_vec(0, 0, 0), weight * fmax(max.z - p.z, 0));
            }
}

void fake_step(sb_sim *sim, double dt)
{
    for (size_t i = 0; i < sim->report.fluid_count; i++)
        sim->samples[i].position = sb_madd(sim->samples[i].position, dt, sim->samples[i].velocity);
    sim->report.time += dt;
    sim->report.time_step = dt;
    sim->report.step++;
}
