/* The state of a simulation as the double-precision reference sees it: the oracle of most tests
 * here. */
#ifndef SB_TESTS_TWIN_H
#define SB_TESTS_TWIN_H

#include "reference/reference.h"
#include "sim/state.h"

/* Particles in the simulation's order; boundary particles: the static set's, then the moving set's,
   without the images beyond periodic sides, which the reference makes itself. */
typedef struct twin {
    sb_reference reference;
    sb_vec3 *position, *velocity, *wall_position, *wall_velocity, *wall_normal;
    double *psi; /* as the simulation holds them */
    uint32_t *body;
    size_t static_count;
} twin;

/* Of the present positions and velocities; gradients of the water's pairs by the slopes that the simulation's lists
   hold. 0, or -1 without memory. */
int twin_make(const sb_sim *sim, twin *t);
void twin_free(twin *t);

/* Boundary particle of the twin for an index in the simulation's wall lists, where no side is
   periodic. */
size_t twin_wall(const twin *t, uint32_t listed);

/* Entry k of particle i's list of water or of walls, fillings-up included. */
typedef struct twin_entry {
    uint32_t other; /* a particle (ghosts follow the owned ones), or as in sb_pairs.index */
    double slope;   /* m W'/r, or psi W'/r, times the quantum */
    bool padding;
} twin_entry;
size_t twin_listed(const sb_sim *sim, size_t i, bool walls);
twin_entry twin_list(const sb_sim *sim, size_t i, bool walls, size_t k);

/* Largest |a - b| and largest |b|: what a test's tolerance is relative to. */
typedef struct twin_gap {
    double worst, scale;
    size_t at;
} twin_gap;
void twin_compare(twin_gap *gap, size_t at, double a, double b);
/* worst/scale */
double twin_relative(const twin_gap *gap);

#endif
