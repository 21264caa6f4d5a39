/* Finds vertices that lie at the same place. Private to src/geometry/mesh*.c. */
#ifndef SB_GEOMETRY_MESH_WELD_H
#define SB_GEOMETRY_MESH_WELD_H

#include "geometry/mesh/mesh.h"

/* Sets first[i] to the lowest vertex at exactly the place of vertex i (-0 equals 0). Returns -1 without memory. */
int sb_mesh_find_twins(const sb_mesh *mesh, uint32_t *first);

/* Whether the triangle has no significant area: it is a point, a line, or thinner than 1e-12 of its length. */
bool sb_mesh_is_degenerate(sb_vec3 a, sb_vec3 b, sb_vec3 c);

#endif
