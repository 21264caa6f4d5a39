#include "sim/walls/mirrors.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cosines between normals: up to SQUARE of facets at right angles, from FACING on of those that face each other. */
static const float SQUARE = 1e-3f, FACING = -0.9999f;

/* In spacings: how far behind a plane water or a facet must be to count as behind it. */
static const double BEHIND = 0.05;

/* ---- creation ---- */

static sb_vec3 to_quanta(const sb_space *space, sb_vec3 at)
{
    return sb_scale(sb_sub(at, space->origin), 1 / space->quantum);
}

/* Adds a facet, moved by `shift` (m). Returns 0, or -1 without memory. */
static int add(sb_sim *sim, const sb_facets *facets, const sb_facet *f, sb_vec3 shift)
{
    sb_mirrors *m = &sim->walls.mirrors;
    if (sb_grow((void **)&m->mirror, &m->capacity, m->count + 1, sizeof *m->mirror) != 0 ||
        sb_grow((void **)&m->edge, &m->edge_capacity, m->edge_count + f->edges, sizeof *m->edge) != 0)
        return -1;
    const sb_vec3 on = sb_add(sb_scale(f->normal, f->distance), shift);
    m->mirror[m->count++] = (sb_mirror){.normal = f->normal,
                                        .distance = sb_dot(f->normal, to_quanta(&sim->space, on)),
                                        .body = f->body,
                                        .edge = (uint32_t)m->edge_count,
                                        .edges = f->edges,
                                        .moving = sim->walls.moving_of_body[f->body],
                                        .both = f->both,
                                        .shift = shift};
    for (uint32_t k = 0; k < f->edges; k++) {
        const sb_facet_edge *e = &facets->edges[f->edge + k];
        const sb_vec3 from = to_quanta(&sim->space, sb_add(e->from, shift));
        m->edge[m->edge_count++] = (sb_mirror_edge){
            from, to_quanta(&sim->space, sb_add(e->to, shift)), e->inward, sb_dot(e->inward, from), e->bend, e->wall};
    }
    return 0;
}

static double from_segment(sb_vec3 a, sb_vec3 b, sb_vec3 at)
{
    const sb_vec3 along = sb_sub(b, a), out = sb_sub(at, a);
    const double length2 = sb_dot(along, along);
    const double share = length2 > 0 ? fmin(fmax(sb_dot(along, out) / length2, 0), 1) : 0;
    return sb_norm(sb_madd(out, -share, along));
}

static double distance_from(const sb_mirrors *m, const sb_mirror *mirror, sb_vec3 at)
{
    const double above = fabs(sb_dot(mirror->normal, at) - mirror->distance);
    bool inside = true;
    double nearest = (double)INFINITY;
    for (uint32_t k = mirror->edge; k < mirror->edge + mirror->edges; k++) {
        const sb_mirror_edge *e = &m->edge[k];
        inside &= sb_dot(e->inward, at) >= e->distance;
        nearest = fmin(nearest, from_segment(e->from, e->to, at));
    }
    return inside ? above : nearest;
}

/* The range of blocks in which a mirror is within a support radius of a particle. */
static void block_range(const sb_sim *sim, const sb_mirror *mirror, int64_t low[3], int64_t high[3])
{
    const int shift = sim->space.shift;
    const double support = (double)sim->constant.support / sim->space.quantum;
    const double block = (double)((uint64_t)2 << shift);
    const sb_record first = sb_space_record(&sim->space, sim->model->min);
    const sb_record last = sb_space_record(&sim->space, sim->model->max);
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = (first[axis] >> shift >> 1) - 1, high[axis] = (last[axis] >> shift >> 1) + 1;
        double least = (double)INFINITY, most = -(double)INFINITY;
        for (uint32_t k = mirror->edge; k < mirror->edge + mirror->edges; k++) {
            const sb_mirror_edge *e = &sim->walls.mirrors.edge[k];
            const double from = axis == 0 ? e->from.x : axis == 1 ? e->from.y : e->from.z;
            const double to = axis == 0 ? e->to.x : axis == 1 ? e->to.y : e->to.z;
            least = fmin(least, fmin(from, to)), most = fmax(most, fmax(from, to));
        }
        if (mirror->edges == 0 || (sim->constant.dimension == 2 && axis == 1)) continue;
        low[axis] = (int64_t)fmax((double)low[axis], floor((least - support) / block));
        high[axis] = (int64_t)fmin((double)high[axis], floor((most + support) / block));
    }
    for (int axis = 0; axis < 3; axis++) low[axis] = low[axis] < 0 ? 0 : low[axis];
}

