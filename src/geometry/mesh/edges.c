/* Finds a mesh's edges and the triangles whose orientation is opposite to that of their neighbours. */
#include "geometry/mesh/edges.h"

#include "base/memory.h"
#include "geometry/mesh/weld.h"

#include <stdlib.h>

/* The representative (leader) of a triangle's surface in a union-find, and whether the triangle is oriented opposite
   to it. */
typedef struct link {
    uint32_t leader;
    bool opposite;
} link;

static int compare_edges(const void *left, const void *right)
{
    const sb_mesh_edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static void collect_edges(const sb_mesh *mesh, const uint32_t *first, sb_mesh_edges *edges)
{
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t *corner = mesh->triangles[i];
        if (sb_mesh_is_degenerate(mesh->vertices[corner[0]], mesh->vertices[corner[1]], mesh->vertices[corner[2]]))
            continue;
        for (int k = 0; k < 3; ++k) {
            uint32_t from = first[corner[k]], to = first[corner[(k + 1) % 3]];
            bool forward = from < to;
            edges->edges[edges->count++] =
                (sb_mesh_edge){forward ? from : to, forward ? to : from, (uint32_t)i, forward};
        }
    }
    qsort(edges->edges, edges->count, sizeof *edges->edges, compare_edges);
}

/* Finds the leader of triangle i. A leader is its own leader. The links on the way are shortened. */
static link find_leader(link *links, uint32_t i)
{
    link found = {i, false};
    while (links[found.leader].leader != found.leader) {
        link *at = &links[found.leader];
        const link *next = &links[at->leader];
        if (next->leader != at->leader) *at = (link){next->leader, (bool)(at->opposite ^ next->opposite)};
        found = (link){at->leader, (bool)(found.opposite ^ at->opposite)};
    }
    return found;
}

/* Joins the surfaces of two neighbours. The lower leader stays, so that the numbering does not depend on the order. */
static void join(link *links, uint32_t a, uint32_t b, bool opposite)
{
    link one = find_leader(links, a), two = find_leader(links, b);
    if (one.leader == two.leader) return;
    bool between = one.opposite ^ two.opposite ^ opposite;
    if (one.leader < two.leader)
        links[two.leader] = (link){one.leader, between};
    else
        links[one.leader] = (link){two.leader, between};
}

/* Marks flipped triangles. Two triangles that share an edge traverse it in opposite directions if their orientation
   agrees. Edges with three or more triangles are ignored. */
static int find_flipped(size_t triangles, sb_mesh_edges *edges)
{
    link *links = sb_alloc_untouched(triangles, sizeof *links);
    uint32_t(*sides)[2] = sb_alloc(triangles, sizeof *sides);
    if (!links || !sides) {
        sb_free(links);
        sb_free(sides);
        return -1;
    }
    for (size_t i = 0; i < triangles; ++i) links[i] = (link){(uint32_t)i, false};
    for (size_t i = 0, end; i < edges->count; i = end) {
        const sb_mesh_edge *edge = edges->edges + i;
        end = sb_mesh_edge_run(edges, i);
        if (end - i == 2) join(links, edge[0].triangle, edge[1].triangle, edge[0].forward == edge[1].forward);
    }
    for (size_t i = 0; i < triangles; ++i) {
        link found = find_leader(links, (uint32_t)i);
        ++sides[found.leader][found.opposite];
    }
    for (size_t i = 0; i < triangles; ++i) {
        link found = find_leader(links, (uint32_t)i);
        bool smaller_is_opposite = sides[found.leader][1] <= sides[found.leader][0];
        edges->flipped[i] = found.opposite == smaller_is_opposite;
        edges->flipped_count += edges->flipped[i];
    }
    sb_free(links);
    sb_free(sides);
    return 0;
}

int sb_mesh_find_edges(const sb_mesh *mesh, sb_mesh_edges *edges)
{
    sb_mesh_edges made = {0};
    uint32_t *first = sb_alloc_untouched(mesh->vertex_count, sizeof *first);
    made.edges = sb_alloc_untouched(mesh->triangle_count, 3 * sizeof *made.edges);
    made.flipped = sb_alloc(mesh->triangle_count, sizeof *made.flipped);
    int failed = !first || !made.edges || !made.flipped || sb_mesh_find_twins(mesh, first);
    if (!failed) {
        collect_edges(mesh, first, &made);
        failed = find_flipped(mesh->triangle_count, &made);
    }
    sb_free(first);
    if (failed)
        sb_mesh_edges_free(&made);
    else
        *edges = made;
    return failed ? -1 : 0;
}

void sb_mesh_edges_free(sb_mesh_edges *edges)
{
    sb_free(edges->edges);
    sb_free(edges->flipped);
    *edges = (sb_mesh_edges){0};
}
