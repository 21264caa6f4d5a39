#include "sim/passes/cpu/path_weights.h"
#include "sim/passes/cpu/path_blocked.h"
#include "sim/passes/cpu/path_hidden.h"
#include "sim/passes/cpu/path_orders.h"

void sb_finish_path(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, bool meets,
                    sb_weight_parts *all)
{
    if (w->near->simple || all->value < SB_WEIGHT_LEAST) return;
    size_t hider;
    const sb_weight past = sb_past_facets(w, by, count, source, image, &hider);
    if (hider != SIZE_MAX) sb_take_part(all, hider, past);
    if (all->value < SB_WEIGHT_LEAST || !meets || count > 1) return;
    if (sb_bounce_blocked(w, by[0], source, image)) all->value = 0;
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
        if (sb_bounce_blocked(w, by[k], source, image)) all->value = 0;
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
        if (share == 0 || (!w->near->simple && sb_way_blocked(w, here, c, last, by[k - 1]))) return 0;
        here = c;
        last = by[k - 1];
    }
    return !w->near->simple && sb_way_blocked(w, here, at[0], last, SIZE_MAX) ? 0 : share;
}

SB_MULTIVERSION
void sb_path_weight(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, sb_weight_parts *all)
{
    size_t any[SB_REFLECTIONS_MAX], ordered[SB_REFLECTIONS_MAX];
    int anys = 0, orders = 0;
    if (sb_is_crooked(w->near, by, count)) {
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
