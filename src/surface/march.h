/* Marching cubes on the field at the nodes of the blocks. */
#ifndef SB_SURFACE_MARCH_H
#define SB_SURFACE_MARCH_H

#include "base/status.h"
#include "surface/blocks.h"
#include "surface/water_mesh.h"

/* Makes the vertices, with velocity and pressure interpolated between particles by the field's kernel, and the
   triangles. Normals are not set. *mesh must be empty; on failure it may be incomplete, and the caller frees it in any
   case. */
sb_status sb_march(const sb_frame *frame, const sb_blocks *blocks, const float *value, sb_water_mesh *mesh,
                   sb_error *error);

#endif
