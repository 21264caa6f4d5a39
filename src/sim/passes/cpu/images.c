#include "sim/passes/cpu/images.h"

#include "base/memory.h"

#include <math.h>

/* Width of the transition at an edge, in spacings: with it a lattice round an edge of 90 degrees has the density of the
   bulk (docs/method.md). */
static const float TRANSITION = 0.35f;

/* In widths: where the transition has ended. */
static const float ENDS = 3.5f;

/* Smaller weights are 0. */
static const float LEAST = 1e-4f;

/* In spacings: water this far behind a facet counts as behind it. */
static const float BEHIND = 0.1f;

/* ---- candidates ---- */

typedef struct gatherer {
    const sb_vicinity *v;
    sb_near *near;
    sb_images_around *images;
    sb_vicinity *out;
    float low[3], high[3]; /* of the group's particles */
    float support2, support;
    bool full;
} gatherer;

SB_INLINE float plane_of(const sb_near_facet *f, sb_f4 at)
{
    return sb_sum3(f->plane * at) - f->plane[3];
}

SB_INLINE bool within(const gatherer *g, sb_f4 at)
{
    float far2 = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float below = g->low[axis] - at[axis], above = at[axis] - g->high[axis];
        const float away = below > above ? below : above;
        far2 += away > 0 ? away * away : 0;
    }
    return far2 < g->support2;
}

static bool square(const sb_near *near, size_t a, size_t b)
{
    return fabsf(sb_sum3(near->facet[a].plane * near->facet[b].plane)) < 1e-3f;
}

/* Whether a path may go on to facet a. Reflections at right angles can be exchanged, so that one order is enough. */
static bool goes_on(const sb_near *near, uint32_t path, size_t last, size_t a)
{
    if (a == last || (square(near, last, a) && a > last)) return false;
    for (; path; path >>= SB_REFLECTION_BITS) {
        const size_t b = (path & SB_REFLECTION_MASK) - 1;
        if (b != a && !near->meets[b][a]) return false;
    }
    return true;
}

SB_INLINE float along_edge(const sb_near_edge *e, sb_f4 at)
{
    return sb_sum3(e->inward * at) - e->inward[3];
}

SB_INLINE sb_half_angle half_of(float o, float h)
{
    const float rho = sqrtf(o * o + h * h);
    const float c2 = 0.5f * (rho + o), s2 = 0.5f * (rho - o);
    const float c = c2 > 0 ? sqrtf(c2) : 0, s = s2 > 0 ? sqrtf(s2) : 0;
    return (sb_half_angle){h < 0 ? -c : c, s, rho};
}

/* The positions about the edges of facet f of a particle at the distance `above` before it. Returns the edge that it is
   farthest beyond, or nearest to. */
static uint32_t about_edges(const sb_near *near, const sb_near_facet *f, sb_f4 at, float above, sb_half_angle *angle)
{
    uint32_t edge = f->edge;
    float least = INFINITY;
    for (uint32_t k = 0; k < f->edges; k++) {
        const float inside = along_edge(&near->edges[f->edge + k], at);
        angle[k] = half_of(inside, above);
        if (inside >= least) continue;
        least = inside;
        edge = f->edge + k;
    }
    return edge;
}

static void reflect_all(gatherer *g, sb_f4 at, uint32_t source, uint32_t path, int depth, size_t last)
{
    const sb_near *near = g->near;
    for (size_t a = 0; a < near->count; a++) {
        const sb_near_facet *f = &near->facet[a];
        const float above = plane_of(f, at);
        if (fabsf(above) >= g->support) continue;
        const bool soft = f->edges > 0 || f->both;
        if (above <= 0 && !(soft && (depth == 0 || square(near, last, a)))) continue;
        if (depth > 0 && !goes_on(near, path, last, a)) continue;
        const sb_f4 image = sb_reflect(f->plane, at);
        const uint32_t longer = path | (uint32_t)(a + 1) << (SB_REFLECTION_BITS * depth);
        /* Further reflections take an image farther away. */
        if (!within(g, image)) continue;
        sb_vicinity *v = g->out;
        const size_t k = v->images, c = v->count + k;
        if (c >= SB_AROUND_MAX) {
            g->full = true;
            return;
        }
        v->x[c] = image[0], v->y[c] = image[1], v->z[c] = image[2];
        v->place[c] = image;
        g->images->source[k] = source;
        g->images->path[k] = longer;
        if (depth == 0) {
            g->images->above[k] = above;
            sb_images_around *of = g->images;
            if (of->angle_count + f->edges > SB_HALF_ANGLES_MAX) {
                g->full = true;
                return;
            }
            of->angles[k] = (uint32_t)of->angle_count;
            of->edge[k] = about_edges(near, f, at, above, of->angle + of->angle_count);
            of->angle_count += f->edges;
        }
        v->images++;
        if (depth + 1 < SB_REFLECTIONS_MAX && near->count > 1) reflect_all(g, image, source, longer, depth + 1, a);
    }
}

