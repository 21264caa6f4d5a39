/* Creation and destruction of a simulation, and its simple accessors. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/foam/foam.h"
#include "sim/passes/cpu/searcher.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/report/report.h"
#include "sim/sea/strip.h"
#include "sim/search/sort.h"
#include "sim/state/gather.h"
#include "sim/step/stages.h"
#include "sim/terms/density_correction.h"
#include "sim/terms/hyperviscosity.h"
#include "sim/terms/surface_tension.h"
#include "sim/walls/mirrors.h"
#include "sim/walls/normals.h"
#include "sim/walls/pushes.h"
#include "sim/walls/walls.h"
#include "sim/wcsph/wcsph.h"

#include <math.h>

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

static bool has_sponge(const sb_scene *scene, sb_sponge_kind kind)
{
    bool any = false;
    for (size_t s = 0; s < scene->sponge_count; s++) any = any || scene->sponges[s].kind == kind;
    return any;
}

/* Whether pairs have a viscosity. */
static bool is_viscous(const sb_scene *scene, const sb_model *model, bool hyperviscosity, bool eddy)
{
    const double faint = hyperviscosity ? sb_faint_viscosity(scene, sb_model_wave_speed(scene, model)) : 0;
    return scene->numerics.artificial_viscosity > 0 || eddy || scene->fluid.viscosity > faint;
}

static sb_needs needs_of(const sb_scene *scene, const sb_model *model)
{
    const sb_numerics *n = &scene->numerics;
    const sb_pressure_solver *solver = sb_pressure_solvers[n->solver];
    const bool shear = n->wall_shear == SB_SHEAR_SMOOTH && scene->fluid.viscosity > 0;
    const bool settling = sb_sim_settles(scene), wcsph = n->solver == SB_SOLVER_WCSPH;
    const bool hyperviscosity = n->hyperviscosity > 0 && scene->fluid.gravity > 0 && !wcsph;
    const bool eddy = n->turbulence == SB_TURBULENCE_SPS || has_sponge(scene, SB_SPONGE_VISCOUS);
    return (sb_needs){
        .density_correction = n->density == SB_DENSITY_COMPLETED && !wcsph,
        .stress_correction = n->stress_correction > 0 && !wcsph,
        .packing_strain = n->density == SB_DENSITY_COMPLETED && n->stress_correction > 0 && !wcsph,
        .steady_stress = n->stress_correction > 0 && n->stress_memory > 0 && scene->fluid.gravity > 0 && !wcsph,
        .turbulence = n->turbulence == SB_TURBULENCE_SPS,
        .wall_shear = shear,
        .wall_drag = shear || n->wall_friction > 0,
        .images = n->walls == SB_WALLS_IMAGES,
        .wall_lists = n->walls != SB_WALLS_IMAGES,
        .wall_body = n->walls == SB_WALLS_IMAGES && (shear || n->wall_friction > 0),
        .sea = sb_scene_has_sea(scene),
        .viscosity = is_viscous(scene, model, hyperviscosity, eddy),
        .hyperviscosity = hyperviscosity,
        .surface_tension = scene->fluid.surface_tension > 0,
        .sponge = has_sponge(scene, SB_SPONGE_DAMPING),
        .viscous_sponge = has_sponge(scene, SB_SPONGE_VISCOUS),
        .eddy = eddy,
        .foam = scene->foam.enabled,
        .settling = settling,
        .start_velocity = settling && sb_model_start_speed(model) > 0,
        .implicit = !wcsph,
        .wcsph = wcsph,
        .dynamic_walls = n->walls == SB_WALLS_DYNAMIC,
        .direction = solver->needs_direction,
        .product = solver->needs_product,
    };
}

static int allocate(sb_sim *sim, size_t n)
{
    const size_t bodies = sim->model->body_count;
    sim->work.body_force = sb_alloc(bodies * SB_FORCE_VALUES, sizeof *sim->work.body_force);
    sim->work.stress_force = sb_alloc(bodies * SB_FORCE_VALUES, sizeof *sim->work.stress_force);
    if (!sim->work.body_force || !sim->work.stress_force || sb_state_create(&sim->state, &sim->needs, n, bodies) != 0)
        return -1;
    return sb_work_create(&sim->work, &sim->needs, n, n);
}

/* The particles of the model with which this domain begins: [from, from + count) of all. The first sort hands over
   those that are in other domains. */
static sb_part start_of(const sb_sim *sim)
{
    const sb_model_part *part = &sim->model->part;
    return part->divided ? (sb_part){part->from, part->here} : sb_gather_part(sim, sim->model->fluid_count);
}

/* Index in the model's arrays of the particle i of all. */
static size_t entry_of(const sb_model *model, size_t i)
{
    return i - model->part.from;
}

