#include "sim/passes/cpu/path_weights.h"
#include "sim/passes/cpu/path_orders.h"

SB_MULTIVERSION
uint32_t sb_about_edges(const sb_near *near, const sb_near_facet *f, sb_f4 at, float above, sb_half_angle *angle)
{
    uint32_t edge = f->edge;
    float least = INFINITY;
    for (uint32_t k = 0; k < f->edges; k++) {
        const float inside = sb_within_edge(&near->edges[f->edge + k], at);
        angle[k] = sb_half_angle_of(inside, above);
        if (inside >= least) continue;
        least = inside;
        edge = f->edge + k;
    }
    return edge;
}

/* exp(-t^2) = e */
static float error_function(float t, float e)
{
    const float tail = sb_erf_tail(fabsf(t), e);
    return t < 0 ? tail - 1 : 1 - tail;
}

/* Part of a path that passes an edge, as in the diffraction by a half plane [Sommerfeld 1896]: sign -1 for a path that
   is reflected on the edge's inner side, +1 for one that goes straight past its outer side. di, dj: its derivatives by
   (o, h) of either end. *before: the path passes the facet itself. */
SB_APART float past_edge(sb_half_angle i, sb_half_angle j, float sign, float transition, float di[2], float dj[2],
                         bool *before)
{
    const float t = 2 * (i.c * j.c + sign * i.s * j.s) / transition;
    di[0] = di[1] = dj[0] = dj[1] = 0;
    *before &= t >= 0;
    if (t > SB_TRANSITION_ENDS) return 1;
    if (t < -SB_TRANSITION_ENDS) return 0;
    const float e = expf(-t * t), slope = e / (1.7724539f * transition);
    const float to_i = slope / (i.rho + 1e-6f * transition), to_j = slope / (j.rho + 1e-6f * transition);
    di[0] = to_i * (i.c * j.c - sign * i.s * j.s);
    di[1] = to_i * (i.s * j.c + sign * i.c * j.s);
    dj[0] = to_j * (j.c * i.c - sign * j.s * i.s);
    dj[1] = to_j * (j.s * i.c + sign * j.c * i.s);
    return 0.5f + 0.5f * error_function(t, e);
}

static const sb_weight WHOLE = {.value = 1}, NONE = {.value = 0};

