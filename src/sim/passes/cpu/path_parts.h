/* Parts of paths: which part of a reflection a facet has, by where both ends are about its edges (docs/method.md,
   section 7). The part is the same seen from either end. */
#ifndef SB_SIM_CPU_PATH_PARTS_H
#define SB_SIM_CPU_PATH_PARTS_H

#include "sim/passes/cpu/images.h"
#include "sim/search/around.h"

/* Smaller weights are 0. */
static const float SB_WEIGHT_LEAST = 1e-4f;

enum { SB_SIDE_BITS = 64 }; /* facets whose sides are known as bits */

/* A weight and its derivatives by the two ends. */
typedef struct sb_weight {
    float value;
    sb_f4 own, other;
} sb_weight;

/* Multiplies a weight by that of one edge or facet. */
SB_INLINE void sb_multiply_weight(sb_weight *w, float value, sb_f4 own, sb_f4 other)
{
    w->own = w->own * sb_splat(value) + own * sb_splat(w->value);
    w->other = w->other * sb_splat(value) + other * sb_splat(w->value);
    w->value *= value;
}

/* The particle from which paths begin. */
typedef struct sb_weigher {
    const sb_near *near;
    const sb_relations *relations;
    sb_f4 self;
    float transition, eps;
    sb_standing *at; /* of self */
} sb_weigher;

/* The positions about the edges of facet f of a particle at the distance `above` before it. Returns the edge that it is
   farthest beyond, or nearest to. */
uint32_t sb_about_edges(const sb_near *near, const sb_near_facet *f, sb_f4 at, float above, sb_half_angle *angle);

/* Part of a path that passes an edge, as in the diffraction by a half plane [Sommerfeld 1896]: sign -1 for a path that
   is reflected on the edge's inner side, +1 for one that goes straight past its outer side. di, dj: its derivatives by
   (o, h) of either end. *before: the path passes the facet itself. */
float sb_past_edge(sb_half_angle i, sb_half_angle j, float sign, float transition, float di[2], float dj[2],
                   bool *before);

/* The other end of a path by one reflection at a facet, or by several at right angles to each other. */
typedef struct sb_other_end {
    float above;                /* before the facet */
    uint32_t edge;              /* that it is farthest beyond, or nearest to */
    const sb_half_angle *angle; /* about the facet's edges */
} sb_other_end;

/* Part of a reflection that facet a has of a path to the end `j`. meets: whether it passes the facet itself; it is
   cleared if not. */
sb_weight sb_at_facet(const sb_weigher *w, size_t a, sb_other_end j, bool *meets);

#endif
