/* Positions relative to facets and their edges. */
#ifndef SB_SIM_CPU_EDGES_H
#define SB_SIM_CPU_EDGES_H

#include "sim/walls/mirrors.h"

#include <math.h>

/* Width of the transition at an edge, in spacings: a narrower one is a step to a particle that passes, in which
   pressure holds it (docs/decisions/0101). */
static const float SB_TRANSITION = 0.7f;

/* In widths: where the transition has ended. */
static const float SB_TRANSITION_ENDS = 3.5f;

/* In widths: how far from an edge a place in which a path meets a facet has all or nothing of it, where facets face
 * each other. */
static const float SB_SHARE_ENDS = 3;

/* Distance before a facet's plane, within the line of one of its edges; quanta. */
SB_INLINE float sb_before_facet(const sb_near_facet *f, sb_f4 at)
{
    return sb_sum3(f->plane * at) - f->plane[3];
}

SB_INLINE float sb_within_edge(const sb_near_edge *e, sb_f4 at)
{
    return sb_sum3(e->inward * at) - e->inward[3];
}

/* Whether two facets stand at right angles. */
SB_INLINE bool sb_facets_square(const sb_near *near, size_t a, size_t b)
{
    return fabsf(sb_sum3(near->facet[a].plane * near->facet[b].plane)) < SB_FACETS_SQUARE;
}

/* Whether facet k of a path stands at right angles to all others. of: indices of the path's facets. */
SB_INLINE bool sb_square_to_others(const sb_near *near, const size_t *of, int count, int k)
{
    bool square = true;
    for (int m = 0; m < count; m++) square &= m == k || sb_facets_square(near, of[k], of[m]);
    return square;
}

/* 1 - erf(size), size >= 0, with e = exp(-size^2); |error| < 2e-7 [Abramowitz and Stegun 1964, 7.1.26]. */
SB_INLINE float sb_erf_tail(float size, float e)
{
    const float k = 1 / (1 + 0.3275911f * size);
    return k * (0.254829592f + k * (-0.284496736f + k * (1.421413741f + k * (-1.453152027f + k * 1.061405429f)))) * e;
}

/* Whether two facets meet at another than a right angle, and are not parallel. */
SB_INLINE bool sb_facets_crooked(const sb_near *near, size_t a, size_t b)
{
    const float sectors = near->sectors[a][b];
    return sectors > 0 && sectors != 2 && sectors < INFINITY;
}

/* A position about an edge: o along the edge's `inward` from its line, h from the plane, rho from the line. C + iS =
   sqrt(o + ih), on the two sheets of a half plane. */
typedef struct sb_half_angle {
    float c, s, rho;
} sb_half_angle;

SB_INLINE sb_half_angle sb_half_angle_of(float o, float h)
{
    const float rho = sqrtf(o * o + h * h);
    const float c2 = 0.5f * (rho + o), s2 = 0.5f * (rho - o);
    const float c = c2 > 0 ? sqrtf(c2) : 0, s = s2 > 0 ? sqrtf(s2) : 0;
    return (sb_half_angle){h < 0 ? -c : c, s, rho};
}

#endif
