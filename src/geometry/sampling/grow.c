/* Samples curved surfaces by growth. Each accepted particle proposes neighbours one spacing away along the boundary
   surface. The proposals of a block of particles are computed in parallel. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

enum { BLOCK = 2048, PROPOSALS = 4 };

typedef struct proposals {
    int count;
    sb_sample sample[PROPOSALS];
} proposals;

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
            !sb_sample_set_any(&sampler->set, next->at, least))
            ++out->count;
    }
}

/* Adds one seed particle for each connected part that has no particle yet. */
static int plant_seeds(sb_sampler *sampler, uint32_t index)
{
    const sb_surface *surface = sampler->surfaces + index;
    const sb_mesh *mesh = sb_surface_mesh(surface);
    bool *done = sb_alloc(mesh->triangle_count, sizeof *done);
    int failed = !done;
    for (size_t t = 0; t < mesh->triangle_count && !failed && !surface->mixed; ++t) {
        if (done[surface->part[t]] || sb_dot(surface->normal[t], surface->normal[t]) == 0) continue;
        sb_vec3 at = {0}, placed, inward = sb_scale(surface->normal[t], -1);
        for (int i = 0; i < 3; ++i) at = sb_madd(at, 1.0 / 3, mesh->vertices[mesh->triangles[t][i]]);
        if (sampler->settings.dimensions == 2) at.y = 0;
        double margin;
        if (sb_sample_place(sampler, index, at, inward, &placed, &margin) != SB_PLACED) continue;
        done[surface->part[t]] = true;
        if (!sb_sample_set_any(&sampler->set, placed, 2 * sampler->settings.spacing))
            failed = sb_sample_set_add(&sampler->set, &(sb_sample){placed, surface->normal[t], index});
    }
    sb_free(done);
    return failed;
}

int sb_sample_grow(sb_sampler *sampler)
{
    double least = SB_SAMPLE_LATTICE * sampler->settings.spacing;
    for (uint32_t i = sampler->first; i < sampler->last; ++i)
        if (sb_sampler_takes(sampler, i) && plant_seeds(sampler, i)) return -1;
    proposals *block = sb_alloc_untouched(BLOCK, sizeof *block);
    if (!block) return -1;
    int failed = 0;
    for (size_t begin = 0; begin < sampler->set.count && !failed;) {
        size_t left = sampler->set.count - begin, count = left < BLOCK ? left : BLOCK;
#pragma omp parallel for schedule(dynamic, 32)
        for (size_t i = 0; i < count; ++i)
            if (!sb_stop_signal()) propose(sampler, begin + i, block + i);
        failed = sb_stop_signal();
        for (size_t i = 0; i < count && !failed; ++i)
            for (int k = 0; k < block[i].count && !failed; ++k)
                if (!sb_sample_set_any(&sampler->set, block[i].sample[k].at, least))
                    failed = sb_sample_set_add(&sampler->set, block[i].sample + k);
        begin += count;
    }
    sb_free(block);
    return failed;
}
