/* Samples curved surfaces of the current slab by growth. Each accepted particle proposes neighbours one spacing away
   along the boundary surface. The proposals of a block of particles are computed in parallel. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

enum { BLOCK = 2048, PROPOSALS = 4 };

typedef struct proposals {
    int count;
    sb_sample sample[PROPOSALS];
} proposals;

/* Particles of the set from which growth goes on, and what each proposes. */
typedef struct block {
    size_t from[BLOCK];
    proposals proposed[BLOCK];
} block;

/* Returns a neighbour's direction in a particle's tangent plane, so that growth continues an existing lattice. */
static sb_vec3 find_axis(const sb_sampler *sampler, size_t index)
{
    const sb_sample *s = sampler->set.sample + index;
    if (sampler->settings.dimensions == 2) return sb_vec(s->normal.z, 0, -s->normal.x);
    double spacing = sampler->settings.spacing;
    sb_vec3 side = fabs(s->normal.z) < 0.9 ? sb_vec(0, 0, 1) : sb_vec(1, 0, 0);
    sb_vec3 u = sb_normalize(sb_cross(s->normal, side)), v = sb_cross(s->normal, u);
    for (int i = 0; i < 8; ++i) {
        double angle = i * M_PI / 4;
        sb_vec3 at = sb_madd(s->at, spacing * cos(angle), u);
        size_t near = index;
        sb_sample_set_nearest(&sampler->set, sb_madd(at, spacing * sin(angle), v), 0.45 * spacing, &near);
        if (near == index) continue;
        sb_vec3 arm = sb_sub(sampler->set.sample[near].at, s->at);
        return sb_normalize(sb_madd(arm, -sb_dot(arm, s->normal), s->normal));
    }
    return u;
}

static void propose(const sb_sampler *sampler, size_t index, proposals *out)
{
    const sb_sample *s = sampler->set.sample + index;
    double spacing = sampler->settings.spacing, least = SB_SAMPLE_LATTICE * spacing;
    sb_vec3 u = find_axis(sampler, index), v = sb_cross(s->normal, u);
    sb_vec3 direction[PROPOSALS] = {u, sb_scale(u, -1), v, sb_scale(v, -1)};
    out->count = 0;
    for (int i = 0; i < (sampler->settings.dimensions == 2 ? 2 : PROPOSALS); ++i) {
        sb_vec3 at = sb_madd(s->at, spacing, direction[i]);
        sb_sample *next = out->sample + out->count;
        if (!sb_sample_set_any(&sampler->set, at, least) && sb_sample_project(sampler, s->source, at, next) &&
            sb_slab_owns(sampler, next->at) && !sb_sample_set_any(&sampler->set, next->at, least))
            ++out->count;
    }
}

/* Whether growth from a particle can reach the current slab. */
static bool reaches(const sb_sampler *sampler, size_t index)
{
    const double at = sb_sample_along(sampler->set.sample[index].at, sampler->slabs.axis);
    return sb_slab_meets(sampler, at, at, 2 * sampler->settings.spacing);
}

/* Grows from the particles [begin, ...) of the set that are near the current slab, and from those that are added. The
   blocks do not depend on other particles of the set. */
static int grow(sb_sampler *sampler, size_t begin, block *b)
{
    double least = SB_SAMPLE_LATTICE * sampler->settings.spacing;
    int failed = 0;
    while (begin < sampler->set.count && !failed) {
        size_t count = 0;
        for (; begin < sampler->set.count && count < BLOCK; ++begin)
            if (reaches(sampler, begin)) b->from[count++] = begin;
#pragma omp parallel for schedule(dynamic, 32)
        for (size_t i = 0; i < count; ++i)
            if (!sb_stop_signal()) propose(sampler, b->from[i], b->proposed + i);
        failed = sb_stop_signal();
        for (size_t i = 0; i < count && !failed; ++i)
            for (int k = 0; k < b->proposed[i].count && !failed; ++k)
                if (!sb_sample_set_any(&sampler->set, b->proposed[i].sample[k].at, least))
                    failed = sb_sample_set_add(&sampler->set, b->proposed[i].sample + k);
    }
    return failed;
}

/* Whether no particle is near a point of the boundary surface. */
static bool is_bare(const sb_sampler *sampler, sb_vec3 at)
{
    return !sb_sample_set_any(&sampler->set, at, 2 * sampler->settings.spacing);
}

/* Places a particle at a triangle of the current slab that growth has not reached. Returns false if there is no need.
 */
static bool find_seed(const sb_sampler *sampler, uint32_t index, size_t t, sb_sample *seed)
{
    const sb_surface *surface = sampler->surfaces + index;
    const sb_mesh *mesh = sb_surface_mesh(surface);
    const sb_vec3 normal = surface->normal[t], inward = sb_scale(normal, -1);
    sb_vec3 at = {0};
    for (int i = 0; i < 3; ++i) at = sb_madd(at, 1.0 / 3, mesh->vertices[mesh->triangles[t][i]]);
    if (sampler->settings.dimensions == 2) at.y = 0;
    *seed = (sb_sample){.normal = normal, .source = index, .slab = sampler->slab};
    double margin;
    return sb_dot(normal, normal) > 0 && sb_slab_owns(sampler, at) &&
           is_bare(sampler, sb_madd(at, sampler->settings.offset, inward)) &&
           sb_sample_exposed(sampler, index, at, normal) &&
           sb_sample_place(sampler, index, at, inward, &seed->at, &margin) == SB_PLACED && is_bare(sampler, seed->at);
}

/* Grows from seeds on the triangles of a surface that no growth has reached yet, in their order. */
static int grow_from_seeds(sb_sampler *sampler, uint32_t index, block *b)
{
    const sb_surface *surface = sampler->surfaces + index;
    sb_sample seed;
    for (size_t t = 0; t < sb_surface_mesh(surface)->triangle_count && !surface->mixed; ++t)
        if (sb_stop_signal() || (find_seed(sampler, index, t, &seed) &&
                                 (sb_sample_set_add(&sampler->set, &seed) || grow(sampler, sampler->set.count - 1, b))))
            return -1;
    return 0;
}

int sb_sample_grow(sb_sampler *sampler)
{
    block *b = sb_alloc_untouched(1, sizeof *b);
    if (!b) return -1;
    int failed = grow(sampler, 0, b);
    for (uint32_t i = sampler->first; i < sampler->last && !failed; ++i)
        if (sb_sampler_takes(sampler, i)) failed = grow_from_seeds(sampler, i, b);
    sb_free(b);
    return failed;
}
