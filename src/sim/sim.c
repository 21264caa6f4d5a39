/* Creation and destruction of a simulation, and its simple accessors. */
#include "base/hash.h"
#include "base/memory.h"
#include "sim/exchange/sums.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/search/searcher.h"
#include "sim/search/sort.h"
#include "sim/step/ledger.h"
#include "sim/step/stages.h"
#include "sim/terms/density_correction.h"
#include "sim/terms/stress_correction.h"
#include "sim/terms/turbulence.h"
#include "sim/walls/drag.h"

#include <math.h>
#include <omp.h>
#include <string.h>

static bool starts_in_motion(const sb_model *model)
{
    for (size_t i = 0; i < model->fluid_count; i++)
        if (sb_norm(model->fluid_velocity[i]) > 0) return true;
    return false;
}

static int allocate(sb_sim *sim, size_t n, size_t bodies)
{
    const sb_numerics *numerics = &sim->scene->numerics;
    const sb_pressure_solver *solver = sb_pressure_solvers[numerics->solver];
    struct {
        void *field;
        size_t count, size;
        bool needed;
    } rows[] = {
        {&sim->position, n, 16, true},
        {&sim->velocity, n, 16, true},
        {&sim->start_velocity, n, 16, sb_sim_settles(sim->scene) && starts_in_motion(sim->model)},
        {&sim->id, n, 4, true},
        {&sim->density_correction, n, 4, sb_density_correction_on(sim->scene)},
        {&sim->acceleration, n, 16, true},
        {&sim->wall, n, 16, true},
        {&sim->density, n, 4, true},
        {&sim->diagonal, n, 4, true},
        {&sim->source, n, 4, true},
        {&sim->unknown, n, 4, true},
        {&sim->residual, n, 4, true},
        {&sim->direction, n, 4, solver->needs_direction},
        {&sim->product, n, 4, solver->needs_product},
        {&sim->eddy, n, 4, sb_turbulence_on(sim->scene)},
        {&sim->scratch, n, 16, true},
        {&sim->wall_drag, n, 16, sb_wall_drag_on(sim->scene)},
        {&sim->pairs.first, n, 4, true},
        {&sim->pairs.count, n, 2, true},
        {&sim->wall_pairs.first, n, 4, true},
        {&sim->wall_pairs.count, n, 2, true},
        {&sim->body_force, bodies * SB_FORCE_VALUES, 8, true},
        {&sim->impulse, bodies, sizeof *sim->impulse, true},
    };
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        if (!rows[r].needed) continue;
        void *memory = sb_alloc(rows[r].count, rows[r].size);
        if (!memory) return -1;
        memcpy(rows[r].field, &memory, sizeof memory);
        sim->bytes_fixed += rows[r].count * rows[r].size;
    }
    /* The sort ends before the wall vectors are computed, so that its words can use their memory. */
    sim->sort_a = (uint64_t *)sim->wall;
    sim->sort_b = sim->sort_a + n;
    sim->capacity = n;
    return 0;
}

/* Positions in quanta, and where the domain repeats. */
static sb_status create_space(sb_sim *sim, sb_error *error)
{
    const sb_vec3 size = sb_sub(sim->model->max, sim->model->min);
    const double length[3] = {size.x, size.y, size.z};
    sb_status status =
        sb_space_create(sim->model->min, sim->model->max, (double)sim->constant.support, &sim->space, error);
    for (int axis = 0; axis < 3 && status == SB_OK; axis++)
        if (sb_scene_repeats(sim->scene, axis)) sb_space_repeat(&sim->space, axis, length[axis]);
    return status;
}

static void fill_particles(sb_sim *sim)
{
    const sb_model *model = sim->model;
    const size_t n = model->fluid_count;
    sim->n = n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        sb_vec3 v = model->fluid_velocity[i];
        sim->position[i] = sb_space_record(&sim->space, model->fluid_position[i]);
        sim->velocity[i] = (sb_f4){(float)v.x, (float)v.y, (float)v.z, (float)model->fluid_pressure[i]};
        sim->id[i] = (uint32_t)i;
        if (sim->start_velocity) sim->start_velocity[i] = (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
    }
    double top = 0;
    for (size_t i = 0; i < n; i++) top = fmax(top, sb_norm(model->fluid_velocity[i]));
    sb_density_correction_clear(sim);
    sim->report.max_speed = top;
    sim->report.fluid_count = n;
}

/* Appends a line to the list of skipped parts. passes: per step, over all pairs; bytes: per particle. */
static void skip(sb_sim *sim, size_t *count, const char *what, int passes, size_t bytes)
{
    if (*count < SB_SIM_SKIPPED_MAX)
        sim->skipped[(*count)++] = (sb_skipped){what, passes, bytes * sim->model->fluid_count};
}

