/* Smoothing of a mesh that keeps the volume of each connected part. */
#ifndef SB_SURFACE_SMOOTH_H
#define SB_SURFACE_SMOOTH_H

#include "base/status.h"
#include "surface/water_mesh.h"

/* Smooths the positions by `rounds` rounds of Taubin's filter (1995), and sets the normals. After each second round
   every connected part is moved along its normals, so that its volume stays that before. most: the most that one such
   move may be, m. SB_FAILED if memory runs out. */
sb_status sb_water_mesh_smooth(sb_water_mesh *mesh, int rounds, double most, sb_error *error);

#endif
