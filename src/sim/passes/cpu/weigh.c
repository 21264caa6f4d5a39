/* Weights of the hits of one particle. Most are plainly 0 or 1. */
#include "sim/passes/cpu/path_weights.h"

/* Sets the weight of a hit, and notes how it changes. */
static void set_weight(sb_images_around *images, const sb_weight_parts *all, sb_hits *hits, size_t k, bool direct)
{
    const float value = all->value < SB_WEIGHT_LEAST ? 0 : all->value;
    hits->root[k] = value;
    if (value == 0 || value == 1) return;
    for (size_t p = 0; p < all->count; p++) {
        const sb_weight *part = &all->part[p];
        const float rest = all->value / part->value;
        const sb_f4 own = part->own * sb_splat(rest), other = part->other * sb_splat(rest);
        if (sb_sum3(own * own) + sb_sum3(other * other) == 0) continue;
        if (images->slopes++ >= SB_WEIGHT_SLOPES_MAX) return;
        images->slope[images->slopes - 1] = (sb_weight_slope){own, other, (uint32_t)k, (uint32_t)all->facet[p], direct};
    }
}

static sb_weigher weigher_of(const sb_sim *sim, sb_images_around *images, sb_f4 self)
{
    const float spacing = sim->constant.spacing / (float)sim->space.quantum;
    return (sb_weigher){&images->near, self, SB_TRANSITION * spacing, 1e-3f * spacing, &images->standing};
}

static void stand(const sb_weigher *w)
{
    const sb_near *near = w->near;
    w->at->behind = 0;
    for (size_t a = 0; a < near->count; a++) {
        const sb_near_facet *f = &near->facet[a];
        w->at->above[a] = sb_before_facet(f, w->self);
        w->at->edge[a] = sb_about_edges(near, f, w->self, w->at->above[a], w->at->angle + f->edge);
        if (a < SB_SIDE_BITS) w->at->behind |= (uint64_t)(w->at->above[a] <= 0) << a;
    }
}

/* Whether a particle and the original of an image are on the same sides of all facets. */
SB_INLINE bool same_sides(const sb_images_around *images, const sb_weigher *w, uint32_t image)
{
    return w->near->count <= SB_SIDE_BITS && w->at->behind == images->behind[images->source[image]];
}

/* Whether the weight of a reflection at a facet is plainly 0 or, between both ends before the facet, 1: most are. */
SB_INLINE bool plain(const sb_weigher *w, size_t a, float hj, const sb_half_angle *angle, float *part)
{
    const sb_near_facet *f = &w->near->facet[a];
    const float hi = w->at->above[a], end = 0.5f * SB_TRANSITION_ENDS * w->transition;
    const sb_half_angle *own = w->at->angle + f->edge;
    if (hi * hj <= 0) return false;
    *part = 0;
    if (hi < 0 && !f->both) return true;
    bool inner = true;
    for (uint32_t k = 0; k < f->edges; k++) {
        const float t = own[k].c * angle[k].c - own[k].s * angle[k].s;
        const bool sharp = w->near->edges[f->edge + k].bend == SB_BEND_CONCAVE;
        if (t < (sharp ? 0 : -end)) return true;
        inner &= sharp || t > end;
    }
    *part = 1;
    return inner;
}

/* Makes room for positions about edges. */
static size_t forget_angles(sb_images_around *images)
{
    for (size_t k = 0; k < SB_AROUND_MAX; k++) images->angles[k] = SB_ANGLES_UNKNOWN;
    return 0;
}

