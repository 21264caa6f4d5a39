/* Finds which triangles of a mesh share which edge, and whether their orientation agrees. Private to
   src/geometry/mesh and sampling/surface.c. */
#ifndef SB_GEOMETRY_MESH_EDGES_H
#define SB_GEOMETRY_MESH_EDGES_H

#include "geometry/mesh/mesh.h"

/* One triangle's use of the edge between two vertices, low < high. */
typedef struct sb_mesh_edge {
    uint32_t low, high;
    uint32_t triangle;
    bool forward; /* the triangle traverses the edge from low to high */
} sb_mesh_edge;

typedef struct sb_mesh_edges {
    size_t count;
    sb_mesh_edge *edges; /* sorted by low, high, triangle: the users of one edge are adjacent */
    size_t flipped_count;
    bool *flipped; /* by triangle: it belongs to the smaller part of its surface with a different orientation */
} sb_mesh_edges;

/* Fills *edges. Degenerate triangles are skipped. Returns -1 without memory. */
int sb_mesh_find_edges(const sb_mesh *mesh, sb_mesh_edges *edges);
void sb_mesh_edges_free(sb_mesh_edges *edges);

/* Returns the end of the sequence of users of the edge of edges[begin]. */
static inline size_t sb_mesh_edge_run(const sb_mesh_edges *edges, size_t begin)
{
    const sb_mesh_edge *edge = edges->edges;
    size_t end = begin + 1;
    while (end < edges->count && edge[end].low == edge[begin].low && edge[end].high == edge[begin].high) ++end;
    return end;
}

#endif
