/* Finds and fills the voids of the current slab, row by row: points of the boundary surface that are too far from any
   particle. A point belongs to the slab and the row in which the surface before it lies. The boundary surface is
   bisected repeatedly until each piece is covered, needs no particle, or has room for one at its centre. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

#include <stdlib.h>

enum { DEPTH_MAX = 96, BLOCKS = 256, WAITING = 16384 };
/* In spacings: pieces smaller than piece_min are not divided further; pieces larger than piece_max are divided among
   threads. */
static const double piece_min = 0.003, piece_max = 12;

/* A point of the surface and the direction into the solid there. Three points span a piece, two a line. */
typedef struct corner {
    sb_vec3 at, inward;
} corner;

typedef struct piece {
    corner corner[3];
    int corners;
    uint32_t surface;
} piece;

/* The centre of a piece that is far from all particles. The rest of the piece is not examined yet. */
typedef struct hole {
    piece piece;
    sb_sample sample;
    double distance;
    size_t order;
} hole;

typedef struct hole_list {
    hole *hole;
    size_t count, capacity;
    int failed;
} hole_list;

static bool same(sb_vec3 a, sb_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static corner between(corner a, corner b)
{
    sb_vec3 at = sb_scale(sb_add(a.at, b.at), 0.5);
    return (corner){at, same(a.inward, b.inward) ? a.inward : sb_normalize(sb_add(a.inward, b.inward))};
}

static corner center_of(const piece *p)
{
    if (p->corners == 2) return between(p->corner[0], p->corner[1]);
    const corner *c = p->corner;
    sb_vec3 at = sb_scale(sb_add(c[0].at, sb_add(c[1].at, c[2].at)), 1.0 / 3);
    if (same(c[0].inward, c[1].inward) && same(c[0].inward, c[2].inward)) return (corner){at, c[0].inward};
    return (corner){at, sb_normalize(sb_add(c[0].inward, sb_add(c[1].inward, c[2].inward)))};
}

static sb_vec3 on_boundary(const sb_sampler *sampler, corner c)
{
    return sb_madd(c.at, sampler->settings.offset, c.inward);
}

/* Bisects a piece at its longest side, measured on the boundary surface. */
static void halve(const sb_sampler *sampler, const piece *p, piece half[2])
{
    int sides = p->corners == 2 ? 1 : 3, longest = 0;
    double best = -1;
    for (int i = 0; i < sides; ++i) {
        sb_vec3 a = on_boundary(sampler, p->corner[i]);
        double length = sb_norm(sb_sub(on_boundary(sampler, p->corner[(i + 1) % p->corners]), a));
        if (length > best) {
            best = length;
            longest = i;
        }
    }
    int next = (longest + 1) % p->corners;
    corner middle = between(p->corner[longest], p->corner[next]);
    half[0] = half[1] = *p;
    half[0].corner[next] = middle;
    half[1].corner[longest] = middle;
}

/* Whether a point of a surface belongs to the current row. */
static bool owns(const sb_sampler *sampler, sb_vec3 at)
{
    return sb_slab_owns(sampler, at) && sb_slab_of(&sampler->rows, at) == sampler->row;
}

/* Whether a part of a piece lies in the current row. */
static bool meets(const sb_sampler *sampler, const piece *p)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    uint32_t first = UINT32_MAX, last = 0;
    for (int i = 0; i < p->corners; ++i) {
        const double at = sb_sample_along(p->corner[i].at, sampler->slabs.axis);
        const uint32_t row = sb_slab_of(&sampler->rows, p->corner[i].at);
        low = fmin(low, at);
        high = fmax(high, at);
        first = row < first ? row : first;
        last = row > last ? row : last;
    }
    return sb_slab_meets(sampler, low, high, 0) && first <= sampler->row && last >= sampler->row;
}

/* Whether the ball around one particle contains all corners. It is convex, so it then contains the flat piece
   between them. A curved piece projects from that by at most its sagitta, which is subtracted. */
