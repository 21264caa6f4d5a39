#include "sim/passes/cpu/path_hidden.h"

static const sb_weight WHOLE = {.value = 1};

/* The place where a path by reflections at facets by[] at right angles to facet f meets its plane. at: the path's end,
   unfolded to a straight line; hi, hj: the distances of both ends before the plane. */
static sb_f4 meeting(const sb_weigher *w, const size_t *by, int count, sb_f4 at, float hi, float hj)
{
    sb_f4 place = w->self + (at - w->self) * sb_splat(hi / (hi - hj));
    for (int m = 0; m < count; m++) {
        const sb_near_facet *mirror = &w->near->facet[by[m]];
        if (sb_before_facet(mirror, place) * sb_before_facet(mirror, w->self) < 0)
            place = sb_reflect(mirror->plane, place);
    }
    return place;
}

/* The edge after the reflections of the set `images` of by[]. Returns false if one of them leaves it where it is. */
static bool reflect_edge(const sb_weigher *w, const size_t *by, int count, int images, const sb_near_edge *e,
                         sb_near_edge *out)
{
    *out = *e;
    for (int m = 0; m < count; m++) {
        const sb_f4 plane = w->near->facet[by[m]].plane;
        const float along = sb_sum3(plane * out->inward);
        if (!(images >> m & 1)) continue;
        if (fabsf(along) < 1e-3f) return false;
        out->inward -= plane * sb_splat(2 * along);
    }
    return true;
}

/* The ends of a path as an edge sees them, and how they move within it with the particle and its neighbour. */
typedef struct sb_ends {
    sb_f4 own, other, inward_own, inward_other;
} sb_ends;

/* Multiplies the hidden part of a path by that within one edge. hi, hj, normal: of the facet. */
static void past_edge_of(const sb_weigher *w, const sb_near_edge *e, const sb_ends *at, sb_f4 normal, float hi,
                         float hj, sb_weight *hidden)
{
    const sb_f4 keep = {1, 1, 1, 0};
    const float oi = sb_within_edge(e, at->own), oj = sb_within_edge(e, at->other);
    float di[2] = {0}, dj[2] = {0};
    bool before = true;
    const float past = e->bend == SB_BEND_CONVEX
                           ? sb_past_edge(sb_half_angle_of(oi, fabsf(hi)), sb_half_angle_of(oj, -fabsf(hj)), 1,
                                          w->transition, di, dj, &before)
                           : oi * fabsf(hj) + oj * fabsf(hi) < 0;
    sb_multiply_weight(hidden, 1 - past, -(at->inward_own * keep * sb_splat(di[0]) + normal * sb_splat(di[1])),
                       -(at->inward_other * keep * sb_splat(dj[0]) + normal * sb_splat(dj[1])));
}

/* Part of the path by reflections at facets by[] at right angles to facet f, unfolded to a straight line from the
   particle to `at`, that f does not hide. Unfolded, f and its images are one facet: it has the edges of f, their
   images, and no concave edge between them. */
static sb_weight past_facet(const sb_weigher *w, const size_t *by, int count, const sb_near_facet *f, sb_f4 at)
{
    const float hi = sb_before_facet(f, w->self), hj = sb_before_facet(f, at);
    if (hi * hj >= 0) return WHOLE;
    const sb_f4 normal = f->plane * (hi > 0 ? (sb_f4){1, 1, 1, 0} : (sb_f4){-1, -1, -1, 0});
    sb_weight hidden = WHOLE;
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        const sb_near_edge *e = &w->near->edges[k];
        if (e->bend == SB_BEND_CONCAVE) {
            if (sb_within_edge(e, meeting(w, by, count, at, hi, hj)) < 0) return WHOLE;
            continue;
        }
        for (int images = 0; images < 1 << count; images++) {
            sb_near_edge seen;
            if (!reflect_edge(w, by, count, images, e, &seen)) continue;
            past_edge_of(w, &seen, &(sb_ends){w->self, at, seen.inward, seen.inward}, normal, hi, hj, &hidden);
        }
    }
    for (int m = 0; m < count; m++) hidden.other = sb_reflect_vector(w->near->facet[by[m]].plane, hidden.other);
    return (sb_weight){1 - hidden.value, -hidden.own, -hidden.other};
}

/* The same of a path by one reflection at facet a, where f does not stand at a right angle to it: f and its image do
   not lie in one plane. Edges that a leaves about where they are hide the path as they hide the straight line. */
static sb_weight past_leaning(const sb_weigher *w, size_t a, const sb_near_facet *f, sb_f4 source)
{
    const sb_f4 plane = w->near->facet[a].plane;
    const float hi = sb_before_facet(f, w->self), hj = sb_before_facet(f, source);
    if (hi * hj >= 0) return WHOLE;
    const sb_f4 normal = f->plane * (hi > 0 ? (sb_f4){1, 1, 1, 0} : (sb_f4){-1, -1, -1, 0});
    sb_weight hidden = WHOLE;
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        const sb_near_edge *e = &w->near->edges[k];
        const float along = sb_sum3(plane * e->inward);
        if (e->bend == SB_BEND_CONCAVE) {
            const sb_f4 place = w->self + (source - w->self) * sb_splat(hi / (hi - hj));
            if (sb_within_edge(e, place) < 0) return WHOLE;
            continue;
        }
        const sb_ends straight = {w->self, source, e->inward, e->inward};
        if (fabsf(along) < SB_BENT) {
            past_edge_of(w, e, &straight, normal, hi, hj, &hidden);
            continue;
        }
        sb_near_edge turned = *e;
        turned.inward -= plane * sb_splat(2 * along);
        const sb_ends own = {w->self, sb_reflect(plane, source), e->inward, turned.inward};
        const sb_ends other = {sb_reflect(plane, w->self), source, turned.inward, e->inward};
        past_edge_of(w, e, &own, normal, hi, hj, &hidden);
        past_edge_of(w, e, &other, normal, hi, hj, &hidden);
    }
    return (sb_weight){1 - hidden.value, -hidden.own, -hidden.other};
}

/* Whether a facet meets one of a path's at another than a right angle. */
static bool leans_to(const sb_near *near, const size_t *by, int count, size_t k)
{
    bool leans = false;
    for (int m = 0; m < count; m++) leans |= sb_facets_crooked(near, by[m], k);
    return leans;
}

sb_weight sb_past_facets(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, size_t *by_facet)
{
    const bool crooked = sb_is_crooked(w->near, by, count);
    sb_weight least = WHOLE;
    *by_facet = SIZE_MAX;
    for (size_t n = 0; 64 * n < w->near->count; n++) {
        uint64_t hiders = w->relations->parts.word[n];
        for (int m = 0; m < count; m++) hiders &= w->relations->hide[by[m]].word[n];
        for (; hiders; hiders &= hiders - 1) {
            const size_t k = 64 * n + (size_t)__builtin_ctzll(hiders);
            const sb_near_facet *g = &w->near->facet[k];
            const sb_weight past = !crooked && !leans_to(w->near, by, count, k) ? past_facet(w, by, count, g, image)
                                   : count == 1                                 ? past_leaning(w, by[0], g, source)
                                                                                : past_facet(w, NULL, 0, g, source);
            if (past.value >= least.value) continue;
            least = past;
            *by_facet = k;
        }
    }
    return least;
}
