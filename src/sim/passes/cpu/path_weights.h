/* Weights of paths: which part of a path by way of reflections the facets have, and which part other facets hide
   (docs/method.md, section 7). The weight of a path between i and j is the same seen from either end. */
#ifndef SB_SIM_CPU_PATH_WEIGHTS_H
#define SB_SIM_CPU_PATH_WEIGHTS_H

#include "sim/passes/cpu/images.h"
#include "sim/search/around.h"

/* Smaller weights are 0. */
static const float SB_WEIGHT_LEAST = 1e-4f;

enum { SB_SIDE_BITS = 64 }; /* facets whose sides are known as bits */

/* The positions about the edges of facet f of a particle at the distance `above` before it. Returns the edge that it is
   farthest beyond, or nearest to. */
uint32_t sb_about_edges(const sb_near *near, const sb_near_facet *f, sb_f4 at, float above, sb_half_angle *angle);

/* A weight and its derivatives by the two ends. */
typedef struct sb_weight {
    float value;
    sb_f4 own, other;
} sb_weight;

/* The particle from which paths begin. */
typedef struct sb_weigher {
    const sb_near *near;
    const sb_relations *relations;
    sb_f4 self;
    float transition, eps;
    sb_standing *at; /* of self */
} sb_weigher;

/* The other end of a path by one reflection at a facet, or by several at right angles to each other. */
typedef struct sb_other_end {
    float above;                /* before the facet */
    uint32_t edge;              /* that it is farthest beyond, or nearest to */
    const sb_half_angle *angle; /* about the facet's edges */
} sb_other_end;

/* Parts of the weight of a path by facet, and their product. */
typedef struct sb_weight_parts {
    size_t count, facet[2 * SB_REFLECTIONS_MAX + 1];
    sb_weight part[2 * SB_REFLECTIONS_MAX + 1];
    float value;
} sb_weight_parts;

/* Multiplies by the part that a facet has. */
SB_INLINE void sb_take_part(sb_weight_parts *all, size_t facet, sb_weight part)
{
    all->facet[all->count] = facet;
    all->part[all->count++] = part;
    all->value *= part.value;
}

/* Part of a reflection that facet a has of a path to the end `j`. meets: whether it passes the facet itself; it is
   cleared if not. */
sb_weight sb_at_facet(const sb_weigher *w, size_t a, sb_other_end j, bool *meets);

/* Part of the path from the particle to `source`, unfolded to a straight line to `image` by reflections at the `count`
   facets by[] at right angles, that no facet hides which has water on both sides and meets these facets. *by_facet: the
   facet that hides most, SIZE_MAX if none does. */
sb_weight sb_past_facets(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, size_t *by_facet);

/* What hides or blocks a path by reflections at right angles, after the parts of its facets. */
void sb_finish_path(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, bool meets,
                    sb_weight_parts *all);

/* Weight of a path by any facets. Facets that face each other are met one after the other; others in any order,
   with the share of sb_path_order_share. */
void sb_path_weight(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, sb_weight_parts *all);

#endif