static sb_record place_of(const sb_sim *sim, const void *model, size_t i)
{
    const sb_model *m = model;
    return sb_space_record(&sim->space, m->fluid_position[entry_of(m, i)]);
}

static void fill_particle(sb_sim *sim, size_t at, size_t i)
{
    const sb_model *model = sim->model;
    const sb_vec3 v = model->fluid_velocity[entry_of(model, i)];
    const float pressure = (float)model->fluid_pressure[entry_of(model, i)];
    sim->state.position[at] = place_of(sim, model, i);
    sim->state.velocity[at] = (sb_f4){(float)v.x, (float)v.y, (float)v.z, pressure};
    sim->state.id[at] = (uint32_t)i;
    if (sim->state.start_velocity) sim->state.start_velocity[at] = (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
}

static void fill_particles(sb_sim *sim)
{
    const sb_model *model = sim->model;
    const sb_part part = start_of(sim);
    sim->state.next_id = (uint32_t)model->fluid_count;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < part.count; i++) fill_particle(sim, i, part.from + i);
    sim->state.n = part.count;
    sb_wcsph_begin(sim);
    sb_density_correction_clear(sim);
    sim->state.max_speed = sb_model_start_speed(model);
}

/* Divides the particles among the ranks of the run. */
static sb_status create_domains(sb_sim *sim, sb_error *error)
{
    if (!sim->ranks) return SB_OK;
    const sb_status status = sb_domains_agree(sim, sb_domains_create(sim, error), error);
    if (status != SB_OK) return status;
    const sb_part part = start_of(sim);
    return sb_domains_cut_parts(sim, place_of, sim->model, part.from, part.count, error);
}

sb_status sb_sim_create(const sb_scene *scene, const sb_model *model, sb_ranks *ranks, sb_sim **sim, sb_error *error)
{
    sb_sim *made = sb_alloc(1, sizeof *made);
    if (sb_ranks_any(ranks, !made)) {
        sb_free(made);
        return sb_fail_memory(error, "the simulation");
    }
    made->scene = scene;
    made->model = model;
    made->passes = sb_passes_choose();
    made->ranks = sb_ranks_several(ranks) ? ranks : NULL;
    made->exchange = made->ranks ? &sb_exchange_domains : &sb_exchange_alone;
    made->policy = &sb_policy_run;
    made->needs = needs_of(scene, model);
    made->needs.ahead = sb_ranks_several(ranks) && sb_pressure_solvers[scene->numerics.solver]->goes_ahead;
    sb_status status = SB_OK;
    if (model->fluid_count >= (size_t)1 << SB_INDEX_BITS)
        status = sb_fail(error, SB_BAD_INPUT, "%zu fluid particles: expected fewer than %d", model->fluid_count,
                         1 << SB_INDEX_BITS);
    if (status == SB_OK) {
        made->constant = sb_constants_of(scene, model);
        status = create_space(made, error);
        made->work.pairs.unit = sb_lists_unit(made);
    }
    if (status == SB_OK) status = create_domains(made, error);
    if (status == SB_OK && allocate(made, start_of(made).count) != 0) status = sb_fail_memory(error, "fluid particles");
    if (status == SB_OK) status = sb_walls_create(made, error);
    if (status == SB_OK) status = sb_strip_create(made, error);
    if (status == SB_OK) status = sb_foam_create(made, error);
    status = made->exchange->agree(made, status, error);
    if (status != SB_OK) {
        sb_sim_destroy(made);
        return status;
    }
    fill_particles(made);
    sb_report_skipped(made);
    status = made->exchange->agree(made, sb_stage_sort(made, error), error);
    if (made->domains) sb_domains_free_buffers(made->domains);
    if (status != SB_OK) {
        sb_sim_destroy(made);
        return status;
    }
    made->state.ledger = (sb_ledger){0}; /* particles that start outside of the domain do not count as leaving it */
    sb_report_update(made);
    *sim = made;
    return SB_OK;
}

sb_status sb_sim_find_crowding(const sb_scene *scene, const sb_model *model, sb_crowding *found, sb_error *error)
{
    *found = (sb_crowding){.facets = SB_NEAR_MAX, .edges = SB_NEAR_EDGES_MAX};
    if (model->facets.count == 0 || scene->numerics.walls != SB_WALLS_IMAGES) return SB_OK;
    sb_sim *sim = sb_alloc(1, sizeof *sim);
    if (!sim) return sb_fail_memory(error, "facets of walls");
    sim->scene = scene;
    sim->model = model;
    sim->constant = sb_constants_of(scene, model);
    sb_status status = create_space(sim, error);
    if (status == SB_OK) status = sb_paddles_create(sim, error);
    if (status == SB_OK) status = sb_mirrors_create(sim, error);
    if (status == SB_OK) {
        found->width = (double)sim->constant.support;
        if (sb_mirrors_crowded(sim, &found->places, &found->first) != 0)
            status = sb_fail_memory(error, "facets of walls");
    }
    sb_walls_destroy(sim);
    sb_free(sim);
    return status;
}