/* The original of an image by one reflection at facet a. */
SB_INLINE sb_other_end other_end(sb_images_around *of, size_t image, size_t a, sb_f4 source)
{
    const sb_near *near = &of->near;
    const sb_near_facet *f = &near->facet[a];
    if (of->angles[image] == SB_ANGLES_UNKNOWN) {
        if (of->angle_count + f->edges > SB_HALF_ANGLES_MAX) of->angle_count = forget_angles(of);
        of->angles[image] = (uint32_t)of->angle_count;
        of->edge[image] = sb_about_edges(near, f, source, of->above[image], of->angle + of->angle_count);
        of->angle_count += f->edges;
    }
    return (sb_other_end){of->above[image], of->edge[image], of->angle + of->angles[image]};
}

/* Weight of a path by one reflection at facet a. */
static void weigh_single(sb_images_around *images, const sb_weigher *w, uint32_t image, size_t a, sb_f4 source,
                         sb_f4 place, sb_hits *hits, size_t k)
{
    const sb_near *near = w->near;
    const bool apart = near->simple || (!near->oblique && same_sides(images, w, image));
    bool known = images->whole[image] && w->at->above[a] > 0;
    if (known && apart) return;
    const sb_other_end j = other_end(images, image, a, source);
    if (!known) known = plain(w, a, j.above, j.angle, &hits->root[k]);
    if (known && (hits->root[k] == 0 || apart)) return;
    bool meets = true;
    sb_weight_parts all = {.value = 1};
    sb_take_part(&all, a, sb_at_facet(w, a, j, &meets));
    if (all.value >= SB_WEIGHT_LEAST && !apart) sb_finish_path(w, &a, 1, source, place, meets, &all);
    set_weight(images, &all, hits, k, false);
}

SB_MULTIVERSION
void sb_images_weigh(const sb_sim *sim, const sb_vicinity *v, sb_images_around *images, sb_f4 self, sb_hits *hits)
{
    const sb_near *near = &images->near;
    if (near->simple && near->edge_count == 0) return;
    const sb_weigher w = weigher_of(sim, images, self); /* it stands where weigh_direct has put it */
    for (size_t k = 0; k < hits->count; k++) {
        if (hits->root[k] == 0) continue;
        const uint32_t image = hits->candidate[k] - (uint32_t)v->count, path = images->path[image];
        if (near->simple && images->whole[image] && w.at->above[path - 1] > 0) continue; /* most */
        const sb_f4 place = self - (sb_f4){hits->x[k], hits->y[k], hits->z[k], 0};
        const sb_f4 source = v->place[images->source[image]];
        if (path <= SB_REFLECTION_MASK) {
            weigh_single(images, &w, image, path - 1, source, place, hits, k);
            continue;
        }
        sb_weight_parts all;
        size_t by[SB_REFLECTIONS_MAX];
        int count = 0;
        for (uint32_t rest = path; rest; rest >>= SB_REFLECTION_BITS) by[count++] = (rest & SB_REFLECTION_MASK) - 1;
        sb_path_weight(&w, by, count, source, place, &all);
        set_weight(images, &all, hits, k, false);
    }
}

SB_MULTIVERSION
void sb_images_weigh_direct(const sb_sim *sim, sb_images_around *images, sb_f4 self, sb_hits *hits)
{
    const sb_near *near = &images->near;
    images->slopes = 0;
    for (size_t k = 0; k < hits->padded; k++) hits->root[k] = 1;
    if (near->simple && near->edge_count == 0) return;
    const sb_weigher w = weigher_of(sim, images, self);
    stand(&w);
    if (near->simple) return;
    for (size_t k = 0; k < hits->count; k++) {
        if (near->count <= SB_SIDE_BITS && ((w.at->behind ^ images->behind[hits->candidate[k]]) & images->parts) == 0)
            continue;
        const sb_f4 place = self - (sb_f4){hits->x[k], hits->y[k], hits->z[k], 0};
        sb_weight_parts all = {.value = 1};
        size_t hider;
        const sb_weight past = sb_past_facets(&w, NULL, 0, place, &hider);
        if (hider == SIZE_MAX) continue;
        sb_take_part(&all, hider, past);
        set_weight(images, &all, hits, k, true);
    }
}