static void find_box(const sb_sim *sim, const sb_group *group, sb_f4 *low, sb_f4 *high)
{
    *low = *high = sb_offset(sim->state.position[group->first], group->corner);
    for (size_t i = group->first + 1; i < group->end; i++) {
        const sb_f4 at = sb_offset(sim->state.position[i], group->corner);
        *low = sb_select(at < *low, at, *low);
        *high = sb_select(at > *high, at, *high);
    }
}

enum { BITS = 64 }; /* facets whose sides are known as bits */

/* On which sides of the facets each record is, and which facets have water on both sides within reach of the group. */
static void find_sides(const gatherer *g, float margin)
{
    sb_near *near = g->near;
    const size_t bits = near->count < BITS ? near->count : BITS;
    bool before[SB_NEAR_MAX] = {false}, after[SB_NEAR_MAX] = {false};
    for (size_t c = 0; c < g->v->count; c++) {
        if (!within(g, g->v->place[c])) continue;
        uint64_t behind = 0;
        for (size_t a = 0; a < near->count; a++) {
            const float above = plane_of(&near->facet[a], g->v->place[c]);
            before[a] |= above > margin;
            after[a] |= above < -margin;
            if (a < bits) behind |= (uint64_t)(above <= 0) << a;
        }
        g->images->behind[c] = behind;
    }
    g->images->parts = 0;
    for (size_t a = 0; a < near->count; a++) {
        sb_near_facet *f = &near->facet[a];
        f->parts = before[a] && after[a] && (f->edges > 0 || f->both);
        near->simple &= !f->parts;
        if (a < bits) g->images->parts |= (uint64_t)f->parts << a;
    }
}

bool sb_images_gather(const sb_sim *sim, const sb_group *group, sb_vicinity *v, sb_images_around *images)
{
    sb_f4 low, high;
    v->images = images->angle_count = 0;
    find_box(sim, group, &low, &high);
    sb_near *near = &images->near;
    sb_mirrors_near(sim, group, low, high, near);
    if (near->full) return false;
    if (near->count == 0) return true;
    const float support = sim->constant.support / (float)sim->space.quantum;
    gatherer g = {v,       near, images, v, {low[0], low[1], low[2]}, {high[0], high[1], high[2]}, support * support,
                  support, false};
    find_sides(&g, BEHIND * sim->constant.spacing / (float)sim->space.quantum);
    uint32_t *start = v->start[SB_VICINITY_IMAGES];
    const size_t cells = (size_t)v->cells[0] * v->cells[1] * v->cells[2];
    for (size_t cell = 0; cell < cells; cell++) {
        start[cell] = (uint32_t)(v->count + v->images);
        for (size_t part = 0; part < v->parts; part++)
            for (uint32_t c = v->start[part][cell]; c < v->start[part][cell + 1] && !g.full; c++)
                if (within(&g, v->place[c])) reflect_all(&g, v->place[c], c, 0, 0, 0);
    }
    start[cells] = (uint32_t)(v->count + v->images);
    return !g.full;
}

/* ---- weights ---- */

/* exp(-t^2) = e; |error| < 2e-7 [Abramowitz and Stegun 1964, 7.1.26]. */
static float error_function(float t, float e)
{
    const float k = 1 / (1 + 0.3275911f * fabsf(t));
    const float tail =
        k * (0.254829592f + k * (-0.284496736f + k * (1.421413741f + k * (-1.453152027f + k * 1.061405429f)))) * e;
    return t < 0 ? tail - 1 : 1 - tail;
}

