/* The pairs of a particle with images. */
#include "base/memory.h"
#include "sim/passes/cpu/body_forces.h"
#include "sim/passes/cpu/search_parts.h"

#include <math.h>

/* A particle's own image at less than one spacing repels it by REPULSION/2 W(0) (1 - r/spacing)^2 besides the kernel,
   whose slope vanishes at r = 0. Else a particle may pair with its own image (docs/method.md). */
static const float REPULSION = 2;

/* Pairs at edges below this part of m W(0)/spacing are left out. */
static const float NEGLIGIBLE = 1e-3f;

/* The entry of a candidate in the arrays that neighbours are read from. */
static uint32_t entry_of(const sb_vicinity *v, uint32_t candidate)
{
    uint32_t before = 0, run = 0;
    while (candidate >= before + v->run[run].count) before += v->run[run++].count;
    return v->run[run].begin + candidate - before;
}

/* Finds the hits of the originals, and gives the weight 0 to images whose originals are not within the support radius:
   paths round an edge, with one end behind the facet, can be shorter than the straight line. The particle itself counts
   as the hit after the last. Returns whether it has images of itself. */
SB_INLINE bool find_originals(sb_searcher *w, uint32_t self)
{
    sb_hits *h = &w->reflected;
    const uint32_t count = (uint32_t)w->hits.count, records = (uint32_t)w->vicinity.count;
    const uint32_t *source = w->images.source, *hit_of = w->hit_of, *candidate = w->hits.candidate;
    uint32_t *original = w->original;
    uint32_t own = 0;
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t from = source[h->candidate[k] - records], noted = hit_of[from];
        const uint32_t hit = noted < count ? noted : 0;
        const bool is_own = from == self;
        original[k] = is_own ? count : hit;
        h->root[k] = is_own || (noted < count && candidate[hit] == from) ? 1 : 0;
        own |= is_own;
    }
    return own != 0;
}

/* Adds a pair at an edge: vectors in kg/m^4. Pairs with the same particle by facets of the same body are one: where
   facets bend little they nearly cancel. */
static void add_edge(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, uint32_t source,
                     uint32_t facet, sb_f4 own, sb_f4 other, sb_reflections *r)
{
    const sb_near_facet *f = &w->images.near.facet[facet];
    r->flux += sb_sum3((own + other) * f->velocity);
    size_t *slot = source == self ? &w->edge_own : &w->edge_of[w->hit_of[source]];
    if (*slot >= w->edges && *slot < lists->edges && lists->edge[*slot].entry == source &&
        sb_mirror_body(sim, lists->edge[*slot].mirror) == sb_mirror_body(sim, f->mirror)) {
        lists->edge[*slot].own += own;
        lists->edge[*slot].other += other;
        return;
    }
    if (sb_grow((void **)&lists->edge, &lists->capacity_edge, lists->edges + 1, sizeof *lists->edge) != 0) {
        lists->out_of_memory = true;
        return;
    }
    *slot = lists->edges;
    lists->edge[lists->edges++] = (sb_edge_pair){own, other, source, f->mirror};
}

/* Forgets the pairs at edges of the last particle. */
static void clear_edges(sb_searcher *w)
{
    w->edge_own = SIZE_MAX;
    for (size_t k = 0; k < w->hits.count; k++) w->edge_of[k] = SIZE_MAX;
}

/* Adds to the force on a hit by the pressure of the present particle. */
SB_INLINE void add_force(sb_searcher *w, uint32_t hit, sb_f4 force)
{
    w->force_x[hit] += force[0];
    w->force_y[hit] += force[1];
    w->force_z[hit] += force[2];
}