static void free_lists(sb_sim *sim)
{
    sb_free(sim->work.pairs.four);
    sb_free(sim->work.wall_pairs.index);
    sb_free(sim->work.wall_pairs.slope);
    sb_free(sim->work.edge_pairs.pair);
    sb_groups_destroy(sim);
}

void sb_sim_destroy(sb_sim *sim)
{
    if (!sim) return;
    sb_state_destroy(&sim->state);
    sb_work_destroy(&sim->work);
    sb_free(sim->work.body_force);
    sb_free(sim->work.stress_force);
    free_lists(sim);
    sb_cells_free(&sim->cells);
    sb_ghosts_destroy(sim);
    sb_walls_destroy(sim);
    sb_strip_destroy(sim);
    sb_pushes_destroy(sim->pushes);
    sb_foam_destroy(sim->foam);
    sb_domains_destroy(sim->domains);
    sb_free(sim);
}

const sb_body_impulse *sb_sim_impulse(const sb_sim *sim, size_t body)
{
    return &sim->state.impulse[body];
}

const sb_ledger *sb_sim_ledger(const sb_sim *sim)
{
    return &sim->state.ledger;
}

const sb_crossing *sb_sim_crossing(const sb_sim *sim)
{
    return &sim->state.crossing;
}

double sb_sim_particle_mass(const sb_sim *sim)
{
    return (double)sim->constant.mass;
}

sb_vec3 sb_sim_body_displacement(const sb_sim *sim, size_t body)
{
    uint32_t m = sim->walls.moving_of_body[body];
    return m == UINT32_MAX ? (sb_vec3){0}
                           : sb_scale(sim->walls.moving[m].direction, sim->walls.moving[m].next_displacement);
}

sb_ranks *sb_sim_ranks(const sb_sim *sim)
{
    return sim->ranks;
}

size_t sb_sim_owned(const sb_sim *sim)
{
    return sim->state.n;
}

sb_division sb_sim_division(const sb_sim *sim)
{
    const sb_domains *d = sim->domains;
    sb_division made = {.owned = sim->state.n, .halo = sim->ghosts.halo};
    if (d) made = (sb_division){made.owned, made.halo, d->imbalance, d->mean, d->worst, d->cuts};
    return made;
}

size_t sb_sim_bytes(const sb_sim *sim)
{
    size_t bytes = sb_state_bytes(&sim->state) + sim->work.bytes + sb_cells_bytes(&sim->cells) +
                   sim->work.cell_sum_capacity * sizeof *sim->work.cell_sum +
                   sim->work.node_capacity * SB_TENSION_VALUES * sizeof *sim->work.node +
                   sb_cells_bytes(&sim->ghosts.cells);
    bytes += sim->ghosts.of_capacity * 4 + (sim->ghosts.words_capacity + sim->ghosts.other_capacity) * 8;
    bytes += sim->work.pairs.capacity * sizeof *sim->work.pairs.four + sim->work.wall_pairs.capacity * 8;
    bytes += sb_cells_bytes(&sim->ghosts.halo_cells) + sb_domains_bytes(sim->domains);
    bytes += sb_strip_bytes(sim) + sb_foam_bytes(sim->foam);
    bytes += sim->groups.order_capacity * sizeof *sim->groups.order;
    bytes += sim->groups.capacity * sizeof *sim->groups.group + sim->groups.room * sizeof *sim->groups.run;
    bytes += sim->groups.images_room * sizeof *sim->groups.image + sim->groups.planes_room * sizeof *sim->groups.plane;
    bytes += sim->work.edge_pairs.capacity * sizeof *sim->work.edge_pairs.pair + sb_mirrors_bytes(sim);
    for (int s = 0; s < SB_WALL_SETS; s++)
        bytes += sb_cells_bytes(&sim->walls.set[s].cells) + sim->walls.set[s].count * SB_WALL_BYTES +
                 (sim->walls.set[s].near_mask + 1) * 8;
    bytes += sim->walls.share.count * SB_WALL_BYTES + sb_wall_normals_bytes(&sim->walls.normals);
    bytes += sim->walls.boundary.count * (4 * sizeof(float) + sizeof(uint32_t));
    return bytes + sim->walls.rest.count * SB_WALL_BYTES;
}