static bool in_ball(const sb_sampler *sampler, const piece *p, corner center, sb_vec3 particle, double cover)
{
    for (int i = 0; i < p->corners; ++i) {
        sb_vec3 turn = sb_sub(p->corner[i].inward, center.inward);
        double radius = cover - 0.5 * sampler->settings.offset * sb_dot(turn, turn);
        sb_vec3 arm = sb_sub(on_boundary(sampler, p->corner[i]), particle);
        if (!(radius > 0 && sb_dot(arm, arm) <= radius * radius)) return false;
    }
    return true;
}

/* Examines a piece whose centre, moved by the offset, is far from all particles. It is a hole if the centre's place
   on the boundary surface is far from all particles, too. Returns true if it must be bisected. */
static bool examine_far(const sb_sampler *sampler, const piece *p, corner c, double radius, hole_list *list)
{
    double spacing = sampler->settings.spacing, cover = SB_SAMPLE_COVER * spacing, margin;
    sb_vec3 at;
    sb_placement placement = sb_sample_place(sampler, p->surface, c.at, c.inward, &at, &margin);
    /* A piece with a buried centre may have points that are not buried. A crowded part ends a tenth of the offset
       beyond the border of the boundary surface. */
    if (placement == SB_BURIED)
        return radius > 0.2 * spacing && !sb_sample_buried(sampler, p->surface, c.at, c.inward, radius);
    if (placement == SB_CROWDED) return radius > margin && radius > 0.06 * sampler->settings.offset;
    /* In a thin part the boundary surface lies elsewhere, and is no larger than the surface over it. */
    double distance = sb_sample_set_nearest(&sampler->set, at, cover, NULL);
    if (distance + radius <= cover) return false;
    if (distance < SB_SAMPLE_FILL * spacing || !owns(sampler, c.at)) return radius > piece_min * spacing;
    if (sb_grow((void **)&list->hole, &list->capacity, list->count + 1, sizeof *list->hole))
        list->failed = 1;
    else
        list->hole[list->count++] = (hole){
            .piece = *p, .sample = {at, sb_scale(c.inward, -1), p->surface, sampler->slab}, .distance = distance};
    return false;
}

/* Examines one piece. Returns true if it must be bisected. */
static bool examine(const sb_sampler *sampler, const piece *p, hole_list *list)
{
    if (!meets(sampler, p)) return false;
    double spacing = sampler->settings.spacing, cover = SB_SAMPLE_COVER * spacing;
    corner c = center_of(p);
    sb_vec3 at = on_boundary(sampler, c);
    double radius2 = 0;
    for (int i = 0; i < p->corners; ++i) {
        sb_vec3 arm = sb_sub(on_boundary(sampler, p->corner[i]), at);
        radius2 = fmax(radius2, sb_dot(arm, arm));
    }
    double radius = sqrt(radius2);
    /* A piece this large is hardly ever covered by one particle, so the search for it is skipped. */
    if (radius >= 0.8 * cover)
        return radius < 1.5 * spacing || !sb_sample_buried(sampler, p->surface, c.at, c.inward, radius);
    size_t nearest;
    double distance = sb_sample_set_nearest(&sampler->set, at, cover, &nearest);
    if (distance >= SB_SAMPLE_FILL * spacing) return examine_far(sampler, p, c, radius, list);
    if (distance + radius <= cover || in_ball(sampler, p, c, sampler->set.sample[nearest].at, cover)) return false;
    return radius > piece_min * spacing;
}

static void search(const sb_sampler *sampler, const piece *whole, hole_list *list)
{
    piece stack[DEPTH_MAX + 2];
    int depth_of[DEPTH_MAX + 2], count = 1;
    stack[0] = *whole;
    depth_of[0] = 0;
    while (count > 0 && !list->failed) {
        list->failed = sb_stop_signal();
        piece p = stack[--count];
        int depth = depth_of[count];
        if (!examine(sampler, &p, list) || depth == DEPTH_MAX) continue;
        halve(sampler, &p, stack + count);
        depth_of[count] = depth_of[count + 1] = depth + 1;
        count += 2;
    }
}

