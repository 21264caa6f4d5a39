/* The passes of the pressure: accelerations, divergences, virial pressures. */
#include "sim/passes/reference/pairs.h"
#include "sim/passes/reference/reference.h"

#include <math.h>

static void accelerate_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        const double own = (double)sb_carried_value(sim->state.position[i]);
        sb_vec3 sum = sb_scale(sb_vector_of(sb_wall_vector(sim, i)), own);
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            const double other = (double)sb_carried_value(sim->state.position[p.other]);
            sum = sb_madd(sum, (own + other) * p.slope, p.offset);
        }
        for (size_t k = 0; k < sb_edge_count(sim, i); k++) {
            const sb_edge_pair *e = sb_edge_at(sim, i, k);
            sum = sb_madd(sum, own + (double)sb_carried_value(sim->state.position[e->entry]),
                          sb_vector_of(sb_edge_own(e)));
        }
        sim->work.acceleration[i] = (sb_f4){(float)-sum.x, (float)-sum.y, (float)-sum.z, 0};
    }
}

static void accelerate(sb_sim *sim)
{
    sb_each_group(sim, accelerate_group, NULL);
}

typedef struct divergence {
    const sb_f4 *field;
    float factor;
    float *out;
} divergence;

static void diverge_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const divergence *of = arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_vec3 own = sb_vector_of(of->field[i]);
        double sum = sb_dot(own, sb_vector_of(sb_wall_vector(sim, i)));
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            const sb_vec3 other = sb_image_vector(&around, p.path, sb_vector_of(of->field[p.other]));
            sum += p.slope * sb_dot(sb_sub(own, other), p.offset);
        }
        for (size_t k = 0; k < sb_edge_count(sim, i); k++) {
            const sb_edge_pair *e = sb_edge_at(sim, i, k);
            sum += sb_dot(sb_vector_of(sb_edge_own(e)), own) +
                   sb_dot(sb_vector_of(sb_edge_other(e)), sb_vector_of(of->field[e->entry]));
        }
        of->out[i] = (float)((double)of->factor * sum);
    }
}

static void diverge(sb_sim *sim, const sb_f4 *field, float factor, float *out)
{
    sb_each_group(sim, diverge_group, &(divergence){field, factor, out});
}

/* Where the particle or image `entry` was when the lists were made, in quanta from the group's corner. */
static sb_vec3 place_before(const sb_sim *sim, const sb_group *group, uint32_t entry)
{
    const sb_vec3 at = sb_offset_of(sim->state.position[entry], group->corner);
    const double back = entry < sb_images_first(sim) ? -sim->state.time_step / sim->space.quantum : 0;
    return sb_madd(at, back, sb_vector_of(sim->state.velocity[entry]));
}

static double unknown_of(const sb_sim *sim, uint32_t entry)
{
    return (double)sim->work.unknown[sb_entry_owner(sim, (uint32_t)entry)];
}

static void virial_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    const double factor = -0.5 * (double)sim->constant.rest_density * sim->space.quantum / sim->constant.dimension;
    for (size_t i = group->first; i < group->end; i++) {
        const sb_vec3 own = place_before(sim, group, (uint32_t)i);
        double sum = 0;
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            const sb_vec3 d = sb_sub(own, sb_image_place(&around, p.path, place_before(sim, group, p.other)));
            sum += (unknown_of(sim, (uint32_t)i) + unknown_of(sim, p.other)) * p.slope * sb_dot(d, d);
        }
        sb_one_wall walls[SB_PLAIN_WALLS_MAX];
        const size_t count = sim->needs.images ? 0 : sb_plain_walls(sim, i, walls);
        for (size_t k = 0; k < count; k++) {
            const uint32_t entry = walls[k].entry;
            const sb_record record = sb_wall_set_of(sim, entry)->record[sb_wall_particle(entry)];
            const sb_vec3 d = sb_sub(own, sb_offset_of(record, group->corner));
            sum += unknown_of(sim, (uint32_t)i) * walls[k].slope * sb_dot(d, d);
        }
        sim->work.virial[i] = (float)(factor * sum);
    }
}

static void virial(sb_sim *sim)
{
    sb_each_group(sim, virial_group, NULL);
}

const sb_passes sb_passes_reference = {
    .name = "reference",
    .neighbours = sb_plain_neighbours,
    .deviator = sb_plain_deviator,
    .mean_deviator = sb_plain_mean_deviator,
    .differences = sb_plain_differences,
    .correct = sb_plain_correct,
    .strain = sb_plain_strain,
    .strained = sb_plain_strained,
    .strain_rate = sb_plain_strain_rate,
    .forces = sb_plain_forces,
    .accelerate = accelerate,
    .diverge = diverge,
    .virial = virial,
    .bodies = sb_plain_bodies,
};
