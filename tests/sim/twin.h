/* A copy of a simulation's state for the double-precision reference, with which most tests here compare. */
#ifndef SB_TESTS_TWIN_H
#define SB_TESTS_TWIN_H

#include "reference/reference.h"
#include "sim/simulation.h"

/* Fluid particles are in the simulation's order. Boundary particles are those of the static set, then those of the
   moving set, without the images beyond periodic sides, which the reference makes itself. */
typedef struct twin {
    sb_reference reference;
    sb_vec3 *position, *velocity, *wall_position, *wall_velocity, *wall_normal;
    double *psi; /* wall volumes of the simulation */
    uint32_t *body;
    size_t static_count;
} twin;

/* Makes a twin of the present positions and velocities. The gradients of fluid pairs come from the slopes in the
   simulation's lists. Returns 0, or -1 without memory. */
int twin_make(const sb_sim *sim, twin *t);
void twin_free(twin *t);

/* The factor gamma of the simulation's wall volumes: 1, or with images that of a lattice. */
double twin_gamma(const sb_sim *sim);

/* The fraction of the viscosity with which shear along an axis of a full lattice decays (docs/method.md, section 6). */
double twin_lattice_shear(const sb_sim *sim);

/* The twin's boundary particle for an index in the simulation's wall lists. Not for periodic sides. */
size_t twin_wall(const twin *t, uint32_t listed);

/* Entry k of particle i's list of fluid or boundary particles, padding included. */
typedef struct twin_entry {
    uint32_t other; /* a particle (ghosts follow the fluid particles), or as in sb_pairs.index */
    double slope;   /* m W'/r, or psi W'/r, times the quantum */
    bool padding;
} twin_entry;
size_t twin_listed(const sb_sim *sim, size_t i, bool walls);
twin_entry twin_list(const sb_sim *sim, size_t i, bool walls, size_t k);

/* Largest |a - b|, its index, and largest |b|, to which a test's tolerance is relative. */
typedef struct twin_gap {
    double worst, scale;
    size_t at;
} twin_gap;
void twin_compare(twin_gap *gap, size_t at, double a, double b);
/* worst/scale */
double twin_relative(const twin_gap *gap);

#endif
