/* The facets near a group of particles, and how they stand to each other. */
#include "base/memory.h"
#include "sim/walls/mirrors.h"

#include <math.h>

/* Cosines between the normals of two facets. PARALLEL: below it they face each other and are parallel, to 0.8 degrees,
   so that they meet in no line. OPPOSITE: below it they face each other with less than 26 degrees between them, and
   neither hides water from the other. */
static const float PARALLEL = -0.9999f, OPPOSITE = -0.9f;

/* In spacings: how far behind a plane water or a facet must be to count as behind it. */
static const double BEHIND = 0.05;

/* A group's box. */
typedef struct box {
    sb_vec3 corner, middle, half; /* quanta; middle and half of the particles' box */
    double radius;                /* of a ball around the middle that contains all within a support radius */
} box;

/* Adds the edges near the group. Of edges on one line the nearest counts. */
static void add_edges(const sb_sim *sim, const box *b, sb_vec3 moved, const sb_mirror *mirror, sb_near *near,
                      sb_near_facet *f)
{
    double distance[SB_NEAR_EDGES_MAX];
    f->edge = (uint32_t)near->edge_count;
    for (uint32_t k = mirror->edge; k < mirror->edge + mirror->edges; k++) {
        const sb_mirror_edge *e = &sim->walls.mirrors.edge[k];
        const double away = sb_mirrors_from_segment(sb_add(e->from, moved), sb_add(e->to, moved), b->middle);
        if (away > b->radius) continue;
        const bool leans =
            e->bend == SB_BEND_CONCAVE && fabs(sb_dot(e->wall, mirror->normal)) > (double)SB_FACETS_SQUARE;
        const sb_vec3 inward = leans ? e->wall : e->inward;
        const double distance_of = leans ? sb_dot(e->wall, e->from) : e->distance;
        const sb_near_edge made = {{(float)inward.x, (float)inward.y, (float)inward.z,
                                    (float)(distance_of + sb_dot(inward, sb_sub(moved, b->corner)))},
                                   e->bend};
        uint32_t at = 0;
        while (at < f->edges) {
            const sb_f4 other = near->edges[f->edge + at].inward;
            if (sb_sum3(other * made.inward) > 0.99999f && fabsf(other[3] - made.inward[3]) < 1e-4f * (float)b->radius)
                break;
            at++;
        }
        if (at < f->edges && distance[at] <= away) continue;
        if (f->edge + at >= SB_NEAR_EDGES_MAX) {
            near->full = true;
            return;
        }
        near->edges[f->edge + at] = made;
        distance[at] = away;
        f->edges += at == f->edges;
    }
    near->edge_count += f->edges;
}

static void consider(const sb_sim *sim, const box *b, uint32_t index, sb_near *near)
{
    const sb_mirror *mirror = &sim->walls.mirrors.mirror[index];
    sb_vec3 moved = {0};
    sb_f4 velocity = {0};
    if (mirror->moving != UINT32_MAX) {
        const sb_moving_body *body = &sim->walls.moving[mirror->moving];
        moved = sb_scale(body->direction, body->displacement / sim->space.quantum);
        velocity = (sb_f4){(float)body->velocity.x, (float)body->velocity.y, (float)body->velocity.z, 0};
    }
    const double level = mirror->distance + sb_dot(mirror->normal, moved);
    const double above = sb_dot(mirror->normal, b->middle) - level;
    const double half =
        fabs(mirror->normal.x) * b->half.x + fabs(mirror->normal.y) * b->half.y + fabs(mirror->normal.z) * b->half.z;
    const double support = (double)sim->constant.support / sim->space.quantum;
    if (above - half > support || above + half < -support) return;
    if (mirror->edges > 0 && sb_mirrors_distance(&sim->walls.mirrors, mirror, sb_sub(b->middle, moved)) > b->radius)
        return;
    if (near->count == SB_NEAR_MAX) {
        near->full = true;
        return;
    }
    near->moves |= mirror->moving != UINT32_MAX;
    sb_near_facet *f = &near->facet[near->count++];
    *f = (sb_near_facet){.plane = {(float)mirror->normal.x, (float)mirror->normal.y, (float)mirror->normal.z,
                                   (float)(level - sb_dot(mirror->normal, b->corner))},
                         .mirror = index,
                         .both = mirror->both,
                         .velocity = velocity};
    add_edges(sim, b, moved, mirror, near, f);
}

/* How far a facet has moved along a normal. */
static double moved_along(const sb_sim *sim, const sb_mirror *facet, sb_vec3 normal)
{
    if (facet->moving == UINT32_MAX) return 0;
    const sb_moving_body *moving = &sim->walls.moving[facet->moving];
    return sb_dot(normal, moving->direction) * moving->displacement / sim->space.quantum;
}

/* Whether some corner of facet a lies before the plane of facet b, where both are now. */
static bool before(const sb_sim *sim, const sb_near_facet *a, const sb_near_facet *b)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    const sb_mirror *of = &m->mirror[a->mirror], *plane = &m->mirror[b->mirror];
    const double eps = BEHIND * (double)sim->constant.spacing / sim->space.quantum -
                       moved_along(sim, of, plane->normal) + moved_along(sim, plane, plane->normal);
    for (uint32_t k = of->edge; k < of->edge + of->edges; k++)
        if (sb_dot(plane->normal, m->edge[k].from) > plane->distance + eps) return true;
    return of->edges == 0;
}

