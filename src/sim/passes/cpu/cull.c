#include "sim/passes/cpu/cull.h"

#include "sim/passes/cpu/path_weights.h"

#include <math.h>

/* Of what is compared with bounds, so that round-off does not remove a path: parts of a length, and of a support
   radius. */
static const float MARGIN = 1e-3f, NEARLY = 1e-5f;

/* The range of n . x - d over the box. */
static void range_over(const sb_cull *cull, sb_f4 n, float range[2])
{
    range[0] = range[1] = -n[3];
    for (int axis = 0; axis < 3; axis++) {
        range[n[axis] < 0] += n[axis] * cull->low[axis];
        range[n[axis] >= 0] += n[axis] * cull->high[axis];
    }
    range[0] -= cull->eps;
    range[1] += cull->eps;
}

void sb_cull_begin(const sb_sim *sim, const sb_near *near, sb_f4 low, sb_f4 high, sb_cull *cull)
{
    const float quantum = (float)sim->space.quantum;
    cull->support = sim->constant.support / quantum;
    cull->eps = NEARLY * cull->support;
    cull->end = (1 + MARGIN) * 0.5f * SB_TRANSITION_ENDS * SB_TRANSITION * sim->constant.spacing / quantum;
    for (int axis = 0; axis < 3; axis++) cull->low[axis] = low[axis], cull->high[axis] = high[axis];
    for (size_t a = 0; a < near->count; a++) {
        const sb_near_facet *f = &near->facet[a];
        float h[2];
        range_over(cull, f->plane, h);
        cull->behind[a] = h[1] < 0;
        const float least = h[0] > 0 ? h[0] : h[1] < 0 ? -h[1] : 0, most = fmaxf(fabsf(h[0]), fabsf(h[1]));
        for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
            float o[2];
            range_over(cull, near->edges[k].inward, o);
            const sb_half_angle inner = sb_half_angle_of(o[1], least), far = sb_half_angle_of(o[1], most);
            cull->edge[k] = (sb_edge_bounds){.c_near = inner.c,
                                             .s_near = inner.s,
                                             .c_far = far.c,
                                             .s_far = far.s,
                                             .c_least = sb_half_angle_of(o[0], least).c,
                                             .s_most = sb_half_angle_of(o[0], most).s,
                                             .s_least = inner.s};
        }
    }
}

/* A path by a facet has at each edge t <= 2 (|C_i| |C_j| - S_i S_j): equality holds unless it goes round this edge,
   where t = -2 (|C_i| |C_j| + S_i S_j). The first grows with o_i and, as |h_i| grows, falls and then rises. */
SB_MULTIVERSION
static void at_edges(const sb_near *near, const sb_cull *cull, size_t facet, sb_sources *of)
{
    const sb_near_facet *f = &near->facet[facet];
    const size_t n = (of->count + 15) / 16 * 16;
    const float end = cull->end, eps = cull->eps;
    const int32_t one_side = f->both ? 0 : -1, behind = cull->behind[facet] ? -1 : 0;
    int32_t *beyond = of->beyond[facet], *whole = of->whole[facet];
    const float *above = of->above[facet];
    float nearest[SB_SOURCES_MAX], round[SB_SOURCES_MAX], any[SB_SOURCES_MAX];
    for (size_t s = 0; s < n; s++) nearest[s] = any[s] = INFINITY, round[s] = 0;
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        const sb_f4 in = near->edges[k].inward;
        const sb_edge_bounds b = cull->edge[k];
#pragma omp simd
        for (size_t s = 0; s < n; s++) {
            const float o = in[0] * of->x[s] + in[1] * of->y[s] + in[2] * of->z[s] - in[3];
            const float rho = sqrtf(o * o + above[s] * above[s]);
            const float c2 = 0.5f * (rho + o), s2 = 0.5f * (rho - o);
            const float c = sqrtf(c2 > 0 ? c2 : 0), sine = sqrtf(s2 > 0 ? s2 : 0);
            const float first = c * b.c_near - sine * b.s_near, last = c * b.c_far - sine * b.s_far;
            const float turn = c * b.c_least + sine * b.s_least;
            beyond[s] |= -((first > last ? first : last) < -end);
            whole[s] &= -(c * b.c_least - sine * b.s_most > end);
            round[s] = o < nearest[s] ? turn : round[s];
            nearest[s] = o < nearest[s] ? o : nearest[s];
            any[s] = turn < any[s] ? turn : any[s];
        }
    }
#pragma omp simd
    for (size_t s = 0; s < n; s++) {
        const int32_t hidden = -(above[s] < -eps), open = -(above[s] > eps);
        /* One end behind the facet: the path goes round the edge that this end is nearest to. */
        beyond[s] |= one_side & ((hidden & (behind | -(round[s] > end))) | (open & behind & -(any[s] > end)));
    }
}

SB_MULTIVERSION
static void at_facet(const sb_near_facet *f, const sb_cull *cull, size_t facet, sb_sources *of)
{
    const size_t n = (of->count + 15) / 16 * 16;
    const sb_f4 plane = f->plane;
    const float support = cull->support, support2 = (1 + MARGIN) * support * support;
    const float x0 = cull->low[0], y0 = cull->low[1], z0 = cull->low[2];
    const float x1 = cull->high[0], y1 = cull->high[1], z1 = cull->high[2];
    const float least = f->edges > 0 || f->both ? -INFINITY : -cull->eps;
    int32_t *apart = of->apart[facet], *beyond = of->beyond[facet], *whole = of->whole[facet];
    float *above = of->above[facet];
#pragma omp simd
    for (size_t s = 0; s < n; s++) {
        const float h = plane[0] * of->x[s] + plane[1] * of->y[s] + plane[2] * of->z[s] - plane[3];
        const float x = of->x[s] - 2 * h * plane[0], y = of->y[s] - 2 * h * plane[1], z = of->z[s] - 2 * h * plane[2];
        const float dx = x < x0 ? x0 - x : x > x1 ? x - x1 : 0, dy = y < y0 ? y0 - y : y > y1 ? y - y1 : 0;
        const float dz = z < z0 ? z0 - z : z > z1 ? z - z1 : 0;
        above[s] = h;
        apart[s] = -(dx * dx + dy * dy + dz * dz > support2) | -(h < least);
        beyond[s] = 0;
        whole[s] = -(h > 0);
    }
}

void sb_cull_sources(const sb_near *near, const sb_cull *cull, sb_sources *of)
{
    for (size_t s = of->count; s % 16 != 0; s++) {
        of->x[s] = of->x[0];
        of->y[s] = of->y[0];
        of->z[s] = of->z[0];
    }
    for (size_t a = 0; a < near->count; a++) {
        at_facet(&near->facet[a], cull, a, of);
        if (near->facet[a].edges > 0) at_edges(near, cull, a, of);
    }
}
