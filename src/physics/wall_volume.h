/* What one boundary particle stands for: psi_b = gamma rho_0 bend / sum_k W_bk, k over the boundary particles in
   reach, b included [A12], [S16, eq. 30 with gamma and bend]. */
#ifndef SB_PHYSICS_WALL_VOLUME_H
#define SB_PHYSICS_WALL_VOLUME_H

#include "physics/kernel.h"

/* The gamma with which a sheet `offset` spacings behind a plane wall best bears a lattice at rest at any pressure:
   sum_j m 2 grad W_ij + B_i = 0 in its layers, least squares. support, and spacing of the boundary particles: spacings
   of the water. */
double sb_wall_gamma(const sb_kernel *kernel, int dimension, double support, double offset, double spacing);

/* How many times as much as on a plane, where the sheet bends: bulge is sum_k W_bk (x_k - x_b).n_b / (h sum_k W_bk)
   over those k whose normals do not oppose n_b (the normal of b, unit, towards the water); negative on convex walls,
   -0.13 at a straight edge, -0.19 at a corner of three. */
double sb_wall_bend(double bulge);

/* Whether k counts in the bulge of b, by the product of their normals: not the far face of a thin wall. */
static inline int sb_wall_bends_with(double normals)
{
    return normals > -0.1;
}

#endif