static uint64_t block_code(uint64_t x, uint64_t y, uint64_t z)
{
    return x | y << 21 | z << 42;
}

static int enter(sb_sim *sim, uint32_t index)
{
    sb_mirrors *m = &sim->walls.mirrors;
    const sb_mirror *mirror = &m->mirror[index];
    const double support = (double)sim->constant.support / sim->space.quantum;
    const double block = (double)((uint64_t)2 << sim->space.shift);
    const bool flat = sim->constant.dimension == 2;
    const double most = support + 0.5 * block * (flat ? sqrt(2) : sqrt(3));
    const double y_flat = to_quanta(&sim->space, (sb_vec3){0}).y;
    int64_t low[3], high[3];
    block_range(sim, mirror, low, high);
    for (int64_t z = low[2]; z <= high[2]; z++)
        for (int64_t y = low[1]; y <= high[1]; y++)
            for (int64_t x = low[0]; x <= high[0]; x++) {
                const sb_vec3 middle = sb_vec(((double)x + 0.5) * block, flat ? y_flat : ((double)y + 0.5) * block,
                                              ((double)z + 0.5) * block);
                if (fabs(sb_dot(mirror->normal, middle) - mirror->distance) > most ||
                    distance_from(m, mirror, middle) > most)
                    continue;
                if (sb_grow((void **)&m->entry, &m->entries_capacity, m->entries + 1, sizeof *m->entry) != 0) return -1;
                m->entry[m->entries++] = (sb_mirror_entry){block_code((uint64_t)x, (uint64_t)y, (uint64_t)z), index};
            }
    return 0;
}

static int compare(const void *a, const void *b)
{
    const sb_mirror_entry *x = a, *y = b;
    if (x->block != y->block) return x->block < y->block ? -1 : 1;
    return (x->mirror > y->mirror) - (x->mirror < y->mirror);
}

/* Adds a facet and its images beyond periodic sides. A facet without edges has no end: shifts within its plane lead to
   itself. */
static int add_all(sb_sim *sim, const sb_facets *facets, const sb_facet *f)
{
    const double period[3] = {(double)sim->space.period[0] * sim->space.quantum,
                              (double)sim->space.period[1] * sim->space.quantum,
                              (double)sim->space.period[2] * sim->space.quantum};
    const double normal[3] = {f->normal.x, f->normal.y, f->normal.z};
    int along[3];
    for (int axis = 0; axis < 3; axis++) along[axis] = period[axis] > 0 && (f->edges > 0 || normal[axis] != 0);
    for (int z = -along[2]; z <= along[2]; z++)
        for (int y = -along[1]; y <= along[1]; y++)
            for (int x = -along[0]; x <= along[0]; x++)
                if (add(sim, facets, f, sb_vec(x * period[0], y * period[1], z * period[2])) != 0) return -1;
    return 0;
}

sb_status sb_mirrors_create(sb_sim *sim, sb_error *error)
{
    sb_mirrors *m = &sim->walls.mirrors;
    const sb_facets *facets = &sim->model->facets;
    bool enough = true;
    for (size_t f = 0; f < facets->count && enough; f++) enough = add_all(sim, facets, &facets->facets[f]) == 0;
    m->moving = enough ? sb_alloc(m->count, sizeof *m->moving) : NULL;
    enough = m->moving != NULL;
    for (uint32_t k = 0; k < m->count && enough; k++)
        if (m->mirror[k].moving == UINT32_MAX)
            enough = enter(sim, k) == 0;
        else
            m->moving[m->moving_count++] = k;
    if (!enough) return sb_fail_memory(error, "facets of walls");
    if (m->entries > 0) qsort(m->entry, m->entries, sizeof *m->entry, compare);
    return SB_OK;
}

