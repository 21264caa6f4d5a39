/* Simplifies meshes whose details are finer than what is to be resolved. */
#ifndef SB_GEOMETRY_SIMPLIFY_H
#define SB_GEOMETRY_SIMPLIFY_H

#include "geometry/mesh/mesh.h"

/* Makes a mesh with fewer triangles on some of the vertices of `mesh`: no vertex of either mesh, and no
   middle of an edge or a triangle, is farther than `tolerance` (m) from the other. The orientation is kept, and closed
   surfaces stay closed. Edges are collapsed by the library meshoptimizer. Leaves *simple empty, without an error, if
   there is nothing to leave out. The result is the same for any number of threads. */
sb_status sb_mesh_simplify(const sb_mesh *mesh, sb_role role, double tolerance, sb_mesh *simple, sb_error *error);

#endif
