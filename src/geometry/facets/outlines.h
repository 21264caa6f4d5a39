/* Outlines of facets: convex polygons of the coplanar triangles of a mesh, in 2D segments. */
#ifndef SB_GEOMETRY_OUTLINES_H
#define SB_GEOMETRY_OUTLINES_H

#include "geometry/mesh/mesh.h"

/* A convex polygon under construction; in 2D a segment. */
typedef struct sb_outline {
    size_t count;
    sb_vec3 *corner; /* count, counter-clockwise seen from the water */
    sb_vec3 normal;
} sb_outline;

typedef struct sb_outlines {
    size_t count, capacity;
    sb_outline *outline;
} sb_outlines;

/* Merges the triangles of a mesh into convex polygons. Returns 0, or -1 without memory. */
int sb_outlines_of_mesh(const sb_mesh *mesh, sb_outlines *out);
/* The segments in which the plane y = 0 cuts a mesh. */
int sb_outlines_of_section(const sb_mesh *mesh, double spacing, sb_outlines *out);
void sb_outlines_free(sb_outlines *outlines);

#endif
