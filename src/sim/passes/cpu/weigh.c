/* Weights of the hits of one particle. Most are plainly 0 or 1. */
#include "sim/passes/cpu/path_hidden.h"
#include "sim/passes/cpu/path_weights.h"
#include "sim/passes/cpu/soft_edges.h"

/* Sets the weight of a hit, and notes how it changes. */
SB_APART void set_weight(sb_images_around *images, const sb_weight_parts *all, sb_hits *hits, size_t k, bool direct)
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
    return (sb_weigher){&images->near,           &images->relations, self,
                        SB_TRANSITION * spacing, 1e-3f * spacing,    &images->standing};
}

SB_APART void stand(const sb_weigher *w)
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

/* Whether the weight of a reflection at facet a between two ends before it is plainly 0 or 1, or that of one edge,
   which is then noted: most are. apart: no facet hides the path; else only 0 is plain. */
SB_INLINE bool plain(const sb_weigher *w, size_t a, const sb_half_angle *other, bool apart, sb_hits *hits, size_t k,
                     sb_soft_edges *soft)
{
    const sb_near_facet *f = &w->near->facet[a];
    const sb_near_edge *edge = w->near->edges + f->edge;
    const sb_half_angle *own = w->at->angle + f->edge;
    const float end = 0.5f * SB_TRANSITION_ENDS * w->transition;
    uint32_t in_transition = 0, which = 0;
    for (uint32_t e = 0; e < f->edges; e++) {
        const float t = own[e].c * other[e].c - own[e].s * other[e].s;
        const bool sharp = edge[e].bend == SB_BEND_CONCAVE;
        if (t < (sharp ? 0 : -end)) {
            hits->root[k] = 0;
            return true;
        }
        if (sharp || t > end) continue;
        in_transition++;
        which = e;
    }
    if (!apart) return false;
    return in_transition == 0 ||
           (in_transition == 1 && sb_soft_edges_add(soft, k, a, f->edge + which, own[which], other[which]));
}

/* Sets the weights of hits at noted edges, and notes how they change. */
SB_APART void set_soft(sb_images_around *images, const sb_weigher *w, sb_soft_edges *soft, sb_hits *hits)
{
    sb_soft_edges_weigh(soft, w->transition);
    for (size_t n = 0; n < soft->count; n++) {
        const float value = soft->value[n];
        const uint32_t k = soft->hit[n], a = soft->facet[n];
        hits->root[k] = value < SB_WEIGHT_LEAST ? 0 : value;
        if (value < SB_WEIGHT_LEAST || value == 1) continue;
        const sb_f4 keep = {1, 1, 1, 0};
        const sb_f4 inward = w->near->edges[soft->edge[n]].inward * keep, normal = w->near->facet[a].plane * keep;
        if (images->slopes++ >= SB_WEIGHT_SLOPES_MAX) return;
        images->slope[images->slopes - 1] =
            (sb_weight_slope){inward * sb_splat(soft->own_o[n]) + normal * sb_splat(soft->own_h[n]),
                              inward * sb_splat(soft->other_o[n]) + normal * sb_splat(soft->other_h[n]), k, a, false};
    }
}

/* Weight of a path by one reflection at facet a. apart: no facet hides it. */
SB_APART void weigh_single(sb_images_around *images, const sb_weigher *w, uint32_t image, size_t a, sb_f4 source,
                           bool apart, sb_hits *hits, size_t k)
{
    const sb_f4 place = w->self - (sb_f4){hits->x[k], hits->y[k], hits->z[k], 0};
    bool meets = true;
    sb_weight_parts all = {.value = 1};
    sb_take_part(&all, a, sb_at_facet(w, a, other_end(images, image, a, source), &meets));
    if (all.value >= SB_WEIGHT_LEAST && !apart) sb_finish_path(w, &a, 1, source, place, meets, &all);
    set_weight(images, &all, hits, k, false);
}

/* Weight of a path by several reflections. */
SB_APART void weigh_several(sb_images_around *images, const sb_weigher *w, uint32_t path, sb_f4 source, sb_hits *hits,
                            size_t k)
{
    const sb_f4 place = w->self - (sb_f4){hits->x[k], hits->y[k], hits->z[k], 0};
    sb_weight_parts all;
    size_t by[SB_REFLECTIONS_MAX];
    int count = 0;
    for (uint32_t rest = path; rest; rest >>= SB_REFLECTION_BITS) by[count++] = (rest & SB_REFLECTION_MASK) - 1;
    sb_path_weight(w, by, count, source, place, &all);
    set_weight(images, &all, hits, k, false);
}

SB_MULTIVERSION
void sb_images_weigh(const sb_sim *sim, const sb_vicinity *v, sb_images_around *images, sb_f4 self, sb_hits *hits)
{
    const sb_near *near = &images->near;
    if (near->simple && near->edge_count == 0) return;
    const sb_weigher w = weigher_of(sim, images, self); /* it stands where weigh_direct has put it */
    sb_soft_edges soft;
    soft.count = 0;
    for (size_t k = 0; k < hits->count; k++) {
        if (hits->root[k] == 0) continue;
        const uint32_t image = hits->candidate[k] - (uint32_t)v->count, path = images->path[image];
        const uint32_t from = images->source[image];
        if (path > SB_REFLECTION_MASK) {
            weigh_several(images, &w, path, v->place[from], hits, k);
            continue;
        }
        const bool apart = near->simple || (!near->oblique && same_sides(images, &w, image));
        const float hi = w.at->above[path - 1], hj = images->above[image];
        if (apart && images->whole[image] && hi > 0) continue;
        if (hi > 0 && hj > 0 &&
            plain(&w, path - 1, other_end(images, image, path - 1, v->place[from]).angle, apart, hits, k, &soft))
            continue;
        if (hi * hj > 0 && hi < 0 && !near->facet[path - 1].both)
            hits->root[k] = 0;
        else
            weigh_single(images, &w, image, path - 1, v->place[from], apart, hits, k);
    }
    set_soft(images, &w, &soft, hits);
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
        const sb_weight past = sb_past_facets(&w, NULL, 0, place, place, &hider);
        if (hider == SIZE_MAX) continue;
        sb_take_part(&all, hider, past);
        set_weight(images, &all, hits, k, true);
    }
}
