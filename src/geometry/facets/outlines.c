/* Coplanar triangles of a mesh merged into convex polygons: an edge between two of them is removed if the polygon stays
   convex [Hertel & Mehlhorn 1983]. */
#include "geometry/facets/outlines.h"
#include "base/memory.h"
#include "geometry/mesh/edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CORNERS_MAX = 512 }; /* straight ones included: the surface of a terrain has them by the hundred */

/* Sines of the angles up to which facets are coplanar, and corners straight. */
static const double FLAT = 1e-5, STRAIGHT = 1e-7;

typedef struct polygon {
    uint32_t count; /* 0: merged into another */
    uint32_t *vertex;
    uint32_t grew; /* in which round it last grew */
} polygon;

/* A corner of two polygons side by side: its vertex, and its place in one of them; those of the other begin at
   OTHER. */
typedef struct corner {
    uint32_t vertex, place;
} corner;

enum { OTHER = 2 * CORNERS_MAX };

typedef struct merger {
    const sb_mesh *mesh;
    polygon *polygon; /* by triangle */
    uint32_t *of;     /* triangle -> polygon */
    sb_vec3 *normal;  /* of triangles */
} merger;

static uint32_t polygon_of(merger *m, uint32_t triangle)
{
    while (m->of[triangle] != triangle) triangle = m->of[triangle] = m->of[m->of[triangle]];
    return triangle;
}

/* Whether an outline is convex at those corners whose neighbours are others than in their own polygon, which is
   convex. */
static bool convex(const merger *m, const corner *at, uint32_t count, sb_vec3 normal)
{
    for (uint32_t k = 0; k < count; k++) {
        const corner first = at[k], middle = at[k + 1 < count ? k + 1 : k + 1 - count],
                     last = at[k + 2 < count ? k + 2 : k + 2 - count];
        if (middle.place == first.place + 1 && last.place == middle.place + 1) continue;
        const sb_vec3 x = m->mesh->vertices[middle.vertex];
        const sb_vec3 a = sb_sub(x, m->mesh->vertices[first.vertex]), b = sb_sub(m->mesh->vertices[last.vertex], x);
        const double turn = sb_dot(normal, sb_cross(a, b)), size = sb_norm(a) * sb_norm(b);
        if (turn < -STRAIGHT * size || (turn < STRAIGHT * size && sb_dot(a, b) < 0)) return false;
    }
    return true;
}

/* Removes corners at which an outline turns back on itself: polygons that share several edges in a row are joined by
   one of them, and the others remain. Returns the number of corners left. */
static uint32_t cut_spikes(corner *at, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count; k++) { /* of a spike go the tip and one of its two equal neighbours */
        if (kept >= 2 && at[kept - 2].vertex == at[k].vertex)
            kept--;
        else
            at[kept++] = at[k];
    }
    uint32_t first = 0;
    while (kept - first >= 3) { /* where the outline closes */
        if (at[first + 1].vertex == at[kept - 1].vertex)
            first++, kept--;
        else if (at[kept - 2].vertex == at[first].vertex)
            kept -= 2;
        else
            break;
    }
    memmove(at, at + first, (kept - first) * sizeof *at);
    return kept - first;
}

/* The corners of two polygons that share the edge from vertex `low` to `high`, one after the other. Returns their
   number, 0 if they do not share it. */
static uint32_t side_by_side(const polygon *p, const polygon *q, uint32_t low, uint32_t high, corner *joined)
{
    uint32_t i = 0, j = 0, n = 0;
    while (i < p->count && !((p->vertex[i] == low && p->vertex[(i + 1) % p->count] == high) ||
                             (p->vertex[i] == high && p->vertex[(i + 1) % p->count] == low)))
        i++;
    while (j < q->count && q->vertex[j] != p->vertex[i]) j++;
    if (i == p->count || j == q->count) return 0;
    for (uint32_t k = 1; k <= p->count; k++) joined[n++] = (corner){p->vertex[(i + k) % p->count], k};
    for (uint32_t k = 1; k + 1 < q->count; k++) joined[n++] = (corner){q->vertex[(j + k) % q->count], OTHER + k};
    return n;
}

