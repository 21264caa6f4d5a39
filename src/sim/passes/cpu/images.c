#include "sim/passes/cpu/images.h"

#include "base/memory.h"
#include "sim/passes/cpu/path_parts.h"

#include <math.h>

typedef struct gatherer {
    sb_vicinity *v;
    sb_near *near;
    sb_images_around *images;
    sb_cull *cull;
    sb_sources *sources;
    sb_relations *relations;
    bool full;
} gatherer;

SB_INLINE bool within(const sb_box *box, float support, sb_f4 at)
{
    float far2 = 0;
    for (int axis = 0; axis < 3; axis++) {
        const float below = box->low[axis] - at[axis], above = at[axis] - box->high[axis];
        const float away = below > above ? below : above;
        far2 += away > 0 ? away * away : 0;
    }
    return far2 < support * support;
}

/* Notes an image. Returns false if there are too many. */
static bool add_image(const gatherer *g, uint32_t source, const sb_route *to, bool whole, float above)
{
    sb_vicinity *v = g->v;
    const size_t k = v->images, c = v->count + k;
    if (c >= SB_AROUND_MAX) return false;
    v->x[c] = to->at[0], v->y[c] = to->at[1], v->z[c] = to->at[2];
    v->place[c] = to->at;
    g->images->source[k] = source;
    g->images->path[k] = to->path;
    g->images->whole[k] = whole;
    g->images->above[k] = above;
    g->images->angles[k] = SB_ANGLES_UNKNOWN;
    g->images->number[k] = UINT32_MAX;
    v->images++;
    return true;
}

static void reflect_on(gatherer *g, uint32_t source, size_t s, const sb_route *from);

/* Adds the image by a route that goes on to facet a, and those by the routes from there on. */
SB_INLINE void reflect_at(gatherer *g, uint32_t source, size_t s, const sb_route *from, size_t a)
{
    const sb_near *near = g->near;
    const sb_sources *of = g->sources;
    const sb_near_facet *f = &near->facet[a];
    if (!sb_route_ordered(near, from, a)) return;
    const float above = sb_before_facet(f, from->at);
    if (fabsf(above) >= g->cull->support || (from->away && above >= 0)) return;
    if (from->away && !(near->blunt[a] && sb_route_blunt_to(g->relations, from, a))) return;
    const bool soft = f->edges > 0 || f->both, leans = sb_route_leans(from, a);
    if (above <= 0 && !leans && !(soft && sb_facets_square(near, from->last, a))) return;
    sb_route to = {.at = sb_reflect(f->plane, from->at), .beyond = from->beyond || of->beyond[a][s]};
    sb_route_append(near, g->relations, from, a, &to);
    to.away = !within(&g->cull->box, g->cull->support, to.at);
    /* Further reflections take an image farther away, unless it is behind a facet: blunt corners have such ones. */
    if (to.away && !to.blunt) return;
    const bool misses = to.square || to.crooked ? to.beyond : !sb_cull_meets(near, g->cull, to.path, to.at);
    if (!misses && !to.away && !add_image(g, source, &to, false, above))
        g->full = true;
    else if (to.depth < SB_REFLECTIONS_MAX)
        reflect_on(g, source, s, &to);
}

/* Adds the images of a source, which is number `s` of those in hand, by the paths that go on from here. */
static void reflect_on(gatherer *g, uint32_t source, size_t s, const sb_route *from)
{
    for (size_t w = 0; 64 * w < g->near->count; w++) {
        uint64_t facets = sb_route_facets(g->near, from, &g->sources->open[s], w);
        for (; facets && !g->full; facets &= facets - 1)
            reflect_at(g, source, s, from, 64 * w + (size_t)__builtin_ctzll(facets));
    }
}