/* Part of a path that passes an edge, as in the diffraction by a half plane [Sommerfeld 1896]: sign -1 for a path that
   is reflected on the edge's inner side, +1 for one that goes straight past its outer side. di, dj: its derivatives by
   (o, h) of either end. *before: the path passes the facet itself. */
static float past_edge(sb_half_angle i, sb_half_angle j, float sign, float transition, float di[2], float dj[2],
                       bool *before)
{
    const float t = 2 * (i.c * j.c + sign * i.s * j.s) / transition;
    di[0] = di[1] = dj[0] = dj[1] = 0;
    *before &= t >= 0;
    if (t > ENDS) return 1;
    if (t < -ENDS) return 0;
    const float e = expf(-t * t), slope = e / (1.7724539f * transition);
    const float to_i = slope / (i.rho + 1e-6f * transition), to_j = slope / (j.rho + 1e-6f * transition);
    di[0] = to_i * (i.c * j.c - sign * i.s * j.s);
    di[1] = to_i * (i.s * j.c + sign * i.c * j.s);
    dj[0] = to_j * (j.c * i.c - sign * j.s * i.s);
    dj[1] = to_j * (j.s * i.c + sign * j.c * i.s);
    return 0.5f + 0.5f * error_function(t, e);
}

/* A weight and its derivatives by the two ends. */
typedef struct weight {
    float value;
    sb_f4 own, other;
} weight;

static const weight WHOLE = {.value = 1}, NONE = {.value = 0};

/* Multiplies a weight by that of one edge or facet. */
SB_INLINE void multiply(weight *w, float value, sb_f4 own, sb_f4 other)
{
    w->own = w->own * sb_splat(value) + own * sb_splat(w->value);
    w->other = w->other * sb_splat(value) + other * sb_splat(w->value);
    w->value *= value;
}

typedef struct weigher {
    const sb_near *near;
    sb_f4 self;
    float transition, eps;
    sb_standing *at; /* of self */
} weigher;

/* Part of the straight line from the particle to `at` that facet f does not hide. */
static weight past_facet(const weigher *w, const sb_near_facet *f, sb_f4 at)
{
    const float hi = plane_of(f, w->self), hj = plane_of(f, at);
    if (hi * hj >= 0) return WHOLE;
    const sb_f4 normal = f->plane * (hi > 0 ? (sb_f4){1, 1, 1, 0} : (sb_f4){-1, -1, -1, 0});
    weight hidden = WHOLE;
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        const sb_near_edge *e = &w->near->edges[k];
        const sb_f4 inward = e->inward * (sb_f4){1, 1, 1, 0};
        const float oi = along_edge(e, w->self), oj = along_edge(e, at);
        float di[2] = {0}, dj[2] = {0};
        bool before = true;
        const float past = e->bend == SB_BEND_CONVEX ? past_edge(half_of(oi, fabsf(hi)), half_of(oj, -fabsf(hj)), 1,
                                                                 w->transition, di, dj, &before)
                                                     : oi * fabsf(hj) + oj * fabsf(hi) < 0;
        multiply(&hidden, 1 - past, -(inward * sb_splat(di[0]) + normal * sb_splat(di[1])),
                 -(inward * sb_splat(dj[0]) + normal * sb_splat(dj[1])));
    }
    return (weight){1 - hidden.value, -hidden.own, -hidden.other};
}

/* The same for all facets with water on both sides that `count` facets by[] at right angles reflect onto themselves:
   the one that hides most. *by_facet: that one, SIZE_MAX if none hides. */
static bool keeps(const sb_near *near, size_t a, const sb_near_facet *g);
static weight past_facets(const weigher *w, const size_t *by, int count, sb_f4 at, size_t *by_facet)
{
    weight least = WHOLE;
    *by_facet = SIZE_MAX;
    for (size_t k = 0; k < w->near->count; k++) {
        const sb_near_facet *g = &w->near->facet[k];
        bool kept = g->parts;
        for (int m = 0; m < count && kept; m++)
            kept = k != by[m] && square(w->near, by[m], k) && keeps(w->near, by[m], g);
        if (!kept) continue;
        const weight past = past_facet(w, g, at);
        if (past.value >= least.value) continue;
        least = past;
        *by_facet = k;
    }
    return least;
}

