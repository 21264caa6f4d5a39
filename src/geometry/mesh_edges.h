/* Which triangles of a mesh meet at which edge, and which of them face the same way. Private to
   src/geometry/mesh*.c. */
#ifndef SB_GEOMETRY_MESH_EDGES_H
#define SB_GEOMETRY_MESH_EDGES_H

#include "geometry/mesh.h"

/* One triangle's use of the edge between two vertices, low < high. */
typedef struct sb_mesh_edge {
    uint32_t low, high;
    uint32_t triangle;
    bool forward; /* the triangle runs from low to high */
} sb_mesh_edge;

typedef struct sb_mesh_edges {
    size_t count;
    sb_mesh_edge *edges; /* sorted by low, high, triangle: the users of an edge stand together */
    size_t flipped_count;
    bool *flipped; /* by triangle: it belongs to the lesser part of its surface */
} sb_mesh_edges;

/* Degenerate triangles have no edges here. Returns -1 without memory. */
int sb_mesh_find_edges(const sb_mesh *mesh, sb_mesh_edges *edges);
void sb_mesh_edges_free(sb_mesh_edges *edges);

/* End of the run of users that share the edge of edges[begin]. */
static inline size_t sb_mesh_edge_run(const sb_mesh_edges *edges, size_t begin)
{
    const sb_mesh_edge *edge = edges->edges;
    size_t end = begin + 1;
    while (end < edges->count && edge[end].low == edge[begin].low && edge[end].high == edge[begin].high) ++end;
    return end;
}

#endif
