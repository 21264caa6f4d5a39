/* Makes the surface of the water of a frame: field, marching cubes, smoothing. */
#ifndef SB_SURFACE_MAKE_H
#define SB_SURFACE_MAKE_H

#include "base/status.h"
#include "frame/frame.h"
#include "surface/water_mesh.h"

#define SB_WATER_MESH_CELL 0.5
#define SB_WATER_MESH_CELL_LEAST 0.25
#define SB_WATER_MESH_CELL_MOST 1.0
enum { SB_WATER_MESH_SMOOTH = 10, SB_WATER_MESH_SMOOTH_MOST = 1000 };

/* Makes the mesh of a frame of a run in three dimensions. cell: edge of the cells of the background grid in spacings,
   0.25 to 1. smooth: rounds of smoothing. The same bits for any number of threads. SB_BAD_INPUT for particles too far
   apart; SB_FAILED if memory runs out. A frame without particles makes an empty mesh. The caller frees the mesh. */
sb_status sb_water_mesh_make(const sb_frame *frame, double cell, int smooth, sb_water_mesh *mesh, sb_error *error);

#endif
