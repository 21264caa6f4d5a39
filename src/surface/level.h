/* The field whose level SB_LEVEL is the surface of the water: 1 inside of deep water, 0 far outside. */
#ifndef SB_SURFACE_LEVEL_H
#define SB_SURFACE_LEVEL_H

#include "surface/blocks.h"

/* Support radius of the field's kernel, in spacings. */
#define SB_LEVEL_REACH 2.0
#define SB_LEVEL 0.5F
#define SB_LEVEL_NORM (315 / (512 * 3.14159265358979323846))

/* W(r) of the kernel, in units of the spacing: 315 / (512 pi) (1 - r^2 / 4)^3, whose integral is 1 (Mueller et al.
   2003, "poly6"). */
double sb_level_kernel(double r);

/* The weight of a particle in the field, where `density` is the sum of the kernel over it and its neighbours. */
double sb_level_weight(double density);

/* Fills the blocks' weights and returns the field at the nodes, SB_BLOCK_NODES per block, x first. The field at a node
   is the sum of weight x kernel over the particles. NULL if memory runs out. The caller frees it with sb_free. */
float *sb_level_build(sb_blocks *blocks);

#endif