static bool inside(const sb_near *near, const sb_near_facet *f, sb_f4 at)
{
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++)
        if (along_edge(&near->edges[k], at) < 0) return false;
    return true;
}

/* Whether a facet other than the two given blocks the way from a to b. */
static bool blocked(const weigher *w, sb_f4 a, sb_f4 b, size_t skip, size_t other)
{
    for (size_t k = 0; k < w->near->count; k++) {
        if (k == skip || k == other) continue;
        const sb_near_facet *f = &w->near->facet[k];
        const float s = plane_of(f, a), t = plane_of(f, b);
        if (!((s > w->eps && t < -w->eps) || (s < -w->eps && t > w->eps))) continue;
        if (inside(w->near, f, a + (b - a) * sb_splat(s / (s - t)))) return true;
    }
    return false;
}

/* Whether reflection at facet a leaves the near edges of facet g where they are. */
static bool keeps(const sb_near *near, size_t a, const sb_near_facet *g)
{
    bool kept = true;
    for (uint32_t k = g->edge; k < g->edge + g->edges; k++)
        kept &= fabsf(sb_sum3(near->edges[k].inward * near->facet[a].plane)) < 1e-3f;
    return kept;
}

/* The other end of a path by one reflection at a facet, or by several at right angles to each other. */
typedef struct other_end {
    float above;                /* before the facet */
    uint32_t edge;              /* that it is farthest beyond, or nearest to */
    const sb_half_angle *angle; /* about the facet's edges */
} other_end;

/* Part of a reflection that facet a has of a path to the end `j`. meets: it passes the facet itself. */
static weight at_facet(const weigher *w, size_t a, other_end j, bool *meets)
{
    const sb_near_facet *f = &w->near->facet[a];
    const float hi = w->at->above[a], hj = j.above;
    const bool front = f->both ? hi * hj > 0 : hi > 0 && hj > 0;
    if (!front && (f->edges == 0 || (hi < 0 && hj < 0))) return NONE;
    weight all = WHOLE;
    *meets &= front;
    /* One end behind the plane: the path goes round the edge that this end is nearest to, and before the others. */
    const uint32_t round = hi * hj < 0 ? (hi < 0 ? w->at->edge[a] : j.edge) : UINT32_MAX;
    const sb_f4 normal = f->plane * (sb_f4){1, 1, 1, 0};
    for (uint32_t k = 0; k < f->edges && all.value >= LEAST; k++) {
        const bool before = round != UINT32_MAX && f->edge + k != round;
        const float ti = before && hi < 0 ? -1 : 1, tj = before && hj < 0 ? -1 : 1;
        sb_half_angle one = w->at->angle[f->edge + k], other = j.angle[k];
        one.c *= ti;
        other.c *= tj;
        float di[2], dj[2];
        const float value = past_edge(one, other, -1, w->transition, di, dj, meets);
        if (value == 1) continue;
        const sb_f4 inward = w->near->edges[f->edge + k].inward * (sb_f4){1, 1, 1, 0};
        multiply(&all, value, inward * sb_splat(di[0]) + normal * sb_splat(ti * di[1]),
                 inward * sb_splat(dj[0]) + normal * sb_splat(tj * dj[1]));
    }
    return all.value < LEAST ? NONE : all;
}

/* Whether a facet that reflections at facet a do not leave where it is blocks the way from one end of a leg to the
   other. */
static bool leg_blocked(const weigher *w, size_t a, sb_f4 from, sb_f4 to)
{
    for (size_t k = 0; k < w->near->count; k++) {
        const sb_near_facet *g = &w->near->facet[k];
        if (k == a || (square(w->near, a, k) && (g->parts || !w->near->meets[a][k]))) continue;
        const float s = plane_of(g, from), t = plane_of(g, to);
        if (!((s > w->eps && t < -w->eps) || (s < -w->eps && t > w->eps))) continue;
        if (inside(w->near, g, from + (to - from) * sb_splat(s / (s - t)))) return true;
    }
    return false;
}

