/* The neighbour search of one thread: what its files share. */
#ifndef SB_SIM_CPU_SEARCH_PARTS_H
#define SB_SIM_CPU_SEARCH_PARTS_H

#include "sim/passes/cpu/images.h"
#include "sim/passes/cpu/kernel_batch.h"
#include "sim/passes/cpu/searcher.h"
#include "sim/passes/cpu/wall_finder.h"

typedef struct sb_searcher {
    sb_vicinity vicinity;
    sb_hits hits, reflected;
    sb_images_around images;
    /* On each hit, by the pressure of the present particle; aligned like the hits. */
    float force_x[SB_HITS_MAX + SB_HIT_SPARE], force_y[SB_HITS_MAX + SB_HIT_SPARE], force_z[SB_HITS_MAX + SB_HIT_SPARE];
    uint32_t original[SB_HITS_MAX + SB_HIT_SPARE]; /* of each hit of images: the hit of the original */
    size_t own_images; /* hits of images of the particle itself, before weights: own_image[] */
    uint32_t own_image[SB_HITS_MAX + SB_HIT_SPARE];
    sb_f4 own[SB_NEAR_MAX];                                      /* its images by one reflection, by facet */
    size_t edges, edge_own, edge_of[SB_HITS_MAX + SB_HIT_SPARE]; /* pairs at edges of the present particle: the first,
                                                                    and those with itself and with each hit */
    uint32_t hit_of[SB_AROUND_MAX]; /* candidate -> its hit; valid where that hit is this candidate */
    const sb_kernel *kernel;
    sb_kernel_batch *batch;
    sb_find_hits *find_hits;
    float q_scale;     /* (quantum / h)^2 */
    float value_scale; /* alpha / h^d */
    float slope_scale; /* alpha quantum / h^(d+2): W'/r per quantum */
    float to_units;    /* a slope of the kernel in stored units */
    unsigned full;     /* limits that this group exceeded */
    sb_wall_search wall_search;
    sb_wall_finder walls;
} sb_searcher;

/* What images add to the sums of particle i. */
typedef struct sb_reflections {
    float density;           /* kg/m^3 */
    sb_f4 gradient, doubled; /* sum m grad W, and its part that has q_i twice */
    sb_f4 repulsion;         /* the part of the gradient by which own images repel */
    float flux;              /* by moving walls */
    sb_f4 push;              /* m/s^2, by the hydrostatic part of the pressure of images */
    float squares;           /* sum of |force on a neighbour by the pressure of i|^2 */
} sb_reflections;

/* Finds the hits of a particle. pad: the candidate that fills the last places. */
SB_INLINE void sb_search_hits(sb_searcher *w, sb_hits *h, const sb_candidates *of, const sb_candidate_range *range,
                              size_t ranges, sb_f4 self, uint32_t skip, uint32_t pad)
{
    size_t n = w->find_hits(of, range, ranges, h, self, w->q_scale, skip);
    if (n >= SB_HITS_MAX) w->full |= SB_FULL_LIST;
    h->count = n < SB_HITS_MAX ? n : SB_HITS_MAX;
    h->padded = (h->count + SB_HIT_LANES - 1) / SB_HIT_LANES * SB_HIT_LANES;
    for (size_t k = h->count; k < h->padded; k++) {
        h->x[k] = h->y[k] = h->z[k] = 0;
        h->q2[k] = 1;
        h->candidate[k] = pad;
    }
}

/* Rounds slopes of the kernel to storable roots, and replaces them by the squares of these roots, so that all uses of a
   pair have the same number. */
void sb_round_slopes(float *restrict slope, float *restrict root, size_t count, float to_units);

/* Adds to the force on a hit by the pressure of the present particle. */
SB_INLINE void sb_add_force(sb_searcher *w, uint32_t hit, sb_f4 force)
{
    w->force_x[hit] += force[0];
    w->force_y[hit] += force[1];
    w->force_z[hit] += force[2];
}

/* Appends the pairs at edges of a particle, and adds them and what repels it from its own images to its sums. direct:
   of images.slope, those of hits of particles, which come first. */
void sb_search_edges(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, size_t direct,
                     sb_reflections *r);

/* Finds the images around a particle, appends its pairs at edges and returns what images add to its sums. w->hits: its
   hits of particles, with their weights as roots and slopes unrounded; w->reflected receives those of images.
   candidate: its own. */
sb_reflections sb_search_images(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, sb_f4 self,
                                uint32_t candidate);

#endif
