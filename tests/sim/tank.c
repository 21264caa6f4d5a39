#include "sim/tank.h"

#include "base/hash.h"
#include "base/memory.h"
#include "base/random.h"
#include "sim/step/stages.h"
#include "sim/terms/density_correction.h"
#include "sim/terms/stress_correction.h"
#include "sim/terms/turbulence.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BODIES_MAX = 4, SB_TANK_TEXT = 128 };

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

const char *const tank_preset_names[] = {
    [SB_PRESET_DEFAULT] = "default", [SB_PRESET_PAPER] = "paper", [SB_PRESET_WEN] = "wen"};

/* Text of a vector in a scene: two components in 2D. */
static void write_vector(char text[SB_TANK_TEXT], int dimensions, sb_vec3 v)
{
    if (dimensions == 2)
        snprintf(text, SB_TANK_TEXT, "[%.17g, %.17g]", v.x, v.z);
    else
        snprintf(text, SB_TANK_TEXT, "[%.17g, %.17g, %.17g]", v.x, v.y, v.z);
}

/* Reads the scene with the tank's sizes, and builds the model of it as the program does. */
static void build(tank *t)
{
    const tank_form *f = &t->form;
    char flat[8], spacing[32], max[SB_TANK_TEXT], low[SB_TANK_TEXT], high[SB_TANK_TEXT], inside[SB_TANK_TEXT],
        water[3 * SB_TANK_TEXT], jitter[32], sides[SB_TANK_TEXT];
    snprintf(flat, sizeof flat, "%d", f->dimensions);
    snprintf(spacing, sizeof spacing, "%.17g", f->spacing);
    snprintf(jitter, sizeof jitter, "%.17g", f->jitter);
    write_vector(max, f->dimensions, f->size);
    write_vector(low, f->dimensions, sb_vec(0, 0, 0));
    write_vector(inside, f->dimensions, sb_vec(f->size.x / 2, f->size.y / 2, f->depth / 2));
    write_vector(high, f->dimensions, sb_vec(f->wet_length, f->size.y, f->depth));
    if (f->wet_length == f->size.x && f->depth < f->size.z)
        snprintf(water, sizeof water, "{level: %.17g, seed: %s}", f->depth, inside);
    else
        snprintf(water, sizeof water, "{boxes: [{min: %s, max: %s}]}", low, high);
    snprintf(sides, sizeof sides, "{x_min: %s, x_max: %s, y_min: %s, y_max: %s, z_max: wall}",
             f->repeats[0] ? "periodic" : "wall", f->repeats[0] ? "periodic" : "wall",
             f->repeats[1] ? "periodic" : "wall", f->repeats[1] ? "periodic" : "wall");
    sb_override set[] = {{"dimensions", flat},
                         {"resolution", spacing},
                         {"domain.min", low},
                         {"domain.max", max},
                         {"domain.sides", sides},
                         {"water", water},
                         {"numerics.jitter", jitter},
                         {"numerics.walls", "particles"},
                         {"numerics.density", "summed"},
                         {"numerics.stress_correction", "0"}};
    const size_t keys = sizeof set / sizeof *set - (f->particles ? 0 : 3);
    sb_error error = {0};
    if (sb_scene_read(SB_SOURCE_DIR "/tests/sim/tank.yaml", tank_preset_names[f->preset], set, keys, &t->scene,
                      &error) != SB_OK ||
        sb_model_build(&t->scene, &t->model, &error) != SB_OK)
        fprintf(stderr, "no tank: %s\n", error.text);
    need(t->model.body_count == 1);
    t->scene.domain.side[SB_Z_MAX] = SB_SIDE_OPEN; /* water that is past the lid has left */
    t->wall_capacity = t->normal_capacity = t->model.wall_count;
    t->facet_capacity = t->model.facets.count;
    t->edge_capacity = t->model.facets.edge_count;
    sb_model_body *bodies = sb_alloc(BODIES_MAX, sizeof *bodies);
    t->scene.wavemakers = sb_alloc(BODIES_MAX, sizeof *t->scene.wavemakers);
    need(bodies && t->scene.wavemakers);
    bodies[0] = t->model.bodies[0];
    bodies[0].report = true;
    sb_free(t->model.bodies);
    t->model.bodies = bodies;
}