/* See sb_near.sectors. along: the cosine between the normals. */
static float sectors_of(float along)
{
    if (fabsf(along) < SB_FACETS_SQUARE) return 2;
    return along < PARALLEL ? INFINITY : (float)M_PI / acosf(-along);
}

static void relate(const sb_sim *sim, sb_near *near)
{
    near->oblique = near->meeting = near->skew = false;
    for (size_t a = 0; a < near->count; a++) {
        near->blunt[a] = false;
        for (size_t b = 0; b < near->count; b++) {
            const sb_near_facet *one = &near->facet[a], *other = &near->facet[b];
            const float along = sb_sum3(one->plane * other->plane);
            near->meets[a][b] = a != b && along < SB_BENT && (one->both || other->both || before(sim, one, other)) &&
                                (one->both || other->both || before(sim, other, one));
            near->meeting |= near->meets[a][b];
            near->sectors[a][b] = near->meets[a][b] ? sectors_of(along) : 0;
            near->blunt[a] |= near->sectors[a][b] < 2 && near->sectors[a][b] > SB_SECTORS_LEAST;
            const bool square = fabsf(along) < SB_FACETS_SQUARE;
            near->oblique |= near->meets[a][b] && !square && !(along < OPPOSITE);
            near->skew |= near->meets[a][b] && !square;
        }
    }
    near->simple = !near->oblique;
}

void sb_mirrors_near(const sb_sim *sim, const sb_group *group, sb_f4 low, sb_f4 high, sb_near *near)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    near->count = near->edge_count = 0;
    near->full = near->moves = false;
    size_t end, at = sb_mirrors_of_block(sim, sim->state.position[group->first], &end);
    if (at == end && m->moving_count == 0) return;
    const sb_vec3 lower = sb_vec((double)low[0], (double)low[1], (double)low[2]);
    const sb_vec3 upper = sb_vec((double)high[0], (double)high[1], (double)high[2]);
    box b = {.corner = sb_vec((double)group->corner[0], (double)group->corner[1], (double)group->corner[2])};
    b.middle = sb_add(b.corner, sb_scale(sb_add(lower, upper), 0.5));
    b.half = sb_scale(sb_sub(upper, lower), 0.5);
    b.radius = sb_norm(b.half) + (double)sim->constant.support / sim->space.quantum;
    for (; at < end; at++) consider(sim, &b, m->entry[at].mirror, near);
    for (size_t k = 0; k < m->moving_count; k++) consider(sim, &b, m->moving[k], near);
    relate(sim, near);
}

/* The box of a block that water fills. */
static box box_of(const sb_sim *sim, uint64_t code)
{
    const uint64_t mask = ((uint64_t)1 << 21) - 1;
    const double size = (double)((uint64_t)2 << sim->space.shift), half = 0.5 * size;
    const bool flat = sim->constant.dimension == 2;
    box b = {.corner =
                 sb_vec(size * (double)(code & mask), size * (double)(code >> 21 & mask), size * (double)(code >> 42)),
             .half = sb_vec(half, flat ? 0 : half, half)};
    if (flat) b.corner.y = (0 - sim->space.origin.y) * (1 / sim->space.quantum);
    b.middle = sb_add(b.corner, b.half);
    b.radius = sb_norm(b.half) + (double)sim->constant.support / sim->space.quantum;
    return b;
}

/* Whether there are too many facets near a box. found: the entries [at, end) of its block. */
static bool is_full(const sb_sim *sim, const box *b, size_t at, size_t end, sb_near *near)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    near->count = near->edge_count = 0;
    near->full = false;
    for (size_t k = at; k < end; k++) consider(sim, b, m->entry[k].mirror, near);
    for (size_t k = 0; k < m->moving_count; k++) consider(sim, b, m->moving[k], near);
    return near->full;
}

/* Whether there are too many near some single place in a block, so that dividing a group does not help. *place: it. */
static bool is_crowded(const sb_sim *sim, const box *b, size_t at, size_t end, sb_near *near, sb_vec3 *place)
{
    enum { PLACES = 4 }; /* along one axis */
    if (!is_full(sim, b, at, end, near)) return false;
    const int layers = sim->constant.dimension == 2 ? 1 : PLACES;
    const sb_vec3 step = sb_scale(b->half, 2.0 / PLACES);
    for (int k = 0; k < PLACES * PLACES * layers; k++) {
        box one = {.corner = b->corner, .radius = (double)sim->constant.support / sim->space.quantum};
        one.middle = sb_sub(b->middle, b->half);
        one.middle.x += (k % PLACES + 0.5) * step.x;
        one.middle.y += (k / PLACES / PLACES + 0.5) * step.y;
        one.middle.z += (k / PLACES % PLACES + 0.5) * step.z;
        if (!is_full(sim, &one, at, end, near)) continue;
        *place = one.middle;
        return true;
    }
    return false;
}

int sb_mirrors_crowded(const sb_sim *sim, size_t *count, sb_vec3 *place)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    sb_near *near = sb_alloc(1, sizeof *near);
    if (!near) return -1;
    *count = 0;
    for (size_t at = 0, end = 0; at < m->entries; at = end) {
        while (end < m->entries && m->entry[end].block == m->entry[at].block) end++;
        const box b = box_of(sim, m->entry[at].block);
        sb_vec3 found;
        if (is_crowded(sim, &b, at, end, near, &found) && (*count)++ == 0)
            *place = sb_add(sim->space.origin, sb_scale(found, sim->space.quantum));
    }
    sb_free(near);
    return 0;
}