static sb_vec3 flat(sb_vec3 a)
{
    return sb_vec(a.x, 0, a.z);
}

/* Returns the number of pieces of a surface: its triangles (in 2D every other one, as its strip's line), the arcs of
   its creases (two pieces each; in 2D one), and its caps. */
static size_t piece_count(const sb_sampler *sampler, const sb_surface *surface)
{
    size_t triangles = sb_surface_mesh(surface)->triangle_count;
    return sampler->settings.dimensions == 2 ? triangles / 2 + surface->crease_count
                                             : triangles + 2 * surface->crease_count + surface->cap_count;
}

static piece crease_piece(const sb_surface *surface, size_t i)
{
    const sb_crease *crease = surface->creases + i / 2;
    sb_vec3 in[2] = {sb_scale(crease->normal[0], -1), sb_scale(crease->normal[1], -1)};
    if (i % 2) return (piece){.corner = {{crease->a, in[0]}, {crease->b, in[1]}, {crease->a, in[1]}}, .corners = 3};
    return (piece){.corner = {{crease->a, in[0]}, {crease->b, in[0]}, {crease->b, in[1]}}, .corners = 3};
}

static bool piece_flat(const sb_surface *surface, size_t i, piece *p)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    p->corners = 2;
    if (i < mesh->triangle_count / 2) {
        sb_vec3 inward = sb_scale(surface->normal[2 * i], -1);
        for (int k = 0; k < 2; ++k) p->corner[k] = (corner){flat(mesh->vertices[mesh->triangles[2 * i][k]]), inward};
        return sb_dot(inward, inward) > 0;
    }
    const sb_crease *crease = surface->creases + (i - mesh->triangle_count / 2);
    for (int k = 0; k < 2; ++k) p->corner[k] = (corner){flat(crease->a), sb_scale(crease->normal[k], -1)};
    return true;
}

static bool piece_solid(const sb_surface *surface, size_t i, piece *p)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    if (i < mesh->triangle_count) {
        sb_vec3 inward = sb_scale(surface->normal[i], -1);
        p->corners = 3;
        for (int k = 0; k < 3; ++k) p->corner[k] = (corner){mesh->vertices[mesh->triangles[i][k]], inward};
        return sb_dot(inward, inward) > 0;
    }
    i -= mesh->triangle_count;
    if (i < 2 * surface->crease_count) {
        uint32_t index = p->surface;
        *p = crease_piece(surface, i);
        p->surface = index;
        return true;
    }
    const sb_cap *cap = surface->caps + (i - 2 * surface->crease_count);
    p->corners = 3;
    for (int k = 0; k < 3; ++k) p->corner[k] = (corner){cap->at, sb_scale(cap->normal[k], -1)};
    return true;
}

/* Pieces that are to be searched in parallel. */
typedef struct work {
    size_t count;
    piece *piece; /* WAITING */
    hole_list found[BLOCKS];
    hole_list *all;
} work;

static int join(hole_list *all, const hole_list *found)
{
    if (found->failed || sb_grow((void **)&all->hole, &all->capacity, all->count + found->count, sizeof *all->hole))
        return -1;
    for (size_t k = 0; k < found->count; ++k) all->hole[all->count++] = found->hole[k];
    return 0;
}

/* Searches all waiting pieces. The holes are added to the common list in the pieces' order. */
static int work_flush(const sb_sampler *sampler, work *w)
{
#pragma omp parallel for schedule(dynamic, 1)
    for (size_t b = 0; b < BLOCKS; ++b) {
        w->found[b].count = 0;
        for (size_t i = b * w->count / BLOCKS; i < (b + 1) * w->count / BLOCKS; ++i)
            search(sampler, w->piece + i, w->found + b);
    }
    w->count = 0;
    int failed = 0;
    for (size_t b = 0; b < BLOCKS && !failed; ++b) failed = join(w->all, w->found + b);
    return failed;
}

static int work_push(const sb_sampler *sampler, work *w, const piece *p)
{
    w->piece[w->count++] = *p;
    return w->count == WAITING ? work_flush(sampler, w) : 0;
}

