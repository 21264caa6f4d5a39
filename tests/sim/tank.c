#include "sim/tank.h"

#include "base/memory.h"
#include "base/random.h"
#include "sim/step/stages.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BODIES_MAX = 4 };

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
        .wall_spacing = 1,
    };
}

/* Ends the test program if a condition does not hold, regardless of NDEBUG. */
static void need(bool condition)
{
    if (!condition) abort();
}

static void add_wall(tank *t, sb_vec3 at, sb_vec3 normal)
{
    sb_model *m = &t->model;
    size_t needed = m->wall_count + 1;
    need(sb_grow((void **)&m->wall_position, &t->wall_capacity, needed, sizeof at) == 0);
    need(sb_grow((void **)&m->wall_normal, &t->normal_capacity, needed, sizeof at) == 0);
    m->wall_normal[m->wall_count] = sb_normalize(normal);
    m->wall_position[m->wall_count++] = at;
}

/* Component of the inward direction along one axis, for a position of the shell. */
static double inward(long index, long n)
{
    return (index == -1) - (index == n);
}

/* A lattice position: the middle of cell (x, y, z); y is 0 in 2D. */
static sb_vec3 place(const tank *t, double x, double y, double z)
{
    sb_vec3 middle = sb_vec(x + 0.5, t->scene.dimensions == 2 ? 0 : y + 0.5, z + 0.5);
    return sb_scale(middle, t->scene.resolution);
}

/* Adds the shell of a lattice box: all positions with the index -1 or n along an axis. */
static void add_shell(tank *t, const long n[3])
{
    bool flat = t->scene.dimensions == 2;
    long y0 = flat ? 0 : -1, y1 = flat ? 0 : n[1];
    for (long x = -1; x <= n[0]; x++)
        for (long y = y0; y <= y1; y++)
            for (long z = -1; z <= n[2]; z++)
                if (x == -1 || x == n[0] || z == -1 || z == n[2] || (!flat && (y == -1 || y == n[1])))
                    add_wall(t, place(t, (double)x, (double)y, (double)z),
                             sb_vec(inward(x, n[0]), flat ? 0 : inward(y, n[1]), inward(z, n[2])));
}

static void fill_water(tank *t, const long wet[3], double depth, double jitter)
{
    sb_model *m = &t->model;
    size_t count = (size_t)(wet[0] * wet[1] * wet[2]);
    m->fluid_position = sb_alloc(count, sizeof *m->fluid_position);
    m->fluid_velocity = sb_alloc(count, sizeof *m->fluid_velocity);
    m->fluid_pressure = sb_alloc(count, sizeof *m->fluid_pressure);
    need(m->fluid_position && m->fluid_velocity && m->fluid_pressure);
    for (long x = 0; x < wet[0]; x++)
        for (long y = 0; y < wet[1]; y++)
            for (long z = 0; z < wet[2]; z++) {
                size_t i = m->fluid_count++;
                double d[3];
                for (uint64_t axis = 0; axis < 3; axis++) d[axis] = jitter * (2 * sb_random(7, 3 * i + axis) - 1);
                m->fluid_position[i] = place(t, (double)x + d[0], (double)y + d[1], (double)z + d[2]);
                m->fluid_pressure[i] = 1000 * 9.81 * (depth - m->fluid_position[i].z);
            }
}

void tank_make(tank *t, int dimensions, double dr, sb_vec3 size, double wet_length, double depth, double jitter)
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
    m->bodies = sb_alloc(BODIES_MAX, sizeof *m->bodies);
    s->wavemakers = sb_alloc(BODIES_MAX, sizeof *s->wavemakers);
    need(m->bodies && s->wavemakers);
    fill_water(t, wet, depth, jitter);
    add_shell(t, n);
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
    sb_free(t->model.wall_normal);
    sb_free(t->model.bodies);
    sb_free(t->scene.wavemakers);
    *t = (tank){0};
}

