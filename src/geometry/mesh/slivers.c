/* Triangles that are nearly a line, as simplification leaves them along straight edges: they have no normal, and hide
   from each other the triangles on both of their sides. */
#include "geometry/mesh/slivers.h"
#include "base/memory.h"
#include "geometry/mesh/edges.h"

#include <math.h>
#include <string.h>

enum { ROUNDS_MAX = 32 };

/* Whether the corner opposite of a triangle's longest edge lies on that edge, and is no end of it. *edge: the corner
   from which this edge begins. */
static bool is_sliver(const sb_mesh *mesh, size_t t, double low, int *edge)
{
    const uint32_t *v = mesh->triangles[t];
    double longest = 0;
    for (int k = 0; k < 3; k++) {
        const double length = sb_norm(sb_sub(mesh->vertices[v[(k + 1) % 3]], mesh->vertices[v[k]]));
        if (length <= longest) continue;
        longest = length;
        *edge = k;
    }
    const sb_vec3 from = mesh->vertices[v[*edge]], to = mesh->vertices[v[(*edge + 1) % 3]];
    const sb_vec3 out = sb_sub(mesh->vertices[v[(*edge + 2) % 3]], from), along = sb_normalize(sb_sub(to, from));
    const double at = sb_dot(out, along);
    return sb_norm(sb_madd(out, -at, along)) < low && at > low && at < longest - low;
}

/* The other triangle at the edge from a to b of triangle t, which may be missing among the edges; SIZE_MAX if there is
   none, or if there are several. *alone: there is none. */
static size_t beyond(const sb_mesh_edges *edges, size_t t, uint32_t a, uint32_t b, bool *alone)
{
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t first = 0, end = edges->count, others = 0, found = SIZE_MAX;
    while (first < end) {
        const size_t middle = (first + end) / 2;
        const sb_mesh_edge *e = edges->edges + middle;
        if (e->low < low || (e->low == low && e->high < high))
            first = middle + 1;
        else
            end = middle;
    }
    for (const sb_mesh_edge *e = edges->edges + first;
         e < edges->edges + edges->count && e->low == low && e->high == high; e++) {
        if (e->triangle == t) continue;
        others++;
        if (e->forward == (b < a)) found = e->triangle;
    }
    *alone = others == 0;
    return others == 1 ? found : SIZE_MAX;
}

/* Divides the triangle beyond a sliver's long edge at the corner on that edge, so that the sliver can be left out. One
   at a border is left out as it is. A triangle changes once. Returns whether one did. */
static bool remove_one(sb_mesh *mesh, const sb_mesh_edges *edges, size_t t, int edge, bool *changed, bool *gone)
{
    const uint32_t *v = mesh->triangles[t];
    const uint32_t a = v[edge], b = v[(edge + 1) % 3], middle = v[(edge + 2) % 3];
    bool alone = false;
    const size_t other = beyond(edges, t, a, b, &alone);
    if (alone) return gone[t] = changed[t] = true;
    if (other == SIZE_MAX || changed[other]) return false;
    uint32_t *u = mesh->triangles[other], whole[3];
    memcpy(whole, u, sizeof whole);
    for (int k = 0; k < 3; k++) {
        u[k] = whole[k] == a ? middle : whole[k];
        mesh->triangles[t][k] = whole[k] == b ? middle : whole[k];
    }
    return changed[t] = changed[other] = true;
}

static size_t remove_some(sb_mesh *mesh, const sb_mesh_edges *edges, double low, bool *changed, bool *gone)
{
    size_t removed = 0, kept = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        int edge = 0;
        if (!changed[t] && is_sliver(mesh, t, low, &edge)) removed += remove_one(mesh, edges, t, edge, changed, gone);
    }
    for (size_t t = 0; t < mesh->triangle_count; t++)
        if (!gone[t]) memmove(mesh->triangles[kept++], mesh->triangles[t], sizeof *mesh->triangles);
    mesh->triangle_count = kept;
    return removed;
}

sb_status sb_mesh_remove_slivers(sb_mesh *mesh, double low, sb_error *error)
{
    size_t removed = 1;
    for (int round = 0; round < ROUNDS_MAX && removed > 0; round++) {
        sb_mesh_edges edges;
        bool *changed = sb_alloc(mesh->triangle_count, sizeof *changed);
        bool *gone = sb_alloc(mesh->triangle_count, sizeof *gone);
        const bool enough = changed && gone && sb_mesh_find_edges(mesh, &edges) == 0;
        if (enough) removed = remove_some(mesh, &edges, low, changed, gone);
        if (enough) sb_mesh_edges_free(&edges);
        sb_free(changed);
        sb_free(gone);
        if (!enough) return sb_fail_memory(error, "a mesh");
    }
    return SB_OK;
}