/* Lists the parts that this scene does not need; the log reports them once. */
static void note_skipped(sb_sim *sim)
{
    enum { CORRECTION_PASSES = 3 }; /* moments, their mean, the force */
    const sb_numerics *n = &sim->scene->numerics;
    const bool drag = n->wall_friction > 0 || sb_shear_on(sim->scene);
    size_t s = 0;
    if (!(n->artificial_viscosity > 0) && !(sim->constant.viscosity > 0) && !sb_turbulence_on(sim->scene))
        skip(sim, &s, "viscosity: both coefficients are 0, no pass over particle pairs", 1, 0);
    if (!sb_stress_correction_on(sim->scene))
        skip(sim, &s, "stress correction: off, no passes over particle pairs for it", CORRECTION_PASSES, 0);
    if (!sb_turbulence_on(sim->scene))
        skip(sim, &s, "turbulence: none, no strain rates and no memory for eddy viscosities", 1, sizeof *sim->eddy);
    if (!sb_density_correction_on(sim->scene))
        skip(sim, &s, "density correction: off (density: summed), no memory for it", 0,
             sizeof *sim->density_correction);
    if (!(n->wall_friction > 0)) skip(sim, &s, "wall friction: the coefficient is 0", 0, 0);
    if (!sb_shear_on(sim->scene))
        skip(sim, &s, n->wall_shear == SB_SHEAR_NONE ? "wall shear: none" : "wall shear: the fluid has no viscosity", 0,
             drag ? 0 : sizeof *sim->wall_drag);
    if (!sim->space.repeats) skip(sim, &s, "periodic sides: none, no ghost particles", 0, 0);
    if (sim->moving_count == 0) skip(sim, &s, "moving walls: no body moves", 0, 0);
    if (sim->constant.dimension == 2) skip(sim, &s, "third dimension: 2D scene, 9 cells searched instead of 27", 0, 0);
    if (!sb_pressure_solvers[n->solver]->needs_direction)
        skip(sim, &s, "search direction: no memory, the solver does not use one", 0, sizeof *sim->direction);
    if (!sb_pressure_solvers[n->solver]->needs_product)
        skip(sim, &s, "product with the search direction: no memory, the solver does not use one", 0,
             sizeof *sim->product);
    if (!sb_sim_settles(sim->scene))
        skip(sim, &s, "settling: settle_steps is 0, the water starts from the initial lattice", 0, 0);
    sim->skipped[s] = (sb_skipped){.what = NULL};
}

sb_status sb_sim_create(const sb_scene *scene, const sb_model *model, sb_sim **sim, sb_error *error)
{
    sb_sim *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the simulation");
    made->scene = scene;
    made->model = model;
    made->passes = sb_passes_choose();
    sb_status status = SB_OK;
    if (model->fluid_count >= (size_t)1 << SB_INDEX_BITS)
        status = sb_fail(error, SB_BAD_INPUT, "%zu fluid particles: expected fewer than %d", model->fluid_count,
                         1 << SB_INDEX_BITS);
    if (status == SB_OK) {
        made->constant = sb_constants_of(scene, model);
        status = create_space(made, error);
        made->pairs.unit = sb_lists_unit(made);
    }
    if (status == SB_OK && allocate(made, model->fluid_count, model->body_count) != 0)
        status = sb_fail_memory(error, "fluid particles");
    if (status == SB_OK) status = sb_walls_create(made, error);
    if (status != SB_OK) {
        sb_sim_destroy(made);
        return status;
    }
    fill_particles(made);
    note_skipped(made);
    status = sb_stage_sort(made, error);
    if (status != SB_OK) {
        sb_sim_destroy(made);
        return status;
    }
    made->ledger = (sb_ledger){0}; /* particles that start outside of the domain do not count as leaving it */
    *sim = made;
    return SB_OK;
}

static void free_lists(sb_sim *sim)
{
    sb_free(sim->pairs.first);
    sb_free(sim->pairs.count);
    sb_free(sim->pairs.four);
    sb_free(sim->wall_pairs.first);
    sb_free(sim->wall_pairs.count);
    sb_free(sim->wall_pairs.index);
    sb_free(sim->wall_pairs.slope);
    sb_groups_destroy(sim);
}

void sb_sim_destroy(sb_sim *sim)
{
    if (!sim) return;
    void *fields[] = {sim->position,     sim->velocity,  sim->start_velocity, sim->id,        sim->density_correction,
                      sim->acceleration, sim->wall,      sim->density,        sim->eddy,      sim->diagonal,
                      sim->source,       sim->unknown,   sim->residual,       sim->direction, sim->product,
                      sim->scratch,      sim->wall_drag, sim->body_force,     sim->impulse};
    for (size_t f = 0; f < sizeof fields / sizeof fields[0]; f++) sb_free(fields[f]);
    free_lists(sim);
    sb_cells_free(&sim->cells);
    sb_ghosts_destroy(sim);
    sb_walls_destroy(sim);
    sb_free(sim);
}