static double size_of(const piece *p)
{
    double size = 0;
    for (int i = 0; i < p->corners; ++i) size = fmax(size, sb_norm(sb_sub(p->corner[i].at, p->corner[0].at)));
    return size;
}

/* Divides large pieces first, so that the work is spread over the threads. */
static int work_cut(const sb_sampler *sampler, work *w, const piece *whole)
{
    piece stack[DEPTH_MAX + 2];
    int count = 1;
    stack[0] = *whole;
    while (count > 0) {
        if (sb_stop_signal()) return -1;
        piece p = stack[--count];
        if (!meets(sampler, &p)) continue;
        double size = size_of(&p);
        if (size <= piece_max * sampler->settings.spacing || count == DEPTH_MAX) {
            if (work_push(sampler, w, &p)) return -1;
        } else {
            const corner c = center_of(&p);
            if (sb_sample_buried(sampler, p.surface, c.at, c.inward, size)) continue;
            halve(sampler, &p, stack + count);
            count += 2;
        }
    }
    return 0;
}

static int search_surface(const sb_sampler *sampler, uint32_t surface, work *w)
{
    const sb_surface *on = sampler->surfaces + surface;
    bool flat_scene = sampler->settings.dimensions == 2;
    size_t count = piece_count(sampler, on);
    for (size_t i = 0; i < count; ++i) {
        piece p = {.surface = surface};
        bool some = flat_scene ? piece_flat(on, i, &p) : piece_solid(on, i, &p);
        if (some && meets(sampler, &p) && work_cut(sampler, w, &p)) return -1;
    }
    return 0;
}

static int compare_holes(const void *left, const void *right)
{
    const hole *a = left, *b = right;
    if (a->distance != b->distance) return a->distance > b->distance ? -1 : 1;
    return (a->order > b->order) - (a->order < b->order);
}

/* Adds particles in the holes, the largest hole first. */
static int fill(sb_sampler *sampler, hole_list *all)
{
    double least = SB_SAMPLE_FILL * sampler->settings.spacing;
    for (size_t i = 0; i < all->count; ++i) all->hole[i].order = i;
    if (all->count > 1) qsort(all->hole, all->count, sizeof *all->hole, compare_holes);
    for (size_t i = 0; i < all->count; ++i)
        if (sb_stop_signal() || (!sb_sample_set_any(&sampler->set, all->hole[i].sample.at, least) &&
                                 sb_sample_set_add(&sampler->set, &all->hole[i].sample)))
            return -1;
    return 0;
}

/* Fills the voids of the current row. */
static int fill_row(sb_sampler *sampler, work *w)
{
    hole_list last = {0}, all = {0};
    int failed = 0;
    w->all = &all;
    for (uint32_t i = sampler->first; i < sampler->last && !failed; ++i)
        if (sb_sampler_takes(sampler, i)) failed = search_surface(sampler, i, w);
    failed = failed || work_flush(sampler, w) || fill(sampler, &all);
    /* A particle that is added never uncovers a piece, so only pieces with holes are searched again. */
    while (!failed && all.count > 0) {
        hole_list swap = last;
        last = all;
        all = swap;
        all.count = 0;
        for (size_t i = 0; i < last.count && !failed; ++i) failed = work_push(sampler, w, &last.hole[i].piece);
        failed = failed || work_flush(sampler, w) || fill(sampler, &all);
    }
    sb_free(all.hole);
    sb_free(last.hole);
    return failed;
}

int sb_sample_voids(sb_sampler *sampler)
{
    work *w = sb_alloc(1, sizeof *w);
    if (!w) return -1;
    w->piece = sb_alloc_untouched(WAITING, sizeof *w->piece);
    int failed = !w->piece;
    for (sampler->row = 0; sampler->row < sampler->rows.count && !failed; ++sampler->row) failed = fill_row(sampler, w);
    for (int b = 0; b < BLOCKS; ++b) sb_free(w->found[b].hole);
    sb_free(w->piece);
    sb_free(w);
    return failed;
}
