#include "sim/passes/cpu/cull.h"

#include "sim/passes/cpu/edges.h"
#include "sim/passes/cpu/eights.h"

/* Of what is compared with bounds, so that round-off does not remove a path: parts of a length, and of a support
   radius. */
static const float MARGIN = 1e-3f, NEARLY = 1e-5f;

/* Loops run over whole vectors. */
SB_INLINE size_t padded(const sb_sources *of)
{
    return (of->count + SB_SOURCE_LANES - 1) / SB_SOURCE_LANES * SB_SOURCE_LANES;
}

/* The range of n . x - d over the box. */
static void range_over(const sb_cull *cull, sb_f4 n, float range[2])
{
    range[0] = range[1] = -n[3];
    for (int axis = 0; axis < 3; axis++) {
        range[n[axis] < 0] += n[axis] * cull->box.low[axis];
        range[n[axis] >= 0] += n[axis] * cull->box.high[axis];
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
    cull->share_ends = (1 + MARGIN) * SB_SHARE_ENDS * SB_TRANSITION * sim->constant.spacing / quantum;
    for (int axis = 0; axis < 3; axis++) cull->box.low[axis] = low[axis], cull->box.high[axis] = high[axis];
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
    const size_t n = padded(of);
    const float end = cull->end, eps = cull->eps;
    const int32_t one_side = f->both ? 0 : -1, behind = cull->behind[facet] ? -1 : 0;
    int32_t *beyond = of->beyond[facet], *whole = of->whole[facet];
    const float *above = of->above;
    float nearest[SB_SOURCES_MAX], round[SB_SOURCES_MAX], any[SB_SOURCES_MAX];
    for (size_t s = 0; s < n; s++) nearest[s] = any[s] = INFINITY, round[s] = 0;
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        const sb_f4 in = near->edges[k].inward;
        const sb_edge_bounds b = cull->edge[k];
        for (size_t from = 0; from < n; from += SB_SOURCE_LANES)
#pragma omp simd
            for (size_t s = from; s < from + SB_SOURCE_LANES; s++) {
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
    for (size_t from = 0; from < n; from += SB_SOURCE_LANES)
#pragma omp simd
        for (size_t s = from; s < from + SB_SOURCE_LANES; s++) {
            const int32_t hidden = -(above[s] < -eps), open = -(above[s] > eps);
            /* One end behind the facet: the path goes round the edge that this end is nearest to. */
            beyond[s] |= one_side & ((hidden & (behind | -(round[s] > end))) | (open & behind & -(any[s] > end)));
        }
}

SB_INLINE sb_f8 larger(sb_f8 a, sb_f8 b)
{
    return sb_select8(a > b, a, b);
}

SB_INLINE sb_f8 outside(float low, float high, sb_f8 x)
{
    return larger(larger(sb_splat8(low) - x, x - sb_splat8(high)), (sb_f8){0});
}

/* Squared distances from the box. */
SB_INLINE sb_f8 from_box2(const sb_box *box, sb_f8 x, sb_f8 y, sb_f8 z)
{
    const sb_f8 dx = outside(box->low[0], box->high[0], x), dy = outside(box->low[1], box->high[1], y);
    const sb_f8 dz = outside(box->low[2], box->high[2], z);
    return dx * dx + dy * dy + dz * dz;
}

SB_INLINE sb_f8 eight_of(const float *at)
{
    return *(const sb_f8 *)at;
}

/* Returns whether any source is near the group. */
SB_MULTIVERSION
static bool find_near(const sb_cull *cull, sb_sources *of)
{
    const sb_f8 support2 = sb_splat8(cull->support * cull->support);
    const sb_i8 lanes = {0, 1, 2, 3, 4, 5, 6, 7};
    sb_i8 any = {0};
    for (size_t s = 0; s < padded(of); s += SB_SOURCE_LANES) {
        const sb_f8 far2 = from_box2(&cull->box, eight_of(of->x + s), eight_of(of->y + s), eight_of(of->z + s));
        const sb_i8 near = (far2 < support2) & (lanes < (int32_t)(of->count - s));
        *(sb_i8 *)(of->near + s) = near;
        any |= near;
    }
    int32_t all = 0;
    for (int lane = 0; lane < SB_SOURCE_LANES; lane++) all |= any[lane];
    return all != 0;
}

/* Keeps the range of distances of sources near the group. */
SB_INLINE void widen(sb_sources *of, size_t facet, sb_f8 lowest, sb_f8 highest)
{
    for (int lane = 0; lane < SB_SOURCE_LANES; lane++) {
        if (lowest[lane] < of->lowest[facet]) of->lowest[facet] = lowest[lane];
        if (highest[lane] > of->highest[facet]) of->highest[facet] = highest[lane];
    }
}

/* Returns whether any image by the facet is near the group. */
SB_MULTIVERSION
static bool at_facet(const sb_near_facet *f, const sb_cull *cull, size_t facet, sb_sources *of)
{
    const sb_f4 plane = f->plane;
    const sb_f8 nx = sb_splat8(plane[0]), ny = sb_splat8(plane[1]), nz = sb_splat8(plane[2]);
    const float reach = (1 + MARGIN) * cull->support;
    const sb_f8 most = sb_splat8(reach), most2 = most * most;
    const sb_f8 least = sb_splat8(f->edges > 0 || f->both ? -reach : -cull->eps);
    const sb_f8 infinite = sb_splat8(INFINITY);
    sb_f8 lowest = infinite, highest = -infinite;
    sb_i8 all_apart = ~(sb_i8){0};
    for (size_t s = 0; s < padded(of); s += SB_SOURCE_LANES) {
        const sb_f8 x = eight_of(of->x + s), y = eight_of(of->y + s), z = eight_of(of->z + s);
        const sb_f8 h = nx * x + ny * y + nz * z - sb_splat8(plane[3]), twice = h + h;
        const sb_f8 far2 = from_box2(&cull->box, x - twice * nx, y - twice * ny, z - twice * nz);
        const sb_i8 near = *(sb_i8 *)(of->near + s);
        *(sb_f8 *)(of->above + s) = h;
        const sb_i8 apart = (far2 > most2) | (h < least) | (h > most) | ~near;
        *(sb_i8 *)(of->apart[facet] + s) = apart;
        all_apart &= apart;
        *(sb_i8 *)(of->beyond[facet] + s) = (sb_i8){0};
        *(sb_i8 *)(of->whole[facet] + s) = h > (sb_f8){0};
        lowest = -larger(-lowest, -sb_select8(near, h, infinite));
        highest = larger(highest, sb_select8(near, h, -infinite));
    }
    widen(of, facet, lowest, highest);
    int32_t all = -1;
    for (int lane = 0; lane < SB_SOURCE_LANES; lane++) all &= all_apart[lane];
    return all == 0;
}

static void find_open(const sb_near *near, sb_sources *of)
{
    for (size_t s = 0; s < of->count; s++) of->open[s] = (sb_facet_set){0};
    for (size_t a = 0; a < near->count; a++)
        for (size_t s = 0; s < of->count; s++) sb_facet_set_put(&of->open[s], a, !of->beyond[a][s]);
}

bool sb_cull_sources(const sb_near *near, const sb_cull *cull, sb_sources *of)
{
    if (!find_near(cull, of)) return false;
    bool any = false;
    /* A facet whose own images are not near can still be part of a path whose image is, at crooked corners. */
    for (size_t a = 0; a < near->count; a++) {
        of->any[a] = at_facet(&near->facet[a], cull, a, of);
        if ((of->any[a] || near->skew) && near->facet[a].edges > 0) at_edges(near, cull, a, of);
        any |= of->any[a];
    }
    if (any && near->meeting) find_open(near, of);
    return any;
}

/* ---- paths by several reflections ---- */

/* Planes that a path meets, seen from its end, before the facet in question. */
typedef struct sb_met {
    const sb_near *near;
    size_t of[SB_REFLECTIONS_MAX];
    int first, count; /* of[first] to of[count - 1] */
} sb_met;

/* The range over the box of n . x - d at the box reflected by these planes. */
static void reflected_range(const sb_cull *cull, const sb_met *met, sb_f4 n, float range[2])
{
    for (int m = met->first; m < met->count; m++) {
        const sb_f4 plane = met->near->facet[met->of[m]].plane;
        n -= plane * sb_splat(2 * sb_sum3(n * plane));
    }
    range_over(cull, n, range);
}

/* Whether straight lines from places of the reflected box to `image` may cross a facet, or pass it within the
   transition beyond its edges. The distance of the crossing within an edge lies between those of both ends. It grows
   with that of the place, and as the place's distance from the plane grows it only rises or only falls. */
static bool crosses(const sb_cull *cull, const sb_met *met, const sb_near_facet *f, sb_f4 image)
{
    float h[2];
    const float behind = sb_before_facet(f, image);
    if (fabsf(behind) <= cull->eps) return true;
    reflected_range(cull, met, f->plane, h);
    const float least = behind < 0 ? fmaxf(h[0], 0) : fmaxf(-h[1], 0), most = behind < 0 ? h[1] : -h[0];
    if (most <= 0) return false;
    const float first = least / (least + fabsf(behind)), last = most / (most + fabsf(behind));
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        float o[2];
        const sb_near_edge *e = &met->near->edges[k];
        reflected_range(cull, met, e->inward, o);
        const float turn = sb_within_edge(e, image) + cull->eps - o[1];
        const float within = fmaxf(o[1] + first * turn, o[1] + last * turn);
        if (within < (e->bend == SB_BEND_CONCAVE ? 0 : -cull->share_ends)) return false;
    }
    return true;
}

bool sb_cull_meets(const sb_near *near, const sb_cull *cull, uint32_t path, sb_f4 image)
{
    size_t of[SB_REFLECTIONS_MAX];
    int count = 0;
    for (; path; path >>= SB_REFLECTION_BITS) of[count++] = (path & SB_REFLECTION_MASK) - 1;
    sb_met met = {.near = near};
    for (int k = 0; k < count; k++) {
        if (!sb_square_to_others(near, of, count, k)) met.of[met.count++] = of[k];
    }
    for (met.first = met.count; met.first > 0;) {
        const sb_near_facet *f = &near->facet[met.of[met.first - 1]];
        if (!crosses(cull, &met, f, image)) return false;
        image = sb_reflect(f->plane, image);
        met.first--;
    }
    return true;
}
