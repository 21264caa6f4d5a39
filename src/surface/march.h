/* Marching cubes on the field at the nodes of the blocks. */
#ifndef SB_SURFACE_MARCH_H
#define SB_SURFACE_MARCH_H

#include "base/status.h"
#include "surface/blocks.h"
#include "surface/water_mesh.h"

/* Makes the vertices, with velocity and pressure interpolated between particles by the field's kernel, and the
   triangles. Normals are not set. *mesh must be empty; on failure it may be incomplete, and the caller frees it in any
   case. *node: of each vertex the node of the grid, of all blocks one after another, that is in the water on its edge;
   the caller frees it with sb_free; NULL on failure. */
sb_status sb_march(const sb_frame *frame, const sb_blocks *blocks, const float *value, sb_water_mesh *mesh,
                   uint32_t **node, sb_error *error);

#endif
