/* Drops in a box without gravity, for tests of surface tension. */
#ifndef SB_TESTS_DROP_H
#define SB_TESTS_DROP_H

#include "sim/tank.h"

/* A drop of radius 1 m of 1000 kg/m^3, with the surface tension at which sqrt(2 sigma/(rho R)) is 1 m/s. */
typedef struct drop_form {
    int dimensions;
    double spacing, stretch; /* m; height over that of the ball (2D: disc), at the same volume */
    bool cube;               /* a cube (2D: square) of that volume instead */
    double viscosity;        /* artificial, alpha */
} drop_form;

typedef struct drop {
    tank tank;
    sb_sim *sim;
    double radius;           /* m, of a ball of the water's volume */
    double pressure, period; /* Pa, s: Laplace's pressure, and the period of the oscillation of the lowest order */
} drop;

void drop_make(drop *d, const drop_form *form);
void drop_free(drop *d);

/* Shape of a drop around its centre of mass. */
typedef struct drop_shape {
    double stretch;   /* mean of 3 z^2 - r^2 (2D: 2 z^2 - r^2) over the mean of r^2: 0 for a ball */
    double corners;   /* mean of x^4 + y^4 + z^4 - 3/5 r^4 (2D: 3/4) over that of r^4: 0 for a ball */
    double inside;    /* Pa, mean virial pressure within R/2 */
    sb_vec3 momentum; /* over the mass, m/s */
} drop_shape;
drop_shape drop_look(drop *d);

#endif
