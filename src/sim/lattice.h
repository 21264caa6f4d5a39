/* Sums over a full lattice at the rest spacing: scales for what particles see. */
#ifndef SB_SIM_LATTICE_H
#define SB_SIM_LATTICE_H

#include "scene/scene.h"

/* |S|^2 + m sum_j m |grad W|^2, where S vanishes: -A_ii per dt^2 (M13), for particles of the given mass. */
double sb_lattice_diagonal(const sb_scene *scene, double mass);

/* Largest eigenvalue of D^-1 A: over all wave vectors k, |sum_j grad W sin(k.x_j)|^2 / sum_j |grad W|^2. */
double sb_lattice_spectrum(const sb_scene *scene);

/* Density of that lattice over the rest density: sum_j V W. */
double sb_lattice_density(const sb_scene *scene);

/* Of the first layer of a half space of it, half a spacing below the surface: what its density lacks, over
   (h |sum_j V grad W|)^2. About 0.15 for all kernels. */
double sb_lattice_truncation(const sb_scene *scene);

#endif
