/* Pairs of the neighbour lists, one at a time and in double precision. */
#ifndef SB_SIM_REFERENCE_PAIRS_H
#define SB_SIM_REFERENCE_PAIRS_H

#include "base/vec.h"
#include "sim/passes/groups.h"
#include "sim/walls/drag.h"
#include "sim/walls/entry.h"

/* The indices of the records around a group, in the order of the places in its lists. */
typedef struct sb_indices {
    uint32_t entry[SB_AROUND_MAX];
} sb_indices;

/* A pair with another fluid particle or its image: the index from which fields are read, m W'(r)/r times the quantum,
   and x_ij in quanta. */
typedef struct sb_one_pair {
    uint32_t other;
    double slope;
    sb_vec3 offset;
} sb_one_pair;

static inline void sb_indices_of(const sb_sim *sim, const sb_group *group, sb_indices *out)
{
    const sb_run *run = sim->groups.run + group->run;
    uint32_t *next = out->entry;
    for (uint32_t r = 0; r < group->runs; r++)
        for (uint32_t k = 0; k < run[r].count; k++) *next++ = run[r].begin + k;
}

static inline sb_vec3 sb_offset_of(sb_record a, sb_record b)
{
    return sb_vec((double)(int32_t)(a[0] - b[0]), (double)(int32_t)(a[1] - b[1]), (double)(int32_t)(a[2] - b[2]));
}

static inline sb_vec3 sb_vector_of(sb_f4 v)
{
    return sb_vec((double)v[0], (double)v[1], (double)v[2]);
}

/* Number of entries of particle i's list; those that pad it have slope 0. */
static inline size_t sb_pair_count(const sb_sim *sim, size_t i)
{
    return 4 * (size_t)sim->work.pairs.count[i];
}

static inline sb_one_pair sb_pair_at(const sb_sim *sim, const sb_indices *indices, size_t i, size_t k)
{
    const sb_four_pairs *four = &sim->work.pairs.four[sim->work.pairs.first[i] + k / 4];
    const double root = (double)four->slope[k % 4];
    const uint32_t other = indices->entry[four->place[k % 4] / SB_PLACE_STEP];
    return (sb_one_pair){other, root * root * (double)sim->work.pairs.unit,
                         sb_offset_of(sim->state.position[i], sim->state.position[other])};
}

/* A pair with a boundary particle: its entry, psi W'(r)/r times the quantum, x_ib in quanta, unit normal (0 0 0: none),
   and the velocity of the water relative to it. */
typedef struct sb_one_wall {
    uint32_t entry;
    double slope;
    sb_vec3 offset, normal, velocity;
} sb_one_wall;

static inline sb_one_wall sb_wall_at(const sb_sim *sim, size_t i, size_t k)
{
    const size_t at = sim->work.wall_pairs.first[i] + k;
    const uint32_t entry = sim->work.wall_pairs.index[at];
    const sb_wall_set *set = sb_wall_set_of(sim, entry);
    const uint32_t b = sb_wall_particle(entry);
    return (sb_one_wall){entry, (double)sim->work.wall_pairs.slope[at],
                         sb_offset_of(sim->state.position[i], set->record[b]), sb_vector_of(set->normal[b]),
                         sb_sub(sb_vector_of(sim->state.velocity[i]), sb_vector_of(sb_wall_velocity(sim, entry)))};
}

/* Acceleration by one boundary particle's friction and shear, m/s^2. */
sb_vec3 sb_plain_drag(const sb_sim *sim, size_t i, const sb_one_wall *wall, const sb_wall_drag *law);

#endif
