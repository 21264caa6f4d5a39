/* Hyperviscosity (docs/method.md, M14a; docs/decisions/0095): it damps motion of the scale of the spacing, and waves
   far less than a viscosity does.

       dv_i/dt = -kappa sqrt(gD)/dr (L L v)_i,   (L f)_i = sum_j (f_i - f_j) |W'_ij|/r_ij over the same sum of a lattice
   without f

   L is a Laplacian times -dr^2, up to a factor [Brookshaw 1985]. A wave of the number k loses kappa in proportion to (k
   dr)^4. L is symmetric: momentum is conserved, and the energy falls by the sum of (L v)^2. Without gravity it is off.
 */
#ifndef SB_SIM_HYPERVISCOSITY_H
#define SB_SIM_HYPERVISCOSITY_H

#include "sim/simulation.h"

/* The viscosity of a fluid (m^2/s) below which pairs do without it: 2^-20 of kappa sqrt(gD) dr. At the scale of the
   spacing it would add less than 2e-5 to the hyperviscosity's damping, and waves of hundreds of spacings, which lose
   as much to both, lose nothing. 0 without hyperviscosity. wave_speed: sqrt(gD), m/s. */
double sb_faint_viscosity(const sb_scene *scene, double wave_speed);

/* Stage, after the forces: adds it to v*. */
sb_status sb_stage_hyperviscosity(sb_sim *sim, sb_error *error);

#endif