/* Parts of the weight of a path by facet, and their product. */
typedef struct parts {
    size_t count, facet[SB_REFLECTIONS_MAX + 1];
    weight part[SB_REFLECTIONS_MAX + 1];
    float value;
} parts;

static void take_part(parts *all, size_t facet, weight part)
{
    all->facet[all->count] = facet;
    all->part[all->count++] = part;
    all->value *= part.value;
}

/* What hides or blocks a path by reflections at right angles. */
static void finish_squarely(const weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, bool meets,
                            parts *all)
{
    if (w->near->simple || all->value < LEAST) return;
    size_t hider;
    const weight past = past_facets(w, by, count, image, &hider);
    if (hider != SIZE_MAX) take_part(all, hider, past);
    if (all->value < LEAST || !meets || count > 1) return;
    const sb_near_facet *f = &w->near->facet[by[0]];
    const float hi = plane_of(f, w->self), hj = plane_of(f, source);
    const sb_f4 c = w->self + (image - w->self) * sb_splat(hi / (hi + hj));
    if (leg_blocked(w, by[0], w->self, c) || leg_blocked(w, by[0], c, source)) all->value = 0;
}

/* Reflections at facets at right angles to each other, in any order. */
static void reflected_squarely(const weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, parts *all)
{
    bool meets = true;
    for (int k = 0; k < count && all->value >= LEAST; k++) {
        const sb_near_facet *f = &w->near->facet[by[k]];
        sb_half_angle angle[SB_NEAR_EDGES_MAX];
        const float above = plane_of(f, source);
        const other_end j = {above, about_edges(w->near, f, source, above, angle), angle};
        take_part(all, by[k], at_facet(w, by[k], j, &meets));
    }
    finish_squarely(w, by, count, source, image, meets, all);
}

/* Part of a reflection at `at` that the facet has. */
static float share_of(const weigher *w, const sb_near_facet *f, sb_f4 at)
{
    float share = 1;
    for (uint32_t k = f->edge; k < f->edge + f->edges; k++) {
        const float y = along_edge(&w->near->edges[k], at) / w->transition;
        share *= y > 3 ? 1 : y < -3 ? 0 : 0.5f + 0.5f * erff(y);
    }
    return share < LEAST ? 0 : share;
}

/* Several reflections. at[0]: the particle; at[k]: its image by the first k planes. */
static float reflected(const weigher *w, const size_t *by, int count, const sb_f4 *at)
{
    sb_f4 here = w->self;
    float share = 1;
    size_t last = SIZE_MAX;
    for (int k = count; k >= 1; k--) {
        const sb_near_facet *f = &w->near->facet[by[k - 1]];
        const float s = plane_of(f, here), t = plane_of(f, at[k]);
        if (!(s * t < 0)) return 0;
        const sb_f4 c = here + (at[k] - here) * sb_splat(s / (s - t));
        share *= share_of(w, f, c);
        if (share == 0 || (!w->near->simple && blocked(w, here, c, last, by[k - 1]))) return 0;
        here = c;
        last = by[k - 1];
    }
    return !w->near->simple && blocked(w, here, at[0], last, SIZE_MAX) ? 0 : share;
}

/* Weight of a path. Facets at right angles to all others of the path come in any order; the others are met one after
   the other. */
