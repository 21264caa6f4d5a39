/* The pairs at edges of a particle, and what repels it from its own images. */
#include "base/memory.h"
#include "sim/passes/cpu/search_parts.h"

#include <math.h>
#include <string.h>

/* A particle's own image at less than one spacing repels it by REPULSION/2 W(0) (1 - r/spacing)^2 besides the kernel,
   whose slope vanishes at r = 0. Else a particle may pair with its own image (docs/method.md). */
static const float REPULSION = 2;

/* Pairs at edges below this part of m W(0)/spacing are left out. */
static const float NEGLIGIBLE = 1e-3f;

/* The entry of a candidate in the arrays that neighbours are read from. */
static uint32_t entry_of(const sb_vicinity *v, uint32_t candidate)
{
    uint32_t before = 0, run = 0;
    while (candidate >= before + v->run[run].count) before += v->run[run++].count;
    return v->run[run].begin + candidate - before;
}

/* The vectors of a pair at an edge, kg/m^4; see sb_edge_pair. */
typedef struct edge_vectors {
    sb_f4 own, other, head;
} edge_vectors;

static void set_edge(sb_edge_pair *e, edge_vectors v)
{
    memcpy(e->own, &v.own, sizeof e->own);
    memcpy(e->other, &v.other, sizeof e->other);
    memcpy(e->head, &v.head, sizeof e->head);
}

/* Adds a pair at an edge. Pairs with the same particle by facets of the same body are one: where facets bend little
   they nearly cancel. */
static void add_edge(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, uint32_t source,
                     uint32_t facet, edge_vectors v, sb_reflections *r)
{
    const sb_near_facet *f = &w->images.near.facet[facet];
    r->flux += sb_sum3((v.own + v.other) * f->velocity);
    size_t *slot = source == self ? &w->edge_own : &w->edge_of[w->hit_of[source]];
    if (*slot >= w->edges && *slot < lists->edges && lists->edge[*slot].entry == source &&
        sb_mirror_body(sim, lists->edge[*slot].mirror) == sb_mirror_body(sim, f->mirror)) {
        sb_edge_pair *e = &lists->edge[*slot];
        set_edge(e, (edge_vectors){sb_edge_own(e) + v.own, sb_edge_other(e) + v.other, sb_edge_head(e) + v.head});
        return;
    }
    if (sb_grow((void **)&lists->edge, &lists->capacity_edge, lists->edges + 1, sizeof *lists->edge) != 0) {
        lists->out_of_memory = true;
        return;
    }
    *slot = lists->edges;
    lists->edge[lists->edges] = (sb_edge_pair){.entry = source, .mirror = f->mirror};
    set_edge(&lists->edge[lists->edges++], v);
}

/* Forgets the pairs at edges of the last particle. */
static void clear_edges(sb_searcher *w)
{
    w->edge_own = SIZE_MAX;
    for (size_t k = 0; k < w->hits.count; k++) w->edge_of[k] = SIZE_MAX;
}

/* Completes the pairs at edges of a particle, and sums them. */
static void close_edges(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, sb_reflections *r)
{
    const float least = NEGLIGIBLE * sim->constant.mass * w->value_scale / sim->constant.spacing;
    size_t kept = w->edges;
    for (size_t k = w->edges; k < lists->edges; k++) {
        sb_edge_pair e = lists->edge[k];
        const sb_f4 own = sb_edge_own(&e), other = sb_edge_other(&e);
        if (sb_sum3(own * own) + sb_sum3(other * other) < least * least) continue;
        r->gradient += own;
        r->push -= sb_edge_head(&e) * sb_splat(sb_hydrostatic(sim));
        const uint32_t hit = w->hit_of[e.entry];
        if (e.entry == self)
            r->doubled += other;
        else
            sb_add_force(w, hit, other);
        e.entry = entry_of(&w->vicinity, e.entry);
        lists->edge[kept++] = e;
    }
    lists->edges = kept;
}

/* Adds the pairs at edges of those weights [from, to) that belong to these hits. */
SB_APART void add_edges(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, size_t from,
                        size_t to, const sb_hits *h, sb_reflections *r)
{
    const float scale = sim->constant.mass * w->value_scale / (float)sim->space.quantum;
    if (w->images.slopes > SB_WEIGHT_SLOPES_MAX) {
        w->full |= SB_FULL_FACETS;
        return;
    }
    for (size_t k = from; k < to; k++) {
        const sb_weight_slope *s = &w->images.slope[k];
        if (h->root[s->hit] == 0) continue;
        const uint32_t candidate = h->candidate[s->hit];
        const uint32_t source = s->direct ? candidate : w->images.source[candidate - w->vicinity.count];
        const sb_f4 whole = sb_splat(scale * h->value[s->hit]), own = s->own * whole;
        const float fall = s->direct ? 0 : w->vicinity.place[source][2] - w->vicinity.place[candidate][2];
        add_edge(sim, w, lists, self, source, s->facet, (edge_vectors){own, s->other * whole, own * sb_splat(fall)}, r);
    }
}

/* Adds what repels particle i from its own images, to the values of their hits and as pairs at edges. */
static void repel(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, sb_reflections *r)
{
    sb_hits *h = &w->reflected;
    const float end = sim->constant.spacing / sim->constant.support;
    const float top = REPULSION * (float)w->kernel->shape(0);
    for (size_t n = 0; n < w->own_images; n++) {
        const uint32_t k = w->own_image[n];
        if (h->q2[k] >= end * end || h->root[k] == 0) continue;
        const uint32_t path = w->images.path[h->candidate[k] - w->vicinity.count];
        if (path > SB_REFLECTION_MASK) continue;
        const float q = sqrtf(h->q2[k]) + 1e-6f, left = 1 - q / end;
        const float slope = -top * left / (end * q) * sim->constant.mass * w->slope_scale * h->root[k];
        const sb_f4 push = (sb_f4){h->x[k], h->y[k], h->z[k], 0} * sb_splat(slope);
        h->value[k] += 0.5f * top * left * left;
        r->repulsion += push;
        add_edge(sim, w, lists, self, self, path - 1, (edge_vectors){push, push, {0}}, r);
    }
}

void sb_search_edges(const sb_sim *sim, sb_searcher *w, sb_list_builder *lists, uint32_t self, size_t direct,
                     sb_reflections *r)
{
    clear_edges(w);
    add_edges(sim, w, lists, self, 0, direct, &w->hits, r);
    repel(sim, w, lists, self, r);
    add_edges(sim, w, lists, self, direct, w->images.slopes, &w->reflected, r);
    close_edges(sim, w, lists, self, r);
}