/* Completes the pairs at edges of a particle, and sums them. */
static void close_edges(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, sb_reflections *r)
{
    const float least = NEGLIGIBLE * sim->constant.mass * w->value_scale / sim->constant.spacing;
    size_t kept = w->edges;
    for (size_t k = w->edges; k < lists->edges; k++) {
        sb_edge_pair e = lists->edge[k];
        if (sb_sum3(e.own * e.own) + sb_sum3(e.other * e.other) < least * least) continue;
        r->gradient += e.own;
        const uint32_t hit = w->hit_of[e.entry];
        if (e.entry == self)
            r->doubled += e.other;
        else
            add_force(w, hit, e.other);
        e.entry = entry_of(&w->vicinity, e.entry);
        lists->edge[kept++] = e;
    }
    lists->edges = kept;
}

/* Adds the pairs at edges of those weights [from, to) that belong to these hits. */
static void add_edges(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, size_t from, size_t to,
                      const sb_hits *h, sb_reflections *r)
{
    const float scale = sim->constant.mass * w->value_scale / (float)sim->space.quantum;
    if (w->images.slopes > SB_WEIGHT_SLOPES_MAX) {
        w->full |= SB_FULL_FACETS;
        return;
    }
    for (size_t k = from; k < to; k++) {
        const sb_weight_slope *s = &w->images.slope[k];
        if (h->root[s->hit] == 0) continue;
        const uint32_t candidate = h->candidate[s->hit];
        const uint32_t source = s->direct ? candidate : w->images.source[candidate - w->vicinity.count];
        const sb_f4 whole = sb_splat(scale * h->value[s->hit]);
        add_edge(sim, w, lists, self, source, s->facet, s->own * whole, s->other * whole, r);
    }
}

/* Adds what repels particle i from its own images, to the values of their hits and as pairs at edges. */
static void repel(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, sb_reflections *r)
{
    sb_hits *h = &w->reflected;
    const float end = sim->constant.spacing / sim->constant.support;
    const float top = REPULSION * (float)w->kernel->shape(0);
    for (size_t k = 0; k < h->count; k++) {
        if (w->original[k] != w->hits.count || h->q2[k] >= end * end || h->root[k] == 0) continue;
        const uint32_t path = w->images.path[h->candidate[k] - w->vicinity.count];
        if (path > SB_REFLECTION_MASK) continue;
        const float q = sqrtf(h->q2[k]) + 1e-6f, left = 1 - q / end;
        const float slope = -top * left / (end * q) * sim->constant.mass * w->slope_scale * h->root[k];
        const sb_f4 push = (sb_f4){h->x[k], h->y[k], h->z[k], 0} * sb_splat(slope);
        h->value[k] += 0.5f * top * left * left;
        r->repulsion += push;
        add_edge(sim, w, lists, self, self, path - 1, push, push, r);
    }
}

/* Velocity of an image by the motion of walls, m/s. */
static sb_f4 image_velocity(const sb_near *near, uint32_t path)
{
    sb_f4 v = {0};
    for (; path; path >>= SB_REFLECTION_BITS) {
        const sb_near_facet *f = &near->facet[(path & SB_REFLECTION_MASK) - 1];
        const float twice = 2 * sb_sum3(f->plane * f->velocity);
        v = sb_reflect_vector(f->plane, v) + f->plane * (sb_f4){twice, twice, twice, 0};
    }
    return v;
}

/* The parts of a vector along the normals of a path's planes; see sb_reactions_normal. */
SB_INLINE sb_f4 normal_part(const sb_near *near, uint32_t path, sb_f4 a)
{
    sb_f4 all = {0};
    for (; path; path >>= SB_REFLECTION_BITS) {
        const sb_f4 plane = near->facet[(path & SB_REFLECTION_MASK) - 1].plane;
        const float along = sb_sum3(plane * a);
        const sb_f4 part = plane * (sb_f4){along, along, along, 0};
        a -= part;
        all += part;
    }
    return all;
}

