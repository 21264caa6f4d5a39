/* Factors on the wall volume of a boundary particle, psi_b = rho_0 gamma curvature_factor / sum_k W_bk over the
   boundary particles k within the support radius, b included, with which sums over boundary particles give the area of
   walls. The drag of walls uses them where walls reflect the water. */
#ifndef SB_PHYSICS_WALL_VOLUME_H
#define SB_PHYSICS_WALL_VOLUME_H

#include "physics/kernels/kernel.h"

/* Returns the gamma with which boundary particles that lie `offset` behind a plane wall keep a lattice of fluid
   particles at rest at any uniform pressure: sum_j m 2 grad W_ij + B_i = 0 in the lattice's layers, by least squares.
   support, offset and the spacing of the boundary particles are in particle spacings of the water. */
double sb_wall_gamma(const sb_kernel *kernel, int dimension, double support, double offset, double spacing);

/* Returns the ratio of the wall volume where the boundary surface is curved to the wall volume on a plane. curvature
   is s_b = sum_k W_bk (x_k - x_b).n_b / (h sum_k W_bk) over those k whose normals do not oppose n_b (the unit normal
   of b, towards the water). It is negative on convex walls: -0.13 at a straight edge, -0.19 at a corner of three
   faces. */
double sb_wall_curvature_factor(double curvature);

/* Returns whether k is included in the curvature of b, given the scalar product of their normals. This excludes the
   far face of a thin wall. */
static inline int sb_wall_curvature_includes(double normals)
{
    return normals > -0.1;
}

#endif