static double along(sb_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

void tank_repeat(tank *t, int axis)
{
    sb_model *m = &t->model;
    size_t kept = 0;
    t->scene.domain.side[2 * axis] = t->scene.domain.side[2 * axis + 1] = SB_SIDE_PERIODIC;
    for (size_t k = 0; k < m->body_count; k++) {
        sb_model_body *body = &m->bodies[k];
        const size_t begin = kept;
        for (size_t b = body->begin; b < body->begin + body->count; b++) {
            double at = along(m->wall_position[b], axis);
            if (at < along(m->min, axis) || at >= along(m->max, axis)) continue;
            m->wall_normal[kept] = m->wall_normal[b];
            m->wall_position[kept++] = m->wall_position[b];
        }
        body->begin = begin;
        body->count = kept - begin;
    }
    m->wall_count = kept;
}

static double rolled(double at, double by, double min, double max)
{
    double length = max - min, place = fmod(at + by - min, length);
    return min + (place < 0 ? place + length : place);
}

static sb_vec3 roll(const tank *t, sb_vec3 at, sb_vec3 by)
{
    const sb_model *m = &t->model;
    if (sb_scene_repeats(&t->scene, 0)) at.x = rolled(at.x, by.x, m->min.x, m->max.x);
    if (sb_scene_repeats(&t->scene, 1)) at.y = rolled(at.y, by.y, m->min.y, m->max.y);
    return at;
}

void tank_roll(tank *t, sb_vec3 by)
{
    sb_model *m = &t->model;
    for (size_t i = 0; i < m->fluid_count; i++) m->fluid_position[i] = roll(t, m->fluid_position[i], by);
    for (size_t b = 0; b < m->wall_count; b++) m->wall_position[b] = roll(t, m->wall_position[b], by);
}

void tank_shift(tank *t, sb_vec3 by)
{
    sb_model *m = &t->model;
    m->min = sb_add(m->min, by);
    m->max = sb_add(m->max, by);
    t->scene.domain.min = sb_add(t->scene.domain.min, by);
    t->scene.domain.max = sb_add(t->scene.domain.max, by);
    for (size_t i = 0; i < m->fluid_count; i++) m->fluid_position[i] = sb_add(m->fluid_position[i], by);
    for (size_t b = 0; b < m->wall_count; b++) m->wall_position[b] = sb_add(m->wall_position[b], by);
    for (size_t b = 0; b < m->body_count; b++) m->bodies[b].moment_point = sb_add(m->bodies[b].moment_point, by);
}

void tank_scatter(tank *t, uint64_t seed, double speed)
{
    sb_model *m = &t->model;
    bool flat = t->scene.dimensions == 2;
    for (size_t i = 0; i < m->fluid_count; i++) {
        double u[6];
        for (uint64_t k = 0; k < 6; k++) u[k] = sb_random(seed, 6 * i + k);
        m->fluid_position[i] =
            sb_add(m->min, sb_vec(u[0] * (m->max.x - m->min.x), flat ? 0 : u[1] * (m->max.y - m->min.y),
                                  u[2] * (m->max.z - m->min.z)));
        m->fluid_velocity[i] = sb_scale(sb_vec(2 * u[3] - 1, flat ? 0 : 2 * u[4] - 1, 2 * u[5] - 1), speed);
        m->fluid_pressure[i] = 0;
    }
}

void tank_split_patch(tank *t, sb_vec3 min, sb_vec3 max)
{
    sb_model *m = &t->model;
    sb_vec3 *parted = sb_alloc(m->wall_count, sizeof *parted);
    sb_vec3 *normal = sb_alloc(m->wall_count, sizeof *normal);
    need(parted && normal);
    size_t at = 0, patch_count = 0;
    for (int rest = 0; rest < 2; rest++) {
        for (size_t b = 0; b < m->wall_count; b++) {
            sb_vec3 x = m->wall_position[b];
            bool in = x.x > min.x && x.y > min.y && x.z > min.z && x.x < max.x && x.y < max.y && x.z < max.z;
            if (in != !rest) continue;
            normal[at] = m->wall_normal[b];
            parted[at++] = x;
        }
        if (!rest) patch_count = at;
    }
    sb_free(m->wall_position);
    m->wall_position = parted;
    sb_free(m->wall_normal);
    m->wall_normal = normal;
    t->wall_capacity = t->normal_capacity = m->wall_count;
    m->body_count = 2;
    m->bodies[1] = m->bodies[0];
    m->bodies[0].count = patch_count;
    m->bodies[1].begin = patch_count;
    m->bodies[1].count = m->wall_count - patch_count;
    snprintf(m->bodies[0].name, sizeof m->bodies[0].name, "patch");
}

size_t tank_add_plate(tank *t, const char *name, double x, double z_min, double z_max, sb_vec3 direction,
                      const sb_wavemaker_parameters *law)
{
    sb_model *m = &t->model;
    sb_scene *s = &t->scene;
    need(m->body_count < BODIES_MAX);
    double dr = s->resolution;
    sb_model_body *body = &m->bodies[m->body_count];
    *body = (sb_model_body){.begin = m->wall_count, .wavemaker = -1, .report = true};
    snprintf(body->name, sizeof body->name, "%s", name);
    long across = s->dimensions == 2 ? 1 : lround((m->max.y - m->min.y) / dr);
    long high = lround((z_max - z_min) / dr);
    for (long y = 0; y < across; y++)
        for (long z = 0; z < high; z++)
            add_wall(t, sb_vec(x, s->dimensions == 2 ? 0 : ((double)y + 0.5) * dr, z_min + ((double)z + 0.5) * dr),
                     sb_vec(1, 0, 0));
    body->count = m->wall_count - body->begin;
    if (law) {
        body->wavemaker = (int)s->wavemaker_count;
        sb_wavemaker_use *use = &s->wavemakers[s->wavemaker_count++];
        *use = (sb_wavemaker_use){.direction = direction, .law = *law};
        snprintf(use->name, sizeof use->name, "%s", name);
        snprintf(use->body, sizeof use->body, "%s", name);
    }
    return m->body_count++;
}

void tank_add_terms(tank *t)
{
    t->scene.numerics.stress_correction = 1;
    t->scene.numerics.wall_friction = 0.05;
    t->scene.numerics.turbulence = SB_TURBULENCE_SPS;
    t->scene.numerics.smagorinsky = 0.1;
    t->scene.fluid.viscosity = 1e-4;
    t->scene.numerics.settle_steps = 5;
}

sb_sim *tank_sim(const tank *t)
{
    sb_error error = {0};
    sb_sim *sim = NULL;
    if (sb_sim_create(&t->scene, &t->model, &sim, &error) != SB_OK) fprintf(stderr, "no simulation: %s\n", error.text);
    return sim;
}

sb_sim *tank_settled(const tank *t)
{
    sb_error error = {0};
    sb_sim *sim = tank_sim(t);
    const bool settled = sim && sb_sim_settle(sim, &error) == SB_OK;
    if (!settled) fprintf(stderr, "not settled: %s\n", error.text);
    need(settled);
    return sim;
}

void tank_save(const sb_sim *sim, sb_archive_out *out)
{
    sb_archive_begin(out, "TEST", 1);
    sb_sim_save(sim, out);
    need(sb_archive_close(out, NULL) == SB_OK);
}

sb_status tank_load(sb_sim *sim, const sb_archive_out *out, sb_error *error)
{
    sb_archive_in in;
    sb_status status = sb_archive_parse(&in, "saved", out->bytes, out->used, "TEST", 1, error);
    return status == SB_OK ? sb_sim_load(sim, &in, error) : status;
}

int tank_prepare(sb_sim *sim, double dt)
{
    sb_error error = {0};
    sim->state.time_step = dt;
    if (sb_stage_walls(sim, &error) == SB_OK && sb_stage_sort(sim, &error) == SB_OK &&
        sb_stage_ghosts(sim, &error) == SB_OK && sb_stage_neighbours(sim, &error) == SB_OK)
        return 0;
    fprintf(stderr, "no neighbours: %s\n", error.text);
    return -1;
}

int tank_steps(sb_sim *sim, int n)
{
    sb_error error = {0};
    for (int s = 0; s < n; s++)
        if (sb_sim_step(sim, &error) != SB_OK) {
            fprintf(stderr, "no step: %s\n", error.text);
            return -1;
        }
    return 0;
}

bool tank_has_stage(const sb_sim *sim, const char *name)
{
    const sb_stage_time *stages;
    const size_t count = sb_sim_stages(sim, &stages);
    for (size_t s = 0; s < count; s++)
        if (strcmp(stages[s].name, name) == 0) return true;
    return false;
}

bool tank_skips(const sb_sim *sim, const char *text)
{
    for (const sb_skipped *line = sb_sim_skipped(sim); line->what; line++)
        if (strstr(line->what, text)) return true;
    return false;
}