/* Adds the images of the sources by paths that begin at facet a. first: candidate of the first source. */
SB_INLINE void reflect_first(gatherer *g, uint32_t first, size_t a)
{
    const sb_near *near = g->near;
    const sb_sources *of = g->sources;
    const sb_near_facet *f = &near->facet[a];
    const bool soft = f->edges > 0 || f->both;
    for (size_t s = 0; s < of->count && !g->full; s++) {
        const bool away = of->apart[a][s];
        if ((away && !(near->blunt[a] && of->near[s])) || (of->beyond[a][s] && !near->skew)) continue;
        const sb_f4 at = g->v->place[first + s];
        const float above = sb_before_facet(f, at);
        if ((above <= 0 && !soft) || (away && (above <= 0 || above >= g->cull->support))) continue;
        sb_route to = {.at = sb_reflect(f->plane, at), .beyond = of->beyond[a][s], .away = away};
        sb_route_begin(near, g->relations, a, &to);
        if (!to.beyond && !away && !add_image(g, first + (uint32_t)s, &to, of->whole[a][s], above)) g->full = true;
        if (near->meeting && !g->full) reflect_on(g, first + (uint32_t)s, s, &to);
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

/* The images of all candidates. */
SB_APART void reflect_candidates(gatherer *g)
{
    const sb_vicinity *v = g->v;
    sb_sources *of = g->sources;
    for (size_t begin = 0; begin < v->count; begin += of->count) {
        of->count = v->count - begin < SB_SOURCES_MAX ? v->count - begin : SB_SOURCES_MAX;
        of->x = v->x + begin, of->y = v->y + begin, of->z = v->z + begin;
        if (!sb_cull_sources(g->near, g->cull, of)) continue;
        for (size_t a = 0; a < g->near->count; a++)
            if (of->any[a] || g->near->blunt[a]) reflect_first(g, (uint32_t)begin, a);
    }
}

/* Which facets have water on both sides near the group, and, if any have, on which sides of all facets each record
   is. Each group that sees a pair across a facet finds water on both of its sides, so that the pair has the same weight
   in all of them. */
SB_APART void find_parts(const gatherer *g)
{
    sb_near *near = g->near;
    g->images->parts = 0;
    for (size_t a = 0; a < near->count; a++) {
        sb_near_facet *f = &near->facet[a];
        f->parts = g->sources->highest[a] > 0 && g->sources->lowest[a] < 0 && (f->edges > 0 || f->both);
        near->simple &= !f->parts;
        if (a < SB_SIDE_BITS) g->images->parts |= (uint64_t)f->parts << a;
    }
    if (near->simple) return;
    sb_relations_find_parts(near, g->relations);
    const size_t bits = near->count < SB_SIDE_BITS ? near->count : SB_SIDE_BITS;
    for (size_t c = 0; c < g->v->count; c++) {
        uint64_t behind = 0;
        for (size_t a = 0; a < bits; a++)
            behind |= (uint64_t)(sb_before_facet(&near->facet[a], g->v->place[c]) <= 0) << a;
        g->images->behind[c] = behind;
    }
}

/* Removes the concave edges that no water near the group's box is beyond: it then sees no edge. */
SB_APART void drop_edges(const sb_sim *sim, const sb_vicinity *v, const sb_box *box, sb_near *near)
{
    const float support = sim->constant.support / (float)sim->space.quantum;
    uint32_t kept = 0;
    for (size_t a = 0; a < near->count; a++) {
        sb_near_facet *f = &near->facet[a];
        const uint32_t first = f->edge, end = first + f->edges;
        f->edge = kept;
        for (uint32_t k = first; k < end; k++) {
            const sb_near_edge e = near->edges[k];
            bool counts = e.bend != SB_BEND_CONCAVE;
            for (size_t c = 0; c < v->count && !counts; c++)
                counts = sb_within_edge(&e, v->place[c]) < 0 && within(box, support, v->place[c]);
            if (counts) near->edges[kept++] = e;
        }
        f->edges = kept - f->edge;
    }
    near->edge_count = kept;
}

SB_MULTIVERSION
bool sb_images_gather(const sb_sim *sim, const sb_group *group, sb_vicinity *v, sb_images_around *images)
{
    sb_f4 low, high;
    v->images = 0;
    images->angle_count = 0;
    images->used = 0;
    find_box(sim, group, &low, &high);
    sb_near *near = &images->near;
    sb_mirrors_near(sim, group, low, high, near);
    if (near->full) return false;
    if (near->count == 0) return true;
    drop_edges(sim, v, &(sb_box){{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}, near);
    gatherer g = {v, near, images, &images->cull, &images->sources, &images->relations, false};
    if (near->meeting) sb_relations_find(near, g.relations);
    sb_cull_begin(sim, near, low, high, g.cull);
    for (size_t a = 0; a < near->count; a++) g.sources->lowest[a] = INFINITY, g.sources->highest[a] = -INFINITY;
    reflect_candidates(&g);
    find_parts(&g);
    return !g.full;
}

/* ---- lists ---- */

SB_MULTIVERSION
void sb_images_number(const sb_vicinity *v, sb_images_around *images, sb_hits *hits)
{
    for (size_t k = 0; k < hits->count; k++) {
        const size_t image = hits->candidate[k] - v->count;
        if (images->number[image] == UINT32_MAX) {
            images->number[image] = images->used;
            images->listed[images->used++] = (uint32_t)image;
        }
        hits->candidate[k] = (uint32_t)v->count + images->number[image];
    }
}

SB_MULTIVERSION
void sb_list_images(sb_list_builder *lists, const sb_vicinity *v, sb_images_around *images, sb_group *group)
{
    group->image = (uint32_t)lists->images;
    group->plane = (uint32_t)lists->planes;
    group->images = group->planes = 0;
    if (!images || lists->out_of_memory) return;
    const uint32_t used = images->used;
    const size_t planes = images->near.count;
    if (sb_grow((void **)&lists->image, &lists->capacity_image, lists->images + used, sizeof *lists->image) != 0 ||
        sb_grow((void **)&lists->plane, &lists->capacity_plane, lists->planes + planes, sizeof *lists->plane) != 0) {
        lists->out_of_memory = true;
        return;
    }
    uint32_t run = 0, before = 0;
    for (uint32_t n = 0; n < used; n++) {
        const uint32_t k = images->listed[n];
        const uint32_t source = images->source[k];
        if (source < before) run = before = 0;
        while (source >= before + v->run[run].count) before += v->run[run++].count;
        const sb_f4 at = v->place[v->count + k];
        lists->image[lists->images++] =
            (sb_image){{at[0], at[1], at[2]}, v->run[run].begin + source - before, images->path[k]};
    }
    for (size_t p = 0; p < planes; p++)
        lists->plane[lists->planes++] = (sb_group_plane){images->near.facet[p].plane, images->near.facet[p].mirror};
    group->images = used;
    group->planes = (uint32_t)planes;
}