static void weight_of(const weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, parts *all)
{
    size_t any[SB_REFLECTIONS_MAX], ordered[SB_REFLECTIONS_MAX];
    int anys = 0, orders = 0;
    for (int k = 0; k < count; k++) {
        bool square_to_all = true;
        for (int m = 0; m < count; m++) square_to_all &= m == k || square(w->near, by[k], by[m]);
        if (square_to_all)
            any[anys++] = by[k];
        else
            ordered[orders++] = by[k];
    }
    *all = (parts){.value = 1};
    if (anys > 0) reflected_squarely(w, any, anys, source, image, all);
    if (orders == 0 || all->value < LEAST) return;
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

/* Sets the weight of a hit, and notes how it changes. */
static void set_weight(sb_images_around *images, const parts *all, sb_hits *hits, size_t k, bool direct)
{
    const float value = all->value < LEAST ? 0 : all->value;
    hits->root[k] = value;
    if (value == 0) return;
    if (value == 1) return;
    for (size_t p = 0; p < all->count; p++) {
        const weight *part = &all->part[p];
        const float rest = all->value / part->value;
        const sb_f4 own = part->own * sb_splat(rest), other = part->other * sb_splat(rest);
        if (sb_sum3(own * own) + sb_sum3(other * other) == 0) continue;
        if (images->slopes++ >= SB_WEIGHT_SLOPES_MAX) return;
        images->slope[images->slopes - 1] = (sb_weight_slope){own, other, (uint32_t)k, (uint32_t)all->facet[p], direct};
    }
}

static weigher weigher_of(const sb_sim *sim, sb_images_around *images, sb_f4 self)
{
    const float spacing = sim->constant.spacing / (float)sim->space.quantum;
    return (weigher){&images->near, self, TRANSITION * spacing, 1e-3f * spacing, &images->standing};
}

static void stand(const weigher *w)
{
    const sb_near *near = w->near;
    w->at->behind = 0;
    for (size_t a = 0; a < near->count; a++) {
        const sb_near_facet *f = &near->facet[a];
        w->at->above[a] = plane_of(f, w->self);
        w->at->edge[a] = about_edges(near, f, w->self, w->at->above[a], w->at->angle + f->edge);
        if (a < BITS) w->at->behind |= (uint64_t)(w->at->above[a] <= 0) << a;
    }
}

/* Whether a particle and the original of an image are on the same sides of all facets. */
SB_INLINE bool same_sides(const sb_images_around *images, const weigher *w, uint32_t image)
{
    return w->near->count <= BITS && w->at->behind == images->behind[images->source[image]];
}

/* Whether the weight of a reflection at a facet is plainly 0 or, between both ends before the facet, 1: most are. */
SB_INLINE bool plain(const weigher *w, size_t a, float hj, const sb_half_angle *angle, float *part)
{
    const sb_near_facet *f = &w->near->facet[a];
    const float hi = w->at->above[a], end = 0.5f * ENDS * w->transition;
    const sb_half_angle *own = w->at->angle + f->edge;
    if (hi * hj <= 0) return false;
    *part = 0;
    if (hi < 0 && !f->both) return true;
    bool inner = true;
    for (uint32_t k = 0; k < f->edges; k++) {
        const float t = own[k].c * angle[k].c - own[k].s * angle[k].s;
        if (t < -end) return true;
        inner &= t > end;
    }
    *part = 1;
    return inner;
}

/* Weight of a path by one reflection at facet a. */
static void weigh_single(const sb_images_around *images, const weigher *w, uint32_t image, size_t a, sb_f4 source,
                         sb_f4 place, parts *all)
{
    const sb_near *near = w->near;
    bool meets = true;
    const other_end j = {images->above[image], images->edge[image], images->angle + images->angles[image]};
    *all = (parts){.value = 1};
    take_part(all, a, at_facet(w, a, j, &meets));
    if (all->value < LEAST || near->simple || (!near->oblique && same_sides(images, w, image))) return;
    finish_squarely(w, &a, 1, source, place, meets, all);
}

void sb_images_weigh(const sb_sim *sim, const sb_vicinity *v, sb_images_around *images, sb_f4 self, sb_hits *hits)
{
    const sb_near *near = &images->near;
    for (size_t k = 0; k < hits->count; k++) hits->root[k] = 1;
    if (near->simple && near->edge_count == 0) return;
    const weigher w = weigher_of(sim, images, self);
    stand(&w);
    for (size_t k = 0; k < hits->count; k++) {
        const uint32_t image = hits->candidate[k] - (uint32_t)v->count, path = images->path[image];
        const sb_f4 place = self - (sb_f4){hits->x[k], hits->y[k], hits->z[k], 0};
        const sb_f4 source = v->place[images->source[image]];
        parts all;
        if (path <= SB_REFLECTION_MASK) {
            const bool known =
                plain(&w, path - 1, images->above[image], images->angle + images->angles[image], &hits->root[k]);
            if (known && (hits->root[k] == 0 || near->simple || (!near->oblique && same_sides(images, &w, image))))
                continue;
            weigh_single(images, &w, image, path - 1, source, place, &all);
        } else {
            size_t by[SB_REFLECTIONS_MAX];
            int count = 0;
            for (uint32_t rest = path; rest; rest >>= SB_REFLECTION_BITS) by[count++] = (rest & SB_REFLECTION_MASK) - 1;
            weight_of(&w, by, count, source, place, &all);
        }
        set_weight(images, &all, hits, k, false);
    }
}

void sb_images_weigh_direct(const sb_sim *sim, sb_images_around *images, sb_f4 self, sb_hits *hits)
{
    const sb_near *near = &images->near;
    images->slopes = 0;
    for (size_t k = 0; k < hits->count; k++) hits->root[k] = 1;
    if (near->simple) return;
    const weigher w = weigher_of(sim, images, self);
    stand(&w);
    for (size_t k = 0; k < hits->count; k++) {
        if (near->count <= BITS && ((w.at->behind ^ images->behind[hits->candidate[k]]) & images->parts) == 0) continue;
        const sb_f4 place = self - (sb_f4){hits->x[k], hits->y[k], hits->z[k], 0};
        parts all = {.value = 1};
        size_t hider;
        const weight past = past_facets(&w, NULL, 0, place, &hider);
        if (hider == SIZE_MAX) continue;
        take_part(&all, hider, past);
        set_weight(images, &all, hits, k, true);
    }
}

/* ---- lists ---- */

/* Numbers the images that lists refer to, in their order. Returns their number. */
static uint32_t number_images(sb_list_builder *lists, const sb_vicinity *v, sb_images_around *images, size_t fours)
{
    uint32_t used = 0;
    for (size_t k = 0; k < v->images; k++) images->number[k] = 0;
    for (size_t f = fours; f < lists->fours; f++)
        for (int k = 0; k < 4; k++) {
            const size_t candidate = lists->four[f].place[k] / SB_PLACE_STEP;
            if (candidate >= v->count) images->number[candidate - v->count] = 1;
        }
    for (size_t k = 0; k < v->images; k++) images->number[k] = images->number[k] ? used++ : UINT32_MAX;
    for (size_t f = fours; f < lists->fours; f++)
        for (int k = 0; k < 4; k++) {
            const size_t candidate = lists->four[f].place[k] / SB_PLACE_STEP;
            if (candidate >= v->count)
                lists->four[f].place[k] = (uint16_t)((v->count + images->number[candidate - v->count]) * SB_PLACE_STEP);
        }
    return used;
}

void sb_list_images(sb_list_builder *lists, const sb_vicinity *v, sb_images_around *images, size_t fours,
                    sb_group *group)
{
    group->image = (uint32_t)lists->images;
    group->plane = (uint32_t)lists->planes;
    group->images = group->planes = 0;
    if (v->images == 0) return;
    const uint32_t used = number_images(lists, v, images, fours);
    const size_t planes = images->near.count;
    if (sb_grow((void **)&lists->image, &lists->capacity_image, lists->images + used, sizeof *lists->image) != 0 ||
        sb_grow((void **)&lists->plane, &lists->capacity_plane, lists->planes + planes, sizeof *lists->plane) != 0) {
        lists->out_of_memory = true;
        return;
    }
    uint32_t run = 0, before = 0;
    for (size_t k = 0; k < v->images; k++) {
        if (images->number[k] == UINT32_MAX) continue;
        /* Sources follow the cells, in one part after the other: nearly in the order of the runs. */
        const uint32_t source = images->source[k];
        if (source < before) run = before = 0;
        while (source >= before + v->run[run].count) before += v->run[run++].count;
        lists->image[lists->images++] = (sb_image){v->run[run].begin + source - before, images->path[k]};
    }
    for (size_t p = 0; p < planes; p++)
        lists->plane[lists->planes++] = (sb_group_plane){images->near.facet[p].plane, images->near.facet[p].mirror};
    group->images = used;
    group->planes = (uint32_t)planes;
}
