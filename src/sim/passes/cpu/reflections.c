/* The pairs of a particle with images. */
#include "sim/passes/cpu/search_parts.h"

#include <math.h>

/* Finds the hits of the originals, and gives the weight 0 to images whose originals are not within the support radius:
   paths round an edge, with one end behind the facet, can be shorter than the straight line. The particle itself counts
   as the hit after the last. Notes its own images. */
SB_INLINE void find_originals(sb_searcher *w, uint32_t self)
{
    sb_hits *h = &w->reflected;
    const uint32_t count = (uint32_t)w->hits.count, records = (uint32_t)w->vicinity.count;
    const uint32_t *source = w->images.source, *hit_of = w->hit_of, *candidate = w->hits.candidate;
    uint32_t *original = w->original;
    size_t own = 0;
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t from = source[h->candidate[k] - records], noted = hit_of[from];
        const uint32_t hit = noted < count ? noted : 0;
        const bool is_own = from == self;
        original[k] = is_own ? count : hit;
        h->root[k] = is_own || (noted < count && candidate[hit] == from) ? 1 : 0;
        w->own_image[own] = (uint32_t)k;
        own += is_own;
    }
    w->own_images = own;
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
    for (size_t a = 0; a < near->count; a++) w->own[a] = sb_reflect(near->facet[a].plane, self);
}

/* Adds the hits of images. The forces on neighbours by the pressure of i are summed by neighbour. By one reflection R,
   the vector to x_i reflected back to the original is R x_i - x_j. */
SB_INLINE void reflected_sums(const sb_sim *sim, sb_searcher *w, sb_f4 self_place, sb_reflections *r)
{
    const sb_hits *h = &w->reflected;
    const sb_near *near = &w->images.near;
    const sb_f4 *place = w->vicinity.place;
    const float unit = sim->work.pairs.unit;
    const uint32_t self = (uint32_t)w->hits.count;
    sb_f4 sum = r->gradient, doubled = r->doubled, push = {0};
    reflect_self(w, self_place);
    for (size_t k = 0; k < h->count; k++) {
        const uint32_t image = h->candidate[k] - (uint32_t)w->vicinity.count, hit = w->original[k];
        const uint32_t source = w->images.source[image], path = w->images.path[image];
        const float slope = h->slope[k] * unit;
        const sb_f4 gradient = (self_place - place[h->candidate[k]]) * sb_splat(slope);
        const sb_f4 force = path <= SB_REFLECTION_MASK ? (place[source] - w->own[path - 1]) * sb_splat(slope)
                                                       : reflect_back(near, path, -gradient);
        sum += gradient;
        push += gradient * sb_splat(place[source][2] - place[h->candidate[k]][2]);
        if (hit == self)
            doubled += gradient;
        else
            sb_add_force(w, hit, force);
    }
    r->push -= push * sb_splat(sb_hydrostatic(sim));
    r->gradient = sum;
    r->doubled = doubled;
}

/* The density that walls in motion push into the particle, by images. */
SB_APART float moving_flux(const sb_sim *sim, const sb_searcher *w, sb_f4 self)
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
    find_originals(w, candidate);
    sb_images_weigh(sim, v, &w->images, self, r);
    if (w->own_images > 0 || w->images.slopes > 0) sb_search_edges(sim, w, lists, candidate, direct, &sums);
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