void sb_mirrors_destroy(sb_sim *sim)
{
    sb_mirrors *m = &sim->walls.mirrors;
    sb_free(m->mirror);
    sb_free(m->edge);
    sb_free(m->moving);
    sb_free(m->entry);
}

size_t sb_mirrors_bytes(const sb_sim *sim)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    return m->capacity * sizeof *m->mirror + m->edge_capacity * sizeof *m->edge + m->count * sizeof *m->moving +
           m->entries_capacity * sizeof *m->entry;
}

uint32_t sb_mirror_body(const sb_sim *sim, uint32_t mirror)
{
    return sim->walls.mirrors.mirror[mirror].body;
}

sb_f4 sb_mirror_velocity(const sb_sim *sim, uint32_t mirror)
{
    const uint32_t moving = sim->walls.mirrors.mirror[mirror].moving;
    if (moving == UINT32_MAX) return (sb_f4){0};
    const sb_vec3 v = sim->walls.moving[moving].velocity;
    return (sb_f4){(float)v.x, (float)v.y, (float)v.z, 0};
}

sb_vec3 sb_mirror_shift(const sb_sim *sim, uint32_t mirror)
{
    return sb_scale(sim->walls.mirrors.mirror[mirror].shift, -1);
}

/* ---- facets near a group ---- */

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
        const double away = from_segment(sb_add(e->from, moved), sb_add(e->to, moved), b->middle);
        if (away > b->radius) continue;
        const bool leans = e->bend == SB_BEND_CONCAVE && fabs(sb_dot(e->wall, mirror->normal)) > (double)SQUARE;
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
    if (mirror->edges > 0 && distance_from(&sim->walls.mirrors, mirror, sb_sub(b->middle, moved)) > b->radius) return;
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

/* How far plate a has moved ahead of plate b of the same paddle, along the normal of b's facet; 0 for other bodies. */
static double ahead(const sb_sim *sim, const sb_mirror *a, const sb_mirror *b)
{
    if (a->body == b->body || a->moving == UINT32_MAX || b->moving == UINT32_MAX ||
        sb_model_whole(sim->model, a->body) != sb_model_whole(sim->model, b->body))
        return 0;
    const sb_moving_body *one = &sim->walls.moving[a->moving], *other = &sim->walls.moving[b->moving];
    return sb_dot(b->normal, one->direction) * (one->displacement - other->displacement) / sim->space.quantum;
}

/* Whether some corner of facet a lies before the plane of facet b. */
static bool before(const sb_sim *sim, const sb_near_facet *a, const sb_near_facet *b)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    const sb_mirror *of = &m->mirror[a->mirror], *plane = &m->mirror[b->mirror];
    const double eps = BEHIND * (double)sim->constant.spacing / sim->space.quantum - ahead(sim, of, plane);
    for (uint32_t k = of->edge; k < of->edge + of->edges; k++)
        if (sb_dot(plane->normal, m->edge[k].from) > plane->distance + eps) return true;
    return of->edges == 0;
}

/* See sb_near.sectors. along: the cosine between the normals. */
static float sectors_of(float along)
{
    if (fabsf(along) < SQUARE) return 2;
    return along < FACING ? INFINITY : (float)M_PI / acosf(-along);
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
            const bool square = fabsf(along) < SQUARE, facing = along < -0.9f;
            /* Neighbours that bend by less do not hide each other. */
            near->oblique |= near->meets[a][b] && !square && !facing;
            near->skew |= near->meets[a][b] && !square;
        }
    }
    near->simple = !near->oblique;
}

size_t sb_mirrors_of_block(const sb_sim *sim, sb_record record, size_t *end)
{
    const sb_mirrors *m = &sim->walls.mirrors;
    const int shift = sim->space.shift + 1;
    const uint64_t code = block_code(record[0] >> shift, record[1] >> shift, record[2] >> shift);
    size_t at = 0, above = m->entries;
    while (at < above) {
        const size_t middle = (at + above) / 2;
        if (m->entry[middle].block < code)
            at = middle + 1;
        else
            above = middle;
    }
    for (*end = at; *end < m->entries && m->entry[*end].block == code;) ++*end;
    return at;
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
    if (flat) b.corner.y = to_quanta(&sim->space, (sb_vec3){0}).y;
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
