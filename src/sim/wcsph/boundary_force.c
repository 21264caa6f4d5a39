/* Forces between water and dynamic boundary particles by the pressures of the latter. */
#include "base/memory.h"
#include "sim/exchange/exchange.h"
#include "sim/passes/cpu/body_forces.h"
#include "sim/passes/groups.h"
#include "sim/walls/entry.h"
#include "sim/walls/pushes.h"
#include "sim/wcsph/boundary.h"

/* psi_b q_b grad W_ib of pair k of particle i, m/s^2. */
SB_INLINE sb_f4 pull(const sb_sim *sim, size_t i, size_t k)
{
    const uint32_t index = sim->work.wall_pairs.index[k];
    const sb_wall_set *set = sb_wall_set_of(sim, index);
    const uint32_t b = sb_wall_particle(index);
    const float q = sim->walls.boundary.load[sb_boundary_number(set, b)];
    return sb_offset(sim->state.position[i], set->record[b]) * sb_splat(sim->work.wall_pairs.slope[k] * q);
}

SB_MULTIVERSION
static void accelerate_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    for (size_t i = group->first; i < group->end; i++) {
        const size_t begin = sim->work.wall_pairs.first[i], end = begin + sim->work.wall_pairs.count[i];
        sb_f4 sum = {0};
        for (size_t k = begin; k < end; k++) sum += pull(sim, i, k);
        sum[3] = 0;
        sim->work.acceleration[i] -= sum;
    }
}

void sb_boundary_accelerate(sb_sim *sim)
{
    sb_each_group(sim, accelerate_group, NULL);
}

/* Adds the forces of one group on bodies. */
static void push_group(sb_sim *sim, const sb_group *group, sb_body_forces *to)
{
    const double mass = (double)sim->constant.mass;
    const bool recorded = sb_pushes_near(sim, group);
    bool any = false;
    for (size_t i = group->first; i < group->end; i++) {
        const size_t begin = sim->work.wall_pairs.first[i], end = begin + sim->work.wall_pairs.count[i];
        const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
        for (size_t k = begin; k < end; k++) {
            const uint32_t wall = sim->work.wall_pairs.index[k];
            const sb_f4 p = pull(sim, i, k);
            const sb_vec3 force = sb_scale(sb_vec((double)p[0], (double)p[1], (double)p[2]), mass);
            if (sb_norm(force) == 0) continue;
            const sb_record of = sb_wall_set_of(sim, wall)->record[sb_wall_particle(wall)];
            const sb_vec3 shift = sim->space.repeats ? sb_wall_to_original(&sim->space, of) : (sb_vec3){0};
            sb_body_forces_add(sim, to, sb_wall_body(sim, wall), sb_add(at, shift), force, (sb_vec3){0});
            if (recorded) sb_wall_push_record(sim, i, wall, force);
            any = true;
        }
    }
    if (any) sb_body_forces_close(to);
}

sb_status sb_stage_boundary_forces(sb_sim *sim, sb_error *error)
{
    const size_t groups = sim->groups.count, bodies = sim->model->body_count, values = bodies * SB_FORCE_VALUES;
    sb_exact *all = sb_alloc(values, sizeof *all);
    bool enough = all != NULL;
#pragma omp parallel reduction(&& : enough)
    {
        sb_body_forces own = {0};
        enough = all && sb_body_forces_create(&own, bodies) == 0;
#pragma omp for schedule(dynamic, SB_GROUPS_AT_A_TIME)
        for (size_t g = 0; g < groups; g++)
            if (enough) push_group(sim, &sim->groups.group[g], &own);
        if (enough) sb_sums_merge(all, own.all, values);
        sb_body_forces_free(&own);
    }
    enough = sim->exchange->agree(sim, enough ? SB_OK : SB_FAILED, NULL) == SB_OK;
    if (enough) sim->exchange->sum(sim, all, values);
    for (size_t v = 0; v < values && enough; v++) sim->work.stress_force[v] = sb_exact_value(&all[v]);
    sb_free(all);
    return enough ? SB_OK : sb_fail_memory(error, "forces on bodies");
}
