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
    float low[3], high[3]; /* of the group's particles */
    float support2, support;
    bool full;
} gatherer;

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

static void reflect_all(gatherer *g, sb_f4 at, uint32_t source, uint32_t path, int depth, size_t last)
{
    const sb_near *near = g->near;
    for (size_t a = 0; a < near->count; a++) {
        const sb_near_facet *f = &near->facet[a];
        const float above = sb_before_facet(f, at);
        if (fabsf(above) >= g->support) continue;
        const bool soft = f->edges > 0 || f->both;
        if (above <= 0 && !(soft && (depth == 0 || sb_facets_square(near, last, a)))) continue;
        if (depth > 0 && !goes_on(near, path, last, a)) continue;
        const sb_f4 image = sb_reflect(f->plane, at);
        const uint32_t longer = path | (uint32_t)(a + 1) << (SB_REFLECTION_BITS * depth);
        /* Further reflections take an image farther away. */
        if (!within(g, image)) continue;
        sb_vicinity *v = g->v;
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
            sb_images_around *of = g->images;
            of->above[k] = above;
            if (of->angle_count + f->edges > SB_HALF_ANGLES_MAX) {
                g->full = true;
                return;
            }
            of->angles[k] = (uint32_t)of->angle_count;
            of->edge[k] = sb_about_edges(near, f, at, above, of->angle + of->angle_count);
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

/* On which sides of the facets each record is, and which facets have water on both sides near the group. */
static void find_sides(const gatherer *g, float margin)
{
    sb_near *near = g->near;
    const size_t bits = near->count < SB_SIDE_BITS ? near->count : SB_SIDE_BITS;
    bool before[SB_NEAR_MAX] = {false}, after[SB_NEAR_MAX] = {false};
    for (size_t c = 0; c < g->v->count; c++) {
        if (!within(g, g->v->place[c])) continue;
        uint64_t behind = 0;
        for (size_t a = 0; a < near->count; a++) {
            const float above = sb_before_facet(&near->facet[a], g->v->place[c]);
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
    gatherer g = {.v = v,
                  .near = near,
                  .images = images,
                  .low = {low[0], low[1], low[2]},
                  .high = {high[0], high[1], high[2]},
                  .support2 = support * support,
                  .support = support};
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
