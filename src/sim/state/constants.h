/* Constants of a run, computed from the scene and its model. Internal to src/sim. */
#ifndef SB_SIM_CONSTANTS_H
#define SB_SIM_CONSTANTS_H

#include "geometry/model/model.h"

/* Constants of the run. */
typedef struct sb_constants {
    int dimension;
    float spacing, support;   /* m: delta r and h */
    float rest_density, mass; /* kg/m^3; kg (kg/m in 2D) */
    float gravity;            /* m/s^2 */
    float wave_speed;         /* m/s, sqrt(g D); with surface tension at least sqrt(2 sigma/(rho R)) */
    float slowest;            /* 1/s, circular frequency of the water's slowest oscillation */
    float sound_speed;        /* m/s */
    float stiffness;          /* Pa, B of the equation of state of wcsph (physics/tait.h) */
    float viscosity;          /* m^2/s, physical */
    float surface_tension;    /* N/m; 0: off */
    float full_diagonal;      /* |a_ii|/dt^2 of a full lattice: the scale of a_ii */
    float lattice_slopes;     /* kg/m^5 */
    float bulk_deficit;       /* kg/m^3, deficit of a full lattice's density sum */
    float surface_deficit;    /* further deficit of a flat surface's first layer, over |sum_j m grad W|^2 there */
    double spectrum;          /* largest eigenvalue of D^-1 A on a full lattice */
    float speed_limit;        /* m/s, above it the run has diverged */
} sb_constants;

/* Without gravity and surface tension the wave speed is 1 m/s. Water shallower than one particle spacing counts as one
 * spacing deep. */
sb_constants sb_constants_of(const sb_scene *scene, const sb_model *model);

#endif
