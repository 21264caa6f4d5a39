#include "sim/passes/cpu/search_parts.h"

#include "base/memory.h"
#include "sim/walls/entry.h"

#include <math.h>

SB_MULTIVERSION
void sb_round_slopes(float *restrict slope, float *restrict root, size_t count, float to_units)
{
    const float most = (float)SB_ROOT_MAX;
#pragma omp simd
    for (size_t k = 0; k < count; k++) {
        const float rounded = (float)(int)(sqrtf(slope[k] * to_units) + 0.5f);
        root[k] = rounded < most ? rounded : most;
        slope[k] = root[k] * root[k];
    }
}

/* Sums over the fluid neighbours of one particle: part of the density, S_i, and sum |m grad W|^2. */
SB_INLINE void fluid_sums(sb_searcher *w, float mass, float unit, float *density, sb_f4 *sum, float *squares)
{
    sb_hits *h = &w->hits;
    sb_f8 value = {0}, x = {0}, y = {0}, z = {0}, square = {0};
    for (size_t k = 0; k < h->padded; k += SB_HIT_LANES) value += *(const sb_f8 *)(h->value + k);
    sb_round_slopes(h->slope, h->root, h->padded, w->to_units);
    for (size_t k = 0; k < h->padded; k += SB_HIT_LANES) {
        const sb_f8 slope = *(const sb_f8 *)(h->slope + k) * unit;
        x += slope * *(const sb_f8 *)(h->x + k);
        y += slope * *(const sb_f8 *)(h->y + k);
        z += slope * *(const sb_f8 *)(h->z + k);
        square += slope * slope * *(const sb_f8 *)(h->q2 + k);
    }
    *density += mass * w->value_scale * sb_sum8(&value);
    *sum += (sb_f4){sb_sum8(&x), sb_sum8(&y), sb_sum8(&z), 0};
    *squares = sb_sum8(&square) / w->q_scale;
}

/* Sums over the boundary particles around one particle: part of the density, and B_i = sum_b psi_b grad W_ib with the
   flux sum_b psi_b v_b . grad W_ib of moving walls in the last lane. */
SB_INLINE void wall_sums(const sb_sim *sim, const sb_searcher *w, const sb_hits *h, float *density, sb_f4 *wall)
{
    float value = 0;
    sb_f4 sum = {0};
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t index = h->candidate[k];
        const float slope = h->slope[k];
        sb_f4 gradient = {slope * h->x[k], slope * h->y[k], slope * h->z[k], 0};
        value += h->root[k] * h->value[k];
        if (sb_wall_moves(index)) gradient[3] = sb_sum3(sb_wall_velocity(sim, index) * gradient);
        sum += gradient;
    }
    *density += w->value_scale * value;
    *wall = sum;
}

/* Boundary particles around particle i: their list, their part of the density, and B_i. */
SB_INLINE void add_walls(sb_sim *sim, sb_searcher *w, sb_list_builder *lists, size_t i, float *density, sb_f4 *wall)
{
    const sb_hits *h = sb_wall_finder_find(sim, &w->walls, i);
    sim->work.wall_pairs.count[i] = 0;
    if (h->count == 0) return;
    wall_sums(sim, w, h, density, wall);
    sb_list_walls(lists, h, sim, i);
}