/* Removes the hits whose paths have no weight, and weighs the others. Returns the sum of their values. */
SB_INLINE float take_weights(sb_searcher *w, uint32_t pad)
{
    sb_hits *h = &w->reflected;
    uint32_t *original = w->original;
    size_t kept = 0;
    float value = 0;
    for (size_t k = 0; k < h->count; k++) {
        const float weight = h->root[k];
        h->x[kept] = h->x[k], h->y[kept] = h->y[k], h->z[kept] = h->z[k];
        h->candidate[kept] = h->candidate[k];
        original[kept] = original[k];
        h->slope[kept] = h->slope[k] * weight;
        value += h->value[k] * weight;
        kept += weight != 0;
    }
    h->count = kept;
    h->padded = (kept + SB_HIT_LANES - 1) / SB_HIT_LANES * SB_HIT_LANES;
    for (size_t k = kept; k < h->padded; k++) {
        h->candidate[k] = pad;
        h->slope[k] = 0;
    }
    return value;
}

/* A vector at an image, reflected back to its original. */
static sb_f4 reflect_back(const sb_near *near, uint32_t path, sb_f4 v)
{
    for (int n = SB_REFLECTIONS_MAX; n-- > 0;) {
        const uint32_t plane = path >> (SB_REFLECTION_BITS * n) & SB_REFLECTION_MASK;
        if (plane) v = sb_reflect_vector(near->facet[plane - 1].plane, v);
    }
    return v;
}

/* Where the particle's own images by one reflection are. */
SB_INLINE void reflect_self(sb_searcher *w, sb_f4 self)
{
    const sb_near *near = &w->images.near;
    for (size_t a = 0; a < near->count; a++) w->own[a] = (sb_own_image){sb_reflect(near->facet[a].plane, self), 0, 0};
}

/* Adds a hit by several reflections. Returns the force on the original by the pressure of the particle. */
static sb_f4 several_reflections(const sb_sim *sim, const sb_searcher *w, uint32_t image, float fall, sb_f4 gradient,
                                 sb_reflections *r)
{
    const uint32_t path = w->images.path[image];
    if (fall != 0) r->push -= normal_part(&w->images.near, path, gradient * sb_splat(sb_hydrostatic(sim) * fall));
    return reflect_back(&w->images.near, path, -gradient);
}

/* Adds the hits of images. The forces on neighbours by the pressure of i are summed by neighbour. By one reflection at
   a plane with the normal n, at distances h before it, n . (x_i - x_image) is h_i + h_j, the image is 2 n_z h_j lower
   than its original, and the vector to x_i reflected back to the original is R x_i - x_j. */
SB_INLINE void reflected_sums(const sb_sim *sim, sb_searcher *w, sb_f4 self_place, sb_reflections *r)
{
    const sb_hits *h = &w->reflected;
    const sb_near *near = &w->images.near;
    const sb_f4 *place = w->vicinity.place;
    const float unit = sim->work.pairs.unit;
    const uint32_t self = (uint32_t)w->hits.count;
    sb_f4 sum = r->gradient, doubled = r->doubled;
    reflect_self(w, self_place);
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t image = h->candidate[k] - (uint32_t)w->vicinity.count, hit = w->original[k];
        const uint32_t source = w->images.source[image], path = w->images.path[image];
        const float slope = h->slope[k] * unit;
        const sb_f4 gradient = (self_place - place[h->candidate[k]]) * sb_splat(slope);
        sb_f4 force;
        sum += gradient;
        if (path <= SB_REFLECTION_MASK) {
            sb_own_image *own = &w->own[path - 1];
            const float above = w->images.above[image], part = slope * above;
            own->once += part;
            own->twice += part * above;
            force = (place[source] - own->place) * sb_splat(slope);
        } else
            force = several_reflections(sim, w, image, place[source][2] - place[h->candidate[k]][2], gradient, r);
        if (hit == self)
            doubled += gradient;
        else
            add_force(w, hit, force);
    }
    for (size_t a = 0; a < near->count; a++) {
        const sb_f4 plane = near->facet[a].plane;
        const float above = sb_before_facet(&near->facet[a], self_place);
        const float along = 2 * plane[2] * sb_hydrostatic(sim) * (above * w->own[a].once + w->own[a].twice);
        r->push -= plane * (sb_f4){along, along, along, 0};
    }
    r->gradient = sum;
    r->doubled = doubled;
}