static void rebuild(tank *t)
{
    const tank_form form = t->form;
    tank_free(t);
    t->form = form;
    build(t);
}

void tank_make(tank *t, int dimensions, double dr, sb_vec3 size, double wet_length, double depth, double jitter)
{
    *t = (tank){.form = {SB_PRESET_DEFAULT, dimensions, dr, size, wet_length, depth, jitter, {false, false}, false}};
    build(t);
}

void tank_of_particles(tank *t, int dimensions, double dr, sb_vec3 size, double wet_length, double depth, double jitter)
{
    *t = (tank){.form = {SB_PRESET_DEFAULT, dimensions, dr, size, wet_length, depth, jitter, {false, false}, true}};
    build(t);
}

void tank_use(tank *t, sb_preset preset)
{
    t->form.preset = preset;
    rebuild(t);
}

void tank_free(tank *t)
{
    sb_model_free(&t->model);
    t->scene.measure = (sb_measure_settings){0}; /* the test's */
    sb_scene_free(&t->scene);
    *t = (tank){0};
}

void tank_repeat(tank *t, int axis)
{
    t->form.repeats[axis] = true;
    rebuild(t);
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

sb_vec3 tank_whole_quanta(const tank *t, sb_vec3 way)
{
    sb_sim *sim = tank_sim(t);
    need(sim != NULL);
    const double quantum = sim->space.quantum;
    sb_sim_destroy(sim);
    return sb_vec(quantum * ceil(way.x / quantum), quantum * ceil(way.y / quantum), way.z);
}

void tank_roll(tank *t, sb_vec3 by)
{
    sb_model *m = &t->model;
    for (size_t i = 0; i < m->fluid_count; i++) m->fluid_position[i] = roll(t, m->fluid_position[i], by);
    for (size_t b = 0; b < m->wall_count; b++) m->wall_position[b] = roll(t, m->wall_position[b], by);
    for (size_t f = 0; f < m->facets.count; f++) {
        sb_facet *facet = &m->facets.facets[f];
        if (facet->edges == 0) continue; /* a side */
        sb_facet_edge *edge = &m->facets.edges[facet->edge];
        const sb_vec3 way = sb_vec(roll(t, edge->from, by).x - edge->from.x, 0, 0); /* a plate spans the tank in y */
        facet->distance += sb_dot(facet->normal, way);
        for (uint32_t k = 0; k < facet->edges; k++)
            edge[k].from = sb_add(edge[k].from, way), edge[k].to = sb_add(edge[k].to, way);
    }
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
    for (size_t f = 0; f < m->facets.count; f++) m->facets.facets[f].distance += sb_dot(m->facets.facets[f].normal, by);
    for (size_t e = 0; e < m->facets.edge_count; e++) {
        m->facets.edges[e].from = sb_add(m->facets.edges[e].from, by);
        m->facets.edges[e].to = sb_add(m->facets.edges[e].to, by);
    }
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
    need(t->scene.numerics.walls != SB_WALLS_IMAGES);
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
    for (size_t f = 0; f < m->facets.count; f++) m->facets.facets[f].body = 1;
}

/* Adds the facet of one side of a plate, which ends at z_min and z_max. way: 1 or -1, of its normal along x. */
static void add_facet(tank *t, uint32_t body, double x, double way, double z_min, double z_max)
{
    sb_model *m = &t->model;
    sb_facets *all = &m->facets;
    need(sb_grow((void **)&all->facets, &t->facet_capacity, all->count + 1, sizeof *all->facets) == 0);
    need(sb_grow((void **)&all->edges, &t->edge_capacity, all->edge_count + 2, sizeof *all->edges) == 0);
    all->facets[all->count++] = (sb_facet){
        .normal = sb_vec(way, 0, 0), .distance = way * x, .body = body, .edge = (uint32_t)all->edge_count, .edges = 2};
    const double y[2] = {t->scene.dimensions == 2 ? 0 : m->min.y, t->scene.dimensions == 2 ? 0 : m->max.y};
    for (int end = 0; end < 2; end++)
        all->edges[all->edge_count++] = (sb_facet_edge){.from = sb_vec(x, y[0], end ? z_max : z_min),
                                                        .to = sb_vec(x, y[1], end ? z_max : z_min),
                                                        .inward = sb_vec(0, 0, end ? -1 : 1),
                                                        .bend = SB_BEND_CONVEX};
}

size_t tank_add_plate(tank *t, const char *name, double x, double z_min, double z_max, sb_vec3 direction,
                      const sb_wavemaker_parameters *law)
{
    sb_model *m = &t->model;
    sb_scene *s = &t->scene;
    need(m->body_count < BODIES_MAX && s->numerics.walls != SB_WALLS_IMAGES);
    const double dr = s->resolution * s->numerics.wall_spacing;
    sb_model_body *body = &m->bodies[m->body_count];
    *body = (sb_model_body){.begin = m->wall_count, .wavemaker = -1, .report = true};
    snprintf(body->name, sizeof body->name, "%s", name);
    long across = s->dimensions == 2 ? 1 : lround((m->max.y - m->min.y) / dr);
    long high = lround((z_max - z_min) / dr);
    for (long y = 0; y < across; y++)
        for (long z = 0; z < high; z++)
            add_wall(
                t,
                sb_vec(x, s->dimensions == 2 ? 0 : m->min.y + ((double)y + 0.5) * dr, z_min + ((double)z + 0.5) * dr),
                sb_vec(1, 0, 0));
    body->count = m->wall_count - body->begin;
    const double offset = s->numerics.wall_offset * s->resolution;
    for (int way = -1; way <= 1; way += 2) add_facet(t, (uint32_t)m->body_count, x + way * offset, way, z_min, z_max);
    if (law) {
        body->wavemaker = (int)s->wavemaker_count;
        sb_wavemaker_use *use = &s->wavemakers[s->wavemaker_count++];
        *use = (sb_wavemaker_use){.direction = direction, .law = *law};
        snprintf(use->name, sizeof use->name, "%s", name);
        snprintf(use->body, sizeof use->body, "%s", name);
    }
    return m->body_count++;
}

void tank_stop_contact(tank *t)
{
    t->model.facets.count = 0;
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
    if (sb_sim_create(&t->scene, &t->model, NULL, &sim, &error) != SB_OK)
        fprintf(stderr, "no simulation: %s\n", error.text);
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

int tank_prepare_source(sb_sim *sim, double dt)
{
    sb_error error = {0};
    if (tank_prepare(sim, dt) != 0) return -1;
    if ((!sim->needs.density_correction || sb_stage_density_correction(sim, &error) == SB_OK) &&
        (!sim->needs.stress_correction || sb_stage_stress_correction(sim, &error) == SB_OK) &&
        (!sim->needs.turbulence || sb_stage_turbulence(sim, &error) == SB_OK) &&
        sb_stage_forces(sim, &error) == SB_OK && sb_stage_source(sim, &error) == SB_OK)
        return 0;
    fprintf(stderr, "no source: %s\n", error.text);
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

static void swap_particles(sb_sim *sim, size_t a, size_t b)
{
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        char *entries = sb_state_entries(&sim->state, f), kept[sizeof(sb_f4)];
        if (!entries) continue;
        memcpy(kept, entries + a * f->size, f->size);
        memcpy(entries + a * f->size, entries + b * f->size, f->size);
        memcpy(entries + b * f->size, kept, f->size);
    }
}

void tank_shuffle(sb_sim *sim, uint64_t seed)
{
    for (size_t i = sim->state.n; i-- > 1;) swap_particles(sim, i, sb_hash_mix(seed + i) % (i + 1));
}
