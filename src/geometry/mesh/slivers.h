/* Removes triangles that are nearly a line. */
#ifndef SB_GEOMETRY_SLIVERS_H
#define SB_GEOMETRY_SLIVERS_H

#include "geometry/mesh/mesh.h"

/* Removes the triangles one of whose corners is nearer than `low` (m) to the opposite edge, but not to its ends: the
   triangle beyond that edge is divided at that corner. The surface moves by less than `low`. */
sb_status sb_mesh_remove_slivers(sb_mesh *mesh, double low, sb_error *error);

#endif
