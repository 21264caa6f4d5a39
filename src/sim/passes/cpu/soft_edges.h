/* Edges at which the weights of paths are in transition, many at a time: those of one particle's paths by one
   reflection that have a single such edge, which are most. */
#ifndef SB_SIM_CPU_SOFT_EDGES_H
#define SB_SIM_CPU_SOFT_EDGES_H

#include "sim/passes/cpu/edges.h"

#include <stddef.h>

enum { SB_SOFT_EDGES_MAX = 256, SB_SOFT_EDGES_SPARE = 16 };

/* By edge: the hit, and the positions of both ends about the edge; and the weight with its derivatives by (o, h) of
   either end in 1/quanta. */
typedef struct sb_soft_edges {
    size_t count;
    uint32_t hit[SB_SOFT_EDGES_MAX], facet[SB_SOFT_EDGES_MAX], edge[SB_SOFT_EDGES_MAX];
    float own_c[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE], own_s[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE];
    float own_rho[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE], other_c[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE];
    float other_s[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE], other_rho[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE];
    float value[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE];
    float own_o[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE], own_h[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE];
    float other_o[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE], other_h[SB_SOFT_EDGES_MAX + SB_SOFT_EDGES_SPARE];
} sb_soft_edges;

/* Notes an edge. Returns false if there is no more room. */
SB_INLINE bool sb_soft_edges_add(sb_soft_edges *of, size_t hit, size_t facet, uint32_t edge, sb_half_angle own,
                                 sb_half_angle other)
{
    const size_t n = of->count;
    if (n == SB_SOFT_EDGES_MAX) return false;
    of->hit[n] = (uint32_t)hit, of->facet[n] = (uint32_t)facet, of->edge[n] = edge;
    of->own_c[n] = own.c, of->own_s[n] = own.s, of->own_rho[n] = own.rho;
    of->other_c[n] = other.c, of->other_s[n] = other.s, of->other_rho[n] = other.rho;
    of->count++;
    return true;
}

/* Computes weights and derivatives of paths that are reflected on the inner side of an edge, in the transition. */
void sb_soft_edges_weigh(sb_soft_edges *of, float transition);

#endif
