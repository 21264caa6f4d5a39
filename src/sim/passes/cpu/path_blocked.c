#include "sim/passes/cpu/path_blocked.h"

static bool inside(const sb_near *near, const sb_near_facet *f, sb_f4 at)
{
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++)
        if (sb_within_edge(&near->edges[k], at) < 0) return false;
    return true;
}

bool sb_way_blocked(const sb_weigher *w, sb_f4 a, sb_f4 b, size_t skip, size_t other)
{
    for (size_t k = 0; k < w->near->count; k++) {
        if (k == skip || k == other) continue;
        const sb_near_facet *f = &w->near->facet[k];
        const float s = sb_before_facet(f, a), t = sb_before_facet(f, b);
        if (!((s > w->eps && t < -w->eps) || (s < -w->eps && t > w->eps))) continue;
        if (inside(w->near, f, a + (b - a) * sb_splat(s / (s - t)))) return true;
    }
    return false;
}

/* Cosine between normals from which on facets are parallel. */
static const float PARALLEL = 0.9999f;

/* The way of a path by reflection at facet a. */
typedef struct bounce {
    sb_f4 from, at, to; /* at: where it meets the facet's plane */
    bool beyond;        /* beyond an edge at which the surface bends little */
} bounce;

static bounce bounce_of(const sb_weigher *w, size_t a, sb_f4 source, sb_f4 image)
{
    const sb_near_facet *f = &w->near->facet[a];
    const float hi = sb_before_facet(f, w->self), hj = sb_before_facet(f, source);
    bounce way = {.from = w->self, .at = w->self + (image - w->self) * sb_splat(hi / (hi + hj)), .to = source};
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        const sb_near_edge *e = &w->near->edges[k];
        way.beyond |= (e->bend == SB_BEND_SOFT || e->bend == SB_BEND_HOLLOW) && sb_within_edge(e, way.at) < 0;
    }
    return way;
}

/* Whether facet k does not block a path by facet a with both ends before k: the two meet in a corner that has all of
   this path, or k continues the surface at a beyond the edge where its share of the path ends. */
static bool lets_pass(const sb_weigher *w, size_t a, size_t k, const bounce *way)
{
    const sb_near_facet *g = &w->near->facet[k];
    if (!(sb_before_facet(g, way->from) > 0 && sb_before_facet(g, way->to) > 0)) return false;
    const float along = sb_sum3(w->near->facet[a].plane * g->plane);
    return sb_facets_crooked(w->near, a, k) || (way->beyond && along > SB_BENT && along < PARALLEL);
}

/* Whether a facet that reflections at facet a do not leave where it is blocks one of the two legs of a path. */
SB_APART bool leg_blocked(const sb_weigher *w, size_t a, const bounce *way, sb_f4 from, sb_f4 to)
{
    for (size_t n = 0; 64 * n < w->near->count; n++)
        for (uint64_t facets = w->relations->block[a].word[n]; facets; facets &= facets - 1) {
            const size_t k = 64 * n + (size_t)__builtin_ctzll(facets);
            const sb_near_facet *g = &w->near->facet[k];
            const float s = sb_before_facet(g, from), t = sb_before_facet(g, to);
            if (!((s > w->eps && t < -w->eps) || (s < -w->eps && t > w->eps))) continue;
            if (inside(w->near, g, from + (to - from) * sb_splat(s / (s - t))) && !lets_pass(w, a, k, way)) return true;
        }
    return false;
}

bool sb_bounce_blocked(const sb_weigher *w, size_t a, sb_f4 source, sb_f4 image)
{
    const bounce way = bounce_of(w, a, source, image);
    return leg_blocked(w, a, &way, way.from, way.at) || leg_blocked(w, a, &way, way.at, way.to);
}
