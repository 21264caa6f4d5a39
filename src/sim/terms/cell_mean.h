/* The mean of a tensor over the particles around each particle, by way of cells: one sum per cell, and for a particle
   the sums of the 27 (2D: 9) cells around it, weighted by the quadratic B-spline of its place between their middles.
   The standard deviation of the weights along an axis is h/sqrt(3), with the cells' edge h. It costs less than one
   loop over pairs.

   The cells are fixed in space: the mean of a water body that is shifted by a part of a cell changes slightly. Walls
   do not reflect the tensor. */
#ifndef SB_SIM_CELL_MEAN_H
#define SB_SIM_CELL_MEAN_H

#include "sim/simulation.h"

/* Replaces the tensors xx (n values) and rest (n and ghosts: yy, xy, xz, yz) of all owned particles by their means.
   Records carry xx, and the ghosts of both are up to date; afterwards they are not. Returns 0, or -1 without memory. */
int sb_cell_mean(sb_sim *sim, float *xx, sb_f4 *rest);

#endif