const sb_step_report *sb_sim_report(const sb_sim *sim)
{
    return &sim->report;
}

const sb_body_impulse *sb_sim_impulse(const sb_sim *sim, size_t body)
{
    return &sim->impulse[body];
}

const sb_ledger *sb_sim_ledger(const sb_sim *sim)
{
    return &sim->ledger;
}

sb_vec3 sb_sim_body_displacement(const sb_sim *sim, size_t body)
{
    uint32_t m = sim->moving_of_body[body];
    return m == UINT32_MAX ? (sb_vec3){0} : sb_scale(sim->moving[m].direction, sim->moving[m].next_displacement);
}

/* Adds one particle at a time, so that the sums do not depend on the groups, which a state just loaded does not have.
 */
sb_energy sb_sim_energy(const sb_sim *sim)
{
    enum { SQUARE, X, Y, Z, SUMS };
    sb_exact sum[SUMS] = {0};
    uint64_t height = 0; /* quanta */
#pragma omp parallel reduction(+ : height)
    {
        sb_exact own[SUMS] = {0};
#pragma omp for schedule(static) nowait
        for (size_t i = 0; i < sim->n; i++) {
            const sb_f4 v = sim->velocity[i];
            const double x = (double)v[0], y = (double)v[1], z = (double)v[2];
            sb_exact_add(&own[SQUARE], x * x + y * y + z * z);
            sb_exact_add(&own[X], x);
            sb_exact_add(&own[Y], y);
            sb_exact_add(&own[Z], z);
            height += sim->position[i][2];
        }
        sb_sums_merge(sum, own, SUMS);
    }
    const double mass = (double)sim->constant.mass, count = (double)sim->n;
    const double base = sim->model->min.z - sim->space.origin.z;
    const sb_vec3 velocity = sb_vec(sb_exact_value(&sum[X]), sb_exact_value(&sum[Y]), sb_exact_value(&sum[Z]));
    return (sb_energy){
        .kinetic = 0.5 * mass * sb_exact_value(&sum[SQUARE]),
        .potential = mass * (double)sim->constant.gravity * ((double)height * sim->space.quantum - count * base),
        .momentum = sb_scale(velocity, mass),
        .mass = mass * count,
    };
}

/* Hash of one particle's state. The sum of all does not depend on their order. */
static uint64_t particle_hash(const sb_sim *sim, size_t i)
{
    const uint32_t place[4] = {sim->position[i][0], sim->position[i][1], sim->position[i][2], sim->id[i]};
    uint64_t hash = sb_hash(0, place, sizeof place);
    hash = sb_hash(hash, &sim->velocity[i], sizeof sim->velocity[i]);
    if (sim->density_correction) hash = sb_hash(hash, &sim->density_correction[i], sizeof *sim->density_correction);
    return hash;
}

uint64_t sb_sim_hash(const sb_sim *sim)
{
    uint64_t particles = 0;
#pragma omp parallel for schedule(static) reduction(+ : particles)
    for (size_t i = 0; i < sim->n; i++) particles += particle_hash(sim, i);
    uint64_t hash = sb_hash(sb_hash(0, &sim->n, sizeof sim->n), &particles, sizeof particles);
    hash = sb_hash(hash, sim->impulse, sim->model->body_count * sizeof *sim->impulse);
    hash = sb_hash(hash, &sim->ledger, sizeof sim->ledger);
    hash = sb_hash(hash, &sim->report.time, sizeof sim->report.time);
    return sb_hash(hash, &sim->report.step, sizeof sim->report.step);
}

size_t sb_sim_stages(const sb_sim *sim, const sb_stage_time **stages)
{
    *stages = sim->stage;
    return sim->stage_count;
}

const sb_skipped *sb_sim_skipped(const sb_sim *sim)
{
    return sim->skipped;
}

size_t sb_sim_bytes(const sb_sim *sim)
{
    enum { WALL_BYTES = sizeof(sb_record) + sizeof(uint32_t) + sizeof(sb_f4) };
    size_t bytes = sim->bytes_fixed + sb_cells_bytes(&sim->cells) + sb_cells_bytes(&sim->ghosts.cells);
    bytes += sim->ghosts.of_capacity * 4 + (sim->ghosts.words_capacity + sim->ghosts.other_capacity) * 8;
    bytes += sim->pairs.capacity * sizeof *sim->pairs.four + sim->wall_pairs.capacity * 8;
    bytes += sim->groups.capacity * sizeof *sim->groups.group + sim->groups.room * sizeof *sim->groups.run;
    for (int s = 0; s < SB_WALL_SETS; s++)
        bytes +=
            sb_cells_bytes(&sim->walls[s].cells) + sim->walls[s].count * WALL_BYTES + (sim->walls[s].near_mask + 1) * 8;
    return bytes + sim->moving_rest_count * WALL_BYTES;
}
