/* Which reflections of a record at single facets can have weight for a particle of a group: most have none, because the
   path would pass beyond the facet's edges (sim/passes/cpu/path_weights.h). The bounds hold for the box of the group's
   particles. */
#ifndef SB_SIM_CPU_CULL_H
#define SB_SIM_CPU_CULL_H

#include "sim/walls/mirrors.h"

enum { SB_SOURCES_MAX = 64, SB_SOURCE_LANES = 8 };

/* |C| and S of sb_half_angle over the box, by edge. */
typedef struct sb_edge_bounds {
    float c_near, s_near, c_far, s_far; /* where the box reaches farthest within the edge: least and most |h| */
    float c_least, s_most;              /* where it reaches least far within */
    float s_least;
} sb_edge_bounds;

typedef struct sb_box {
    float low[3], high[3];
} sb_box;

/* The box of a group's particles; lengths in quanta from its corner. */
typedef struct sb_cull {
    sb_box box;
    float support, end, eps;  /* end: |C C - S S| at which a transition ends */
    float share_ends;         /* how far beyond an edge a place still has a share of an ordered reflection */
    bool behind[SB_NEAR_MAX]; /* no particle is before the facet */
    sb_edge_bounds edge[SB_NEAR_EDGES_MAX];
} sb_cull;

/* Facets near a group, by number: facet a is bit a % 64 of word[a / 64]. */
enum { SB_FACET_WORDS = (SB_NEAR_MAX + 63) / 64 };
typedef struct sb_facet_set {
    uint64_t word[SB_FACET_WORDS];
} sb_facet_set;

SB_INLINE bool sb_facet_set_has(const sb_facet_set *set, size_t a)
{
    return set->word[a / 64] >> a % 64 & 1;
}

SB_INLINE void sb_facet_set_put(sb_facet_set *set, size_t a, bool in)
{
    set->word[a / 64] |= (uint64_t)in << a % 64;
}

/* Consecutive records near a group. x, y, z: SB_HIT_SPARE entries beyond the last can be read. By facet: */
typedef struct sb_sources {
    size_t count;
    const float *x, *y, *z;
    bool any[SB_NEAR_MAX];                                    /* some image is near the group */
    _Alignas(32) int32_t near[SB_SOURCES_MAX];                /* within the support radius of the group's box */
    _Alignas(32) float above[SB_SOURCES_MAX];                 /* before the plane of the last facet */
    _Alignas(32) int32_t apart[SB_NEAR_MAX][SB_SOURCES_MAX];  /* the image is not near the group, or there is none */
    _Alignas(32) int32_t beyond[SB_NEAR_MAX][SB_SOURCES_MAX]; /* paths by this facet have no weight */
    _Alignas(32)
        int32_t whole[SB_NEAR_MAX][SB_SOURCES_MAX];  /* paths from particles before the facet have the weight 1 there */
    float lowest[SB_NEAR_MAX], highest[SB_NEAR_MAX]; /* distances before the plane of those near the group, so far */
    /* By source, where paths may be reflected several times: the facets by which its paths may have weight. */
    sb_facet_set open[SB_SOURCES_MAX];
} sb_sources;

void sb_cull_begin(const sb_sim *sim, const sb_near *near, sb_f4 low, sb_f4 high, sb_cull *cull);
/* Returns false if there is no image at all. */
bool sb_cull_sources(const sb_near *near, const sb_cull *cull, sb_sources *of);
/* Whether a path by several reflections, with this image of its source, may meet each facet that faces another one of
   the path: seen from some place in the box, within the transition beyond the facet's
   edges. */
bool sb_cull_meets(const sb_near *near, const sb_cull *cull, uint32_t path, sb_f4 image);

#endif