/* Merges two polygons across the edge from vertex `low` to `high`, if they are coplanar and the result is convex. What
   has not grown since the last round was tried then. Returns whether it did, or -1 without memory. */
static int merge(merger *m, uint32_t one, uint32_t other, uint32_t low, uint32_t high, uint32_t round)
{
    const uint32_t a = polygon_of(m, one), b = polygon_of(m, other);
    const sb_vec3 n = m->normal[a];
    polygon *p = &m->polygon[a], *q = &m->polygon[b];
    if (a == b || (p->grew + 1 < round && q->grew + 1 < round)) return 0;
    if (sb_norm(sb_cross(n, m->normal[b])) > FLAT || sb_dot(n, m->normal[b]) < 0) return 0;
    corner joined[2 * CORNERS_MAX];
    const uint32_t count = cut_spikes(joined, side_by_side(p, q, low, high, joined));
    if (count < 3 || count > CORNERS_MAX || !convex(m, joined, count, n)) return 0;
    uint32_t *vertex = sb_alloc(count, sizeof *vertex);
    if (!vertex) return -1;
    for (uint32_t k = 0; k < count; k++) vertex[k] = joined[k].vertex;
    sb_free(p->vertex);
    sb_free(q->vertex);
    *p = (polygon){count, vertex, round};
    *q = (polygon){0};
    m->of[b] = a;
    return 1;
}

/* Tries each edge once. Returns as merge. */
static int merge_some(merger *m, const sb_mesh_edges *edges, uint32_t round)
{
    int merged = 0;
    for (size_t e = 0, end; e < edges->count && merged >= 0; e = end) {
        end = sb_mesh_edge_run(edges, e);
        const sb_mesh_edge *users = edges->edges + e;
        if (end - e != 2 || users[0].forward == users[1].forward) continue;
        const int one = merge(m, users[0].triangle, users[1].triangle, users[0].low, users[0].high, round);
        merged = one < 0 ? -1 : merged | one;
    }
    return merged;
}

/* Polygons that have grown may fit together where they did not before. */
static int merge_all(merger *m)
{
    sb_mesh_edges edges;
    if (sb_mesh_find_edges(m->mesh, &edges) != 0) return -1;
    int merged = 1;
    for (uint32_t round = 1; merged == 1; round++) merged = merge_some(m, &edges, round);
    sb_mesh_edges_free(&edges);
    return merged;
}

/* Appends a polygon. Straight corners stay: what lies beyond may differ on both sides of them. */
static int append(sb_outlines *out, const merger *m, const polygon *p, sb_vec3 normal)
{
    if (sb_grow((void **)&out->outline, &out->capacity, out->count + 1, sizeof *out->outline) != 0) return -1;
    sb_outline *o = &out->outline[out->count];
    *o = (sb_outline){.normal = normal, .corner = sb_alloc(p->count, sizeof *o->corner)};
    if (!o->corner) return -1;
    out->count++;
    const sb_vec3 *at = m->mesh->vertices;
    for (uint32_t k = 0; k < p->count; k++) o->corner[o->count++] = at[p->vertex[k]];
    return 0;
}

static int start(merger *m)
{
    const size_t n = m->mesh->triangle_count;
    m->polygon = sb_alloc(n, sizeof *m->polygon);
    m->of = sb_alloc(n, sizeof *m->of);
    m->normal = sb_alloc(n, sizeof *m->normal);
    if (!m->polygon || !m->of || !m->normal) return -1;
    for (size_t t = 0; t < n; t++) {
        const uint32_t *v = m->mesh->triangles[t];
        const sb_vec3 *at = m->mesh->vertices;
        m->of[t] = (uint32_t)t;
        m->normal[t] = sb_cross(sb_sub(at[v[1]], at[v[0]]), sb_sub(at[v[2]], at[v[0]]));
        if (!(sb_norm(m->normal[t]) > 0)) continue;
        m->normal[t] = sb_normalize(m->normal[t]);
        m->polygon[t].vertex = sb_alloc(3, sizeof(uint32_t));
        if (!m->polygon[t].vertex) return -1;
        m->polygon[t].count = 3;
        memcpy(m->polygon[t].vertex, v, 3 * sizeof *v);
    }
    return 0;
}