/* Multiplies a weight by that of one edge or facet. */
SB_INLINE void multiply(sb_weight *w, float value, sb_f4 own, sb_f4 other)
{
    w->own = w->own * sb_splat(value) + own * sb_splat(w->value);
    w->other = w->other * sb_splat(value) + other * sb_splat(w->value);
    w->value *= value;
}

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
                           ? past_edge(sb_half_angle_of(oi, fabsf(hi)), sb_half_angle_of(oj, -fabsf(hj)), 1,
                                       w->transition, di, dj, &before)
                           : oi * fabsf(hj) + oj * fabsf(hi) < 0;
    multiply(hidden, 1 - past, -(at->inward_own * keep * sb_splat(di[0]) + normal * sb_splat(di[1])),
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

static bool is_crooked(const sb_near *near, const size_t *by, int count)
{
    bool crooked = false;
    for (int k = 1; k < count; k++)
        for (int m = 0; m < k; m++) crooked |= sb_facets_crooked(near, by[k], by[m]);
    return crooked;
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
    const bool crooked = is_crooked(w->near, by, count);
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

static bool inside(const sb_near *near, const sb_near_facet *f, sb_f4 at)
{
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++)
        if (sb_within_edge(&near->edges[k], at) < 0) return false;
    return true;
}

/* Whether a facet other than the two given blocks the way from a to b. */
SB_APART bool blocked(const sb_weigher *w, sb_f4 a, sb_f4 b, size_t skip, size_t other)
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

SB_MULTIVERSION
sb_weight sb_at_facet(const sb_weigher *w, size_t a, sb_other_end j, bool *meets)
{
    const sb_near_facet *f = &w->near->facet[a];
    const float hi = w->at->above[a], hj = j.above;
    const bool front = f->both ? hi * hj > 0 : hi > 0 && hj > 0;
    if (!front && (f->edges == 0 || (hi < 0 && hj < 0))) return NONE;
    sb_weight all = WHOLE;
    *meets &= front;
    /* One end behind the plane: the path goes round the edge that this end is nearest to, and before the others. */
    const uint32_t round = hi * hj < 0 ? (hi < 0 ? w->at->edge[a] : j.edge) : UINT32_MAX;
    const sb_f4 normal = f->plane * (sb_f4){1, 1, 1, 0};
    for (uint32_t k = 0; k < f->edges && all.value >= SB_WEIGHT_LEAST; k++) {
        const bool before = round != UINT32_MAX && f->edge + k != round;
        const float ti = before && hi < 0 ? -1 : 1, tj = before && hj < 0 ? -1 : 1;
        sb_half_angle one = w->at->angle[f->edge + k], other = j.angle[k];
        one.c *= ti;
        other.c *= tj;
        if (w->near->edges[f->edge + k].bend == SB_BEND_CONCAVE) {
            if (f->edge + k == round || one.c * other.c < one.s * other.s) return NONE;
            continue;
        }
        float di[2], dj[2];
        const float value = past_edge(one, other, -1, w->transition, di, dj, meets);
        if (value == 1) continue;
        const sb_f4 inward = w->near->edges[f->edge + k].inward * (sb_f4){1, 1, 1, 0};
        multiply(&all, value, inward * sb_splat(di[0]) + normal * sb_splat(ti * di[1]),
                 inward * sb_splat(dj[0]) + normal * sb_splat(tj * dj[1]));
    }
    return all.value < SB_WEIGHT_LEAST ? NONE : all;
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

static bool bounce_blocked(const sb_weigher *w, size_t a, sb_f4 source, sb_f4 image)
{
    const bounce way = bounce_of(w, a, source, image);
    return leg_blocked(w, a, &way, way.from, way.at) || leg_blocked(w, a, &way, way.at, way.to);
}

void sb_finish_path(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, bool meets,
                    sb_weight_parts *all)
{
    if (w->near->simple || all->value < SB_WEIGHT_LEAST) return;
    size_t hider;
    const sb_weight past = sb_past_facets(w, by, count, source, image, &hider);
    if (hider != SIZE_MAX) sb_take_part(all, hider, past);
    if (all->value < SB_WEIGHT_LEAST || !meets || count > 1) return;
    if (bounce_blocked(w, by[0], source, image)) all->value = 0;
}

/* The part that facet a has of reflections between the particle and `source`. */
static sb_weight part_at(const sb_weigher *w, size_t a, sb_f4 source, bool *meets)
{
    const sb_near_facet *f = &w->near->facet[a];
    sb_half_angle angle[SB_NEAR_EDGES_MAX];
    const float above = sb_before_facet(f, source);
    const sb_other_end j = {above, sb_about_edges(w->near, f, source, above, angle), angle};
    return sb_at_facet(w, a, j, meets);
}

/* Reflections at facets at right angles to each other, in any order. */
SB_APART void reflected_squarely(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image,
                                 sb_weight_parts *all)
{
    bool meets = true;
    for (int k = 0; k < count && all->value >= SB_WEIGHT_LEAST; k++)
        sb_take_part(all, by[k], part_at(w, by[k], source, &meets));
    sb_finish_path(w, by, count, source, image, meets, all);
}

/* Reflections at facets of which some meet at other than right angles: each facet has the part that it has of single
   reflections, and the order has its share. */
SB_APART void reflected_crookedly(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_weight_parts *all)
{
    bool meets = true;
    sb_path_share share;
    for (int k = 0; k < count && all->value >= SB_WEIGHT_LEAST; k++) {
        bool met = false;
        for (int m = 0; m < k; m++) met |= by[m] == by[k];
        if (!met) sb_take_part(all, by[k], part_at(w, by[k], source, &meets));
    }
    if (all->value < SB_WEIGHT_LEAST) return;
    all->value *= sb_path_order_share(w->near, by, count, w->self, source, &share) ? share.value : 0;
    if (all->value < SB_WEIGHT_LEAST) return;
    for (int k = 0; k < share.facets; k++) {
        all->facet[all->count] = by[share.at[k]];
        all->part[all->count++] = (sb_weight){share.value, share.own[k], share.other[k]};
    }
    if (w->near->simple) return;
    size_t hider;
    const sb_weight past = sb_past_facets(w, by, count, source, source, &hider);
    if (hider != SIZE_MAX) sb_take_part(all, hider, past);
    for (int k = 0; k < count && meets && all->value >= SB_WEIGHT_LEAST; k++) {
        const sb_f4 image = sb_reflect(w->near->facet[by[k]].plane, source);
        if (bounce_blocked(w, by[k], source, image)) all->value = 0;
    }
}

/* Part of a reflection at `at` that the facet has. */
static float share_of(const sb_weigher *w, const sb_near_facet *f, sb_f4 at)
{
    float share = 1;
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        const float y = sb_within_edge(&w->near->edges[k], at) / w->transition;
        if (w->near->edges[k].bend == SB_BEND_CONCAVE && y < 0) return 0;
        if (w->near->edges[k].bend == SB_BEND_CONCAVE) continue;
        share *= y > SB_SHARE_ENDS ? 1 : y < -SB_SHARE_ENDS ? 0 : 0.5f + 0.5f * erff(y);
    }
    return share < SB_WEIGHT_LEAST ? 0 : share;
}

/* Several reflections. at[0]: the particle; at[k]: its image by the first k planes. */
SB_APART float reflected(const sb_weigher *w, const size_t *by, int count, const sb_f4 *at)
{
    sb_f4 here = w->self;
    float share = 1;
    size_t last = SIZE_MAX;
    for (int k = count; k >= 1; k--) {
        const sb_near_facet *f = &w->near->facet[by[k - 1]];
        const float s = sb_before_facet(f, here), t = sb_before_facet(f, at[k]);
        if (!(s * t < 0)) return 0;
        const sb_f4 c = here + (at[k] - here) * sb_splat(s / (s - t));
        share *= share_of(w, f, c);
        if (share == 0 || (!w->near->simple && blocked(w, here, c, last, by[k - 1]))) return 0;
        here = c;
        last = by[k - 1];
    }
    return !w->near->simple && blocked(w, here, at[0], last, SIZE_MAX) ? 0 : share;
}

SB_MULTIVERSION
void sb_path_weight(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, sb_weight_parts *all)
{
    size_t any[SB_REFLECTIONS_MAX], ordered[SB_REFLECTIONS_MAX];
    int anys = 0, orders = 0;
    if (is_crooked(w->near, by, count)) {
        *all = (sb_weight_parts){.value = 1};
        reflected_crookedly(w, by, count, source, all);
        return;
    }
    for (int k = 0; k < count; k++) {
        if (sb_square_to_others(w->near, by, count, k))
            any[anys++] = by[k];
        else
            ordered[orders++] = by[k];
    }
    *all = (sb_weight_parts){.value = 1};
    if (anys > 0) reflected_squarely(w, any, anys, source, image, all);
    if (orders == 0 || all->value < SB_WEIGHT_LEAST) return;
    sb_f4 at[SB_REFLECTIONS_MAX + 1];
    at[0] = source;
    for (int k = 0; k < anys; k++) at[0] = sb_reflect(w->near->facet[any[k]].plane, at[0]);
    for (int k = 0; k < orders; k++) at[k + 1] = sb_reflect(w->near->facet[ordered[k]].plane, at[k]);
    const float others = reflected(w, ordered, orders, at);
    for (size_t k = 0; k < all->count; k++) {
        all->part[k].own *= sb_splat(others);
        all->part[k].other *= sb_splat(others);
    }
    all->value *= others;
}
