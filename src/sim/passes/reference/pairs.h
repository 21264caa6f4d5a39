/* Pairs of the neighbour lists, one at a time and in double precision. */
#ifndef SB_SIM_REFERENCE_PAIRS_H
#define SB_SIM_REFERENCE_PAIRS_H

#include "base/vec.h"
#include "sim/passes/groups.h"
#include "sim/walls/drag.h"
#include "sim/walls/entry.h"

/* The indices of the records around a group and of the originals of their images, in the order of the places in its
   lists. */
typedef struct sb_indices {
    uint32_t entry[SB_AROUND_MAX];
    uint32_t records; /* without images */
    const sb_image *image;
    const sb_group_plane *plane;
    sb_record corner;
} sb_indices;

/* A pair with another fluid particle or its image: the index from which fields are read, m W'(r)/r times the quantum,
   x_ij in quanta, and the reflections at walls (sb_image.path). */
typedef struct sb_one_pair {
    uint32_t other, path;
    double slope;
    sb_vec3 offset;
} sb_one_pair;

static inline void sb_indices_of(const sb_sim *sim, const sb_group *group, sb_indices *out)
{
    const sb_run *run = sim->groups.run + group->run;
    uint32_t *next = out->entry;
    for (uint32_t r = 0; r < group->runs; r++)
        for (uint32_t k = 0; k < run[r].count; k++) *next++ = run[r].begin + k;
    out->records = (uint32_t)(next - out->entry);
    out->image = sim->groups.image + group->image;
    out->plane = sim->groups.plane + group->plane;
    out->corner = group->corner;
    for (uint32_t k = 0; k < group->images; k++) *next++ = out->image[k].from;
}

static inline sb_vec3 sb_offset_of(sb_record a, sb_record b)
{
    return sb_vec((double)(int32_t)(a[0] - b[0]), (double)(int32_t)(a[1] - b[1]), (double)(int32_t)(a[2] - b[2]));
}

static inline sb_vec3 sb_vector_of(sb_f4 v)
{
    return sb_vec((double)v[0], (double)v[1], (double)v[2]);
}

/* The planes of a path, the first reflection first. Returns their number. */
static inline int sb_path_planes(const sb_indices *indices, uint32_t path,
                                 const sb_group_plane *plane[SB_REFLECTIONS_MAX])
{
    int count = 0;
    for (; path; path >>= SB_REFLECTION_BITS) plane[count++] = &indices->plane[(path & SB_REFLECTION_MASK) - 1];
    return count;
}

/* A vector of a particle as its image has it. */
static inline sb_vec3 sb_image_vector(const sb_indices *indices, uint32_t path, sb_vec3 v)
{
    const sb_group_plane *plane[SB_REFLECTIONS_MAX];
    const int count = sb_path_planes(indices, path, plane);
    for (int k = 0; k < count; k++) {
        const sb_vec3 n = sb_vector_of(plane[k]->plane);
        v = sb_madd(v, -2 * sb_dot(n, v), n);
    }
    return v;
}

/* The same for a place, in quanta from the group's corner. */
static inline sb_vec3 sb_image_place(const sb_indices *indices, uint32_t path, sb_vec3 at)
{
    const sb_group_plane *plane[SB_REFLECTIONS_MAX];
    const int count = sb_path_planes(indices, path, plane);
    for (int k = 0; k < count; k++) {
        const sb_vec3 n = sb_vector_of(plane[k]->plane);
        at = sb_madd(at, -2 * (sb_dot(n, at) - (double)plane[k]->plane[3]), n);
    }
    return at;
}

/* Number of entries of particle i's list; those that pad it have slope 0. sb_direct_count: those that are no images,
   which come first. */
static inline size_t sb_pair_count(const sb_sim *sim, size_t i)
{
    return 4 * (size_t)sim->work.pairs.count[i];
}

static inline size_t sb_direct_count(const sb_sim *sim, size_t i)
{
    return 4 * (size_t)sb_direct(&sim->work.pairs, i);
}

static inline sb_one_pair sb_pair_at(const sb_sim *sim, const sb_indices *indices, size_t i, size_t k)
{
    const sb_four_pairs *four = &sim->work.pairs.four[sim->work.pairs.first[i] + k / 4];
    const double root = (double)four->slope[k % 4];
    const uint32_t at = four->place[k % 4] / SB_PLACE_STEP, other = indices->entry[at];
    const uint32_t path = at < indices->records ? 0 : indices->image[at - indices->records].path;
    const sb_vec3 own = sb_offset_of(sim->state.position[i], indices->corner);
    const sb_vec3 there = sb_image_place(indices, path, sb_offset_of(sim->state.position[other], indices->corner));
    return (sb_one_pair){other, path, root * root * (double)sim->work.pairs.unit, sb_sub(own, there)};
}

/* Number of particle i's pairs at edges. */
static inline size_t sb_edge_count(const sb_sim *sim, size_t i)
{
    return sim->needs.images ? sim->work.edge_pairs.count[i] : 0;
}

static inline const sb_edge_pair *sb_edge_at(const sb_sim *sim, size_t i, size_t k)
{
    return &sim->work.edge_pairs.pair[sim->work.edge_pairs.first[i] + k];
}

/* A pair with a boundary particle: its entry, psi W, psi W'(r)/r times the quantum, x_ib in quanta, unit normal
   (0 0 0: none), and the velocity of the water relative to it. */
enum { SB_PLAIN_WALLS_MAX = 1024 };
typedef struct sb_one_wall {
    uint32_t entry;
    double value, slope;
    sb_vec3 offset, normal, velocity;
} sb_one_wall;

/* walls.c: finds the pairs of particle i, in `out`; returns their number. */
size_t sb_plain_walls(const sb_sim *sim, size_t i, sb_one_wall out[SB_PLAIN_WALLS_MAX]);

/* W in 1/m^d, and W'/r times the quantum. */
typedef struct sb_plain_kernel {
    double value, slope;
} sb_plain_kernel;

sb_plain_kernel sb_plain_kernel_at(const sb_sim *sim, sb_vec3 offset);
bool sb_plain_within(const sb_sim *sim, sb_vec3 offset);

/* Adds the acceleration `a` of a particle by an image to its walls' reactions: each reflection takes what it turns
   round. at: m, the particle; force: as sb_body_sums.force. */
void sb_plain_reflect(const sb_sim *sim, const sb_indices *indices, uint32_t path, sb_vec3 at, sb_vec3 a,
                      double *force);

/* Velocity gradient of particle i from its neighbours, 1/s: gradient[a][b] is that of component a along b. Exact for
   linear fields, unless water is thin: then it returns false, and the gradient is the sum over the density. */
bool sb_plain_gradient(const sb_sim *sim, const sb_indices *around, size_t i, double gradient[3][3]);

/* Acceleration by one boundary particle's friction and shear, m/s^2. */
sb_vec3 sb_plain_drag(const sb_sim *sim, size_t i, const sb_one_wall *wall, const sb_wall_drag *law);

#endif