/* The density that walls in motion push into the particle, by images. */
static float moving_flux(const sb_sim *sim, const sb_searcher *w, sb_f4 self)
{
    const sb_hits *h = &w->reflected;
    float flux = 0;
    for (size_t k = 0; k < h->count; k++) {
        const sb_f4 gradient = (self - w->vicinity.place[h->candidate[k]]) * sb_splat(h->slope[k]);
        const uint32_t path = w->images.path[h->candidate[k] - w->vicinity.count];
        flux += sb_sum3(gradient * image_velocity(&w->images.near, path));
    }
    return flux * sim->work.pairs.unit;
}

/* Notes the hits of particles, and the force on each by the pressure of the present particle. Lanes beyond the last hit
   have no force. */
SB_INLINE void note_direct(sb_searcher *w, float unit)
{
    const sb_hits *h = &w->hits;
    for (size_t k = 0; k < h->count; k++) w->hit_of[h->candidate[k]] = (uint32_t)k;
#pragma omp simd
    for (size_t k = 0; k < h->padded; k++) {
        const float slope = -unit * h->slope[k] * h->root[k];
        w->force_x[k] = slope * h->x[k];
        w->force_y[k] = slope * h->y[k];
        w->force_z[k] = slope * h->z[k];
    }
}

/* Sum of the squares of the forces on hits. */
SB_INLINE float square_forces(const sb_searcher *w)
{
    sb_f8 sum = {0};
    for (size_t k = 0; k < w->hits.padded; k += SB_HIT_LANES) {
        const sb_f8 x = *(const sb_f8 *)(w->force_x + k), y = *(const sb_f8 *)(w->force_y + k);
        const sb_f8 z = *(const sb_f8 *)(w->force_z + k);
        sum += x * x + y * y + z * z;
    }
    return sb_sum8(&sum);
}

/* Walls that hide nothing leave all weights at 1. */
static void weigh_direct(sb_hits *h)
{
    for (size_t k = 0; k < h->count; k++) {
        h->value[k] *= h->root[k];
        h->slope[k] *= h->root[k];
    }
}

SB_MULTIVERSION
sb_reflections sb_search_images(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, sb_f4 self,
                                uint32_t candidate)
{
    const sb_vicinity *v = &w->vicinity;
    const sb_candidate_range all = {(uint32_t)v->count, (uint32_t)(v->count + v->images)};
    sb_hits *h = &w->hits, *r = &w->reflected;
    sb_reflections sums = {0};
    w->edges = lists->edges;
    note_direct(w, sim->constant.mass * w->slope_scale);
    const size_t direct = w->images.slopes;
    sb_search_hits(w, r, &(sb_candidates){v->x, v->y, v->z, v->place}, &all, 1, self, UINT32_MAX, candidate);
    w->batch(w->kernel, r->q2, r->padded, r->value, r->slope);
    const bool own = find_originals(w, candidate);
    sb_images_weigh(sim, v, &w->images, self, r);
    if (own || w->images.slopes > 0) {
        clear_edges(w);
        add_edges(sim, w, lists, candidate, 0, direct, h, &sums);
        if (own) repel(sim, w, lists, candidate, &sums);
        add_edges(sim, w, lists, candidate, direct, w->images.slopes, r, &sums);
        close_edges(sim, w, lists, candidate, &sums);
    }
    sums.density = sim->constant.mass * w->value_scale * take_weights(w, candidate);
    if (r->count >= SB_LIST_MAX) w->full |= SB_FULL_LIST;
    sb_round_slopes(r->slope, r->root, r->padded, w->to_units);
    reflected_sums(sim, w, self, &sums);
    if (w->images.near.moves) sums.flux += moving_flux(sim, w, self);
    sums.squares = square_forces(w);
    if (!w->images.near.simple) weigh_direct(h);
    sb_images_number(v, &w->images, r);
    return sums;
}