/* Searches the neighbours of particle i and fills in its fields. candidate: its index in the vicinity. */
SB_INLINE void one_particle(sb_sim *sim, sb_searcher *w, sb_list_builder *lists, const sb_group *group, size_t i,
                            uint32_t candidate)
{
    const sb_constants *c = &sim->constant;
    const sb_vicinity *v = &w->vicinity;
    float density = c->mass * w->value_scale * (float)sim->scene->numerics.kernel->shape(0);
    float squares = 0;
    sb_f4 sum = {0}, doubled = {0}, wall = {0}, self = sb_offset(sim->state.position[i], group->corner);
    sb_candidate_range range[SB_VICINITY_ROWS];
    const size_t ranges = sb_vicinity_candidates(sim, v, 0, v->parts, self, range);
    const size_t edges = lists->edges;
    sb_hits *h = &w->hits;
    sb_reflections by_images = {0};
    sb_search_hits(w, h, &(sb_candidates){v->x, v->y, v->z, v->place}, range, ranges, self, candidate, candidate);
    if (h->count >= SB_LIST_MAX) w->full |= SB_FULL_LIST;
    w->batch(w->kernel, h->q2, h->padded, h->value, h->slope);
    if (v->images > 0) {
        sb_images_weigh_direct(sim, &w->images, self, h);
        by_images = sb_search_images(sim, w, lists, self, candidate);
    }
    fluid_sums(w, c->mass, sim->work.pairs.unit, &density, &sum, &squares);
    sb_list_water(lists, h, sim, i);
    if (sim->needs.images) {
        sim->work.image_push[i] = by_images.push;
        sim->work.edge_pairs.first[i] = (uint32_t)edges;
        sim->work.edge_pairs.count[i] = (uint16_t)(lists->edges - edges);
    }
    if (v->images > 0) {
        if (w->reflected.count > 0) sb_list_reflected(lists, &w->reflected, sim, i);
        density += by_images.density;
        sum += by_images.gradient;
        doubled = by_images.doubled;
        wall[3] = by_images.flux;
        squares = by_images.squares;
    }
    /* It shows the surface. The repulsion from a wall is no surface: a film on a floor would count as full water. */
    const sb_f4 slope = sum - by_images.repulsion;
    if (sim->work.water_squared) sim->work.water_squared[i] = sb_sum3(slope * slope);
    if (sim->needs.wall_lists) add_walls(sim, w, lists, i, &density, &wall);
    float diagonal = squares;
    const sb_f4 all = sum + doubled + wall;
    for (int axis = 0; axis < 3; axis++) diagonal += all[axis] * all[axis];
    sim->work.density[i] = density;
    if (sim->work.wall)
        sim->work.wall[i] = wall;
    else
        sim->work.flux[i] = wall[3];
    sim->work.diagonal[i] = diagonal > 1e-6f * c->full_diagonal ? diagonal : 0;
}

SB_MULTIVERSION
static void search_group(sb_sim *sim, sb_searcher *w, sb_list_builder *lists, sb_group *group)
{
    const int shift = sim->space.shift;
    uint64_t last = UINT64_MAX;
    uint32_t candidate = 0;
    for (size_t i = group->first; i < group->end; i++) {
        const uint64_t code = sb_cell_code(sim->state.position[i], shift);
        if (code != last) candidate = sb_vicinity_candidate(sim, &w->vicinity, i);
        last = code;
        one_particle(sim, w, lists, group, i, candidate++);
    }
}

unsigned sb_search_group(sb_sim *sim, void *of, sb_list_builder *lists, sb_group *group)
{
    sb_searcher *w = of;
    w->full = 0;
    sb_wall_finder_begin(&w->walls, &w->wall_search);
    sb_vicinity_gather(sim, group, &w->vicinity);
    if (w->vicinity.count > SB_AROUND_MAX) return SB_FULL_AROUND;
    if (sim->needs.images && !sb_images_gather(sim, group, &w->vicinity, &w->images))
        return SB_FULL_FACETS | SB_CROWDED;
    sb_list_runs(lists, &w->vicinity, group);
    search_group(sim, w, lists, group);
    sb_list_images(lists, &w->vicinity, sim->needs.images ? &w->images : NULL, group);
    return w->full | w->walls.full;
}

float sb_lists_unit(const sb_sim *sim)
{
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    const float coincident = 0;
    float value, steepest;
    sb_kernel_batch_for(kernel)(kernel, &coincident, 1, &value, &steepest);
    return sim->constant.mass * sb_wall_search_of(sim).slope_scale * steepest /
           ((float)SB_ROOT_MAX * (float)SB_ROOT_MAX);
}

void *sb_searcher_create(const sb_sim *sim)
{
    sb_searcher *w = sb_alloc_untouched(1, sizeof *w);
    if (!w) return NULL;
    const sb_kernel *kernel = sim->scene->numerics.kernel;
    const int d = sim->constant.dimension;
    const double h = (double)sim->constant.support;
    w->wall_search = sb_wall_search_of(sim);
    w->kernel = kernel;
    w->batch = w->wall_search.batch;
    w->find_hits = w->wall_search.find_hits;
    w->q_scale = w->wall_search.q_scale;
    w->value_scale = (float)(kernel->alpha[d] / pow(h, d));
    w->slope_scale = w->wall_search.slope_scale;
    w->to_units = sim->constant.mass * w->slope_scale / sim->work.pairs.unit;
    return w;
}