int sb_outlines_of_mesh(const sb_mesh *mesh, sb_outlines *out)
{
    merger m = {.mesh = mesh};
    int status = start(&m);
    if (status == 0) status = merge_all(&m);
    for (size_t t = 0; t < mesh->triangle_count && m.polygon; t++) {
        if (status == 0 && m.polygon[t].count > 0) status = append(out, &m, &m.polygon[t], m.normal[t]);
        sb_free(m.polygon[t].vertex);
    }
    sb_free(m.polygon);
    sb_free(m.of);
    sb_free(m.normal);
    return status;
}

/* ---- 2D ---- */

/* The section of a triangle with y = 0. Returns false if there is none. */
static bool cut(const sb_mesh *mesh, size_t t, sb_vec3 end[2])
{
    int found = 0;
    for (int k = 0; k < 3; k++) {
        const sb_vec3 a = mesh->vertices[mesh->triangles[t][k]], b = mesh->vertices[mesh->triangles[t][(k + 1) % 3]];
        if ((a.y < 0) == (b.y < 0)) continue;
        const double share = a.y / (a.y - b.y);
        end[found++] = sb_vec(a.x + share * (b.x - a.x), 0, a.z + share * (b.z - a.z));
    }
    return found == 2 && sb_norm(sb_sub(end[1], end[0])) > 0;
}

/* Joins a segment with earlier ones that continue it in a straight line; these are removed from the list. */
static void join(sb_outlines *out, sb_vec3 end[2], sb_vec3 normal, double near)
{
    for (size_t k = out->count; k-- > 0;) {
        sb_outline *o = &out->outline[k];
        if (sb_dot(o->normal, normal) < 0 || sb_norm(sb_cross(o->normal, normal)) > FLAT) continue;
        int e = 0;
        while (e < 2 && !(sb_norm(sb_sub(o->corner[e], end[1 - e])) < near)) e++;
        if (e == 2) continue;
        end[1 - e] = o->corner[1 - e];
        sb_free(o->corner);
        memmove(o, o + 1, (--out->count - k) * sizeof *o);
        k = out->count; /* longer, it may reach others */
    }
}

int sb_outlines_of_section(const sb_mesh *mesh, double spacing, sb_outlines *out)
{
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        sb_vec3 end[2];
        const uint32_t *v = mesh->triangles[t];
        sb_vec3 n = sb_cross(sb_sub(mesh->vertices[v[1]], mesh->vertices[v[0]]),
                             sb_sub(mesh->vertices[v[2]], mesh->vertices[v[0]]));
        n.y = 0;
        if (!cut(mesh, t, end) || !(sb_norm(n) > 0)) continue;
        n = sb_normalize(n);
        /* From end 0 to end 1 the water lies to the same side for all segments. */
        const sb_vec3 along = sb_vec(n.z, 0, -n.x);
        if (sb_dot(along, sb_sub(end[1], end[0])) < 0) {
            const sb_vec3 first = end[0];
            end[0] = end[1];
            end[1] = first;
        }
        join(out, end, n, 1e-6 * spacing);
        if (sb_grow((void **)&out->outline, &out->capacity, out->count + 1, sizeof *out->outline) != 0) return -1;
        sb_outline *o = &out->outline[out->count];
        *o = (sb_outline){.count = 2, .normal = n, .corner = sb_alloc(2, sizeof *o->corner)};
        if (!o->corner) return -1;
        out->count++;
        o->corner[0] = end[0];
        o->corner[1] = end[1];
    }
    return 0;
}

void sb_outlines_free(sb_outlines *outlines)
{
    for (size_t k = 0; k < outlines->count; k++) sb_free(outlines->outline[k].corner);
    sb_free(outlines->outline);
    *outlines = (sb_outlines){0};
}
