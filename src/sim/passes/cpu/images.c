#include "sim/passes/cpu/images.h"

#include "base/memory.h"
#include "sim/passes/cpu/path_weights.h"

#include <math.h>

/* In spacings: water this far behind a facet counts as behind it. */
static const float BEHIND = 0.1f;

typedef struct gatherer {
    sb_vicinity *v;
    sb_near *near;
    sb_images_around *images;
    sb_cull *cull;
    sb_sources *sources;
    float low[3], high[3]; /* of the group's particles */
    float support2, support, margin;
    bool before[SB_NEAR_MAX], after[SB_NEAR_MAX]; /* there is water on these sides of facets */
    bool full;
} gatherer;

/* The first reflections of a path. */
typedef struct route {
    sb_f4 at;
    uint32_t path;
    int depth;
    size_t last;
    bool square; /* all facets stand at right angles to each other, so that the weight is a product of theirs */
    bool beyond; /* one of them has no part of it */
} route;

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

/* Whether a path may go on to facet a. Reflections at right angles can be exchanged, so that one order is enough. */
static bool goes_on(const sb_near *near, uint32_t path, size_t last, size_t a)
{
    if (a == last || (sb_facets_square(near, last, a) && a > last)) return false;
    for (; path; path >>= SB_REFLECTION_BITS) {
        const size_t b = (path & SB_REFLECTION_MASK) - 1;
        if (b != a && !near->meets[b][a]) return false;
    }
    return true;
}

/* Whether facet a stands at right angles to all facets of a path. */
static bool square_to_all(const sb_near *near, uint32_t path, size_t a)
{
    bool square = true;
    for (; path; path >>= SB_REFLECTION_BITS) square &= sb_facets_square(near, (path & SB_REFLECTION_MASK) - 1, a);
    return square;
}

/* Notes an image. Returns false if there are too many. */
static bool add_image(gatherer *g, uint32_t source, const route *to, size_t facet, float above, bool whole)
{
    sb_vicinity *v = g->v;
    sb_images_around *of = g->images;
    const sb_near_facet *f = &g->near->facet[facet];
    const size_t k = v->images, c = v->count + k;
    if (c >= SB_AROUND_MAX) return false;
    v->x[c] = to->at[0], v->y[c] = to->at[1], v->z[c] = to->at[2];
    v->place[c] = to->at;
    of->source[k] = source;
    of->path[k] = to->path;
    of->whole[k] = whole;
    v->images++;
    if (to->depth > 1) return true;
    of->above[k] = above;
    if (of->angle_count + f->edges > SB_HALF_ANGLES_MAX) return false;
    of->angles[k] = (uint32_t)of->angle_count;
    of->edge[k] = sb_about_edges(g->near, f, v->place[source], above, of->angle + of->angle_count);
    of->angle_count += f->edges;
    return true;
}

/* Adds the images of source `s` by the paths that go on from here. */
static void reflect_all(gatherer *g, size_t s, const route *from)
{
    const sb_near *near = g->near;
    const sb_sources *of = g->sources;
    for (size_t a = 0; a < near->count && !g->full; a++) {
        if (from->depth == 0 ? of->apart[a][s] : !goes_on(near, from->path, from->last, a)) continue;
        if (of->beyond[a][s] && !near->skew) continue;
        const sb_near_facet *f = &near->facet[a];
        const float above = sb_before_facet(f, from->at);
        if (fabsf(above) >= g->support) continue;
        const bool soft = f->edges > 0 || f->both;
        const bool square = from->depth == 0 || sb_facets_square(near, from->last, a);
        if (above <= 0 && !(soft && square)) continue;
        const route to = {.at = sb_reflect(f->plane, from->at),
                          .path = from->path | (uint32_t)(a + 1) << (SB_REFLECTION_BITS * from->depth),
                          .depth = from->depth + 1,
                          .last = a,
                          .square = from->square && square_to_all(near, from->path, a),
                          .beyond = from->beyond || of->beyond[a][s]};
        /* Further reflections take an image farther away. */
        if (!within(g, to.at)) continue;
        if (!(to.square && to.beyond) &&
            !add_image(g, of->candidate[s], &to, a, above, from->depth == 0 && of->whole[a][s])) {
            g->full = true;
            return;
        }
        if (to.depth < SB_REFLECTIONS_MAX && near->meeting) reflect_all(g, s, &to);
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

/* On which sides of the facets the sources are, and their images. */
static void reflect_sources(gatherer *g)
{
    sb_near *near = g->near;
    sb_sources *of = g->sources;
    const size_t bits = near->count < SB_SIDE_BITS ? near->count : SB_SIDE_BITS;
    if (of->count == 0) return;
    sb_cull_sources(near, g->cull, of);
    for (size_t s = 0; s < of->count; s++) {
        uint64_t behind = 0;
        for (size_t a = 0; a < near->count; a++) {
            g->before[a] |= of->above[a][s] > g->margin;
            g->after[a] |= of->above[a][s] < -g->margin;
            if (a < bits) behind |= (uint64_t)(of->above[a][s] <= 0) << a;
        }
        g->images->behind[of->candidate[s]] = behind;
        if (!g->full) reflect_all(g, s, &(route){.at = g->v->place[of->candidate[s]], .square = true});
    }
    of->count = 0;
}

/* The images of candidates [begin, end). */
static void reflect_cell(gatherer *g, uint32_t begin, uint32_t end)
{
    const sb_vicinity *v = g->v;
    sb_sources *of = g->sources;
    for (uint32_t c = begin; c < end; c++) {
        if (!within(g, v->place[c])) continue;
        of->x[of->count] = v->x[c], of->y[of->count] = v->y[c], of->z[of->count] = v->z[c];
        of->candidate[of->count++] = c;
        if (of->count == SB_SOURCES_MAX) reflect_sources(g);
    }
    reflect_sources(g);
}

/* Which facets have water on both sides near the group. */
static void find_parts(const gatherer *g)
{
    sb_near *near = g->near;
    g->images->parts = 0;
    for (size_t a = 0; a < near->count; a++) {
        sb_near_facet *f = &near->facet[a];
        f->parts = g->before[a] && g->after[a] && (f->edges > 0 || f->both);
        near->simple &= !f->parts;
        if (a < SB_SIDE_BITS) g->images->parts |= (uint64_t)f->parts << a;
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
    gatherer g = {.v = v,
                  .near = near,
                  .images = images,
                  .cull = &images->cull,
                  .sources = &images->sources,
                  .low = {low[0], low[1], low[2]},
                  .high = {high[0], high[1], high[2]},
                  .support2 = support * support,
                  .support = support,
                  .margin = BEHIND * sim->constant.spacing / (float)sim->space.quantum};
    sb_cull_begin(sim, near, low, high, &images->cull);
    images->sources.count = 0;
    uint32_t *start = v->start[SB_VICINITY_IMAGES];
    const size_t cells = (size_t)v->cells[0] * v->cells[1] * v->cells[2];
    for (size_t cell = 0; cell < cells; cell++) {
        start[cell] = (uint32_t)(v->count + v->images);
        for (size_t part = 0; part < v->parts; part++) reflect_cell(&g, v->start[part][cell], v->start[part][cell + 1]);
    }
    start[cells] = (uint32_t)(v->count + v->images);
    find_parts(&g);
    return !g.full;
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
