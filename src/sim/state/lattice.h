/* Sums over a full lattice at the rest spacing: the scales of particle sums. */
#ifndef SB_SIM_LATTICE_H
#define SB_SIM_LATTICE_H

#include "scene/scene.h"

/* -A_ii/dt^2 (M13) of particles of the given mass: |S|^2 + m sum_j m |grad W|^2 with S = 0. */
double sb_lattice_diagonal(const sb_scene *scene, double mass);

/* Largest eigenvalue of D^-1 A: over all wave vectors k, |sum_j grad W sin(k.x_j)|^2 / sum_j |grad W|^2. */
double sb_lattice_spectrum(const sb_scene *scene);

/* sum_j m |W'|/r, kg/m^5. */
double sb_lattice_slopes(const sb_scene *scene, double mass);

/* Density of the lattice over the rest density: sum_j V W. */
double sb_lattice_density(const sb_scene *scene);

/* Deficit of the density sum over (h |sum_j V grad W|)^2, for the first layer of a half space of the lattice, half a
   spacing below the surface. About 0.15 for all kernels. */
double sb_lattice_truncation(const sb_scene *scene);

#endif
