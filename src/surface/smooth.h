/* Smoothing of a mesh, after which each body of water has the volume of its particles. */
#ifndef SB_SURFACE_SMOOTH_H
#define SB_SURFACE_SMOOTH_H

#include "base/status.h"
#include "surface/water_mesh.h"
#include "surface/waters.h"

/* Smooths the positions by `rounds` rounds of Taubin's filter (1995), and sets the normals. After each second round and
   at the end the surfaces of each water are moved along their normals, so that it has the volume of its particles;
   spacing: theirs, m. most: the most that one such move may be, m. SB_FAILED if memory runs out. */
sb_status sb_water_mesh_smooth(sb_water_mesh *mesh, const sb_waters *waters, double spacing, int rounds, double most,
                               sb_error *error);

#endif
