/* Waves with a closed-form solution, used as initial states and as references for tests. */
#ifndef SB_PHYSICS_WAVE_THEORY_H
#define SB_PHYSICS_WAVE_THEORY_H

#include "physics/waves/dispersion.h"

typedef enum sb_solitary_theory {
    SB_SOLITARY_THIRD_ORDER, /* third order in H/h [Grimshaw 1971] */
    SB_SOLITARY_BOUSSINESQ,  /* first order in H/h [S16, eqs. 42 to 44] */
    SB_SOLITARY_SERRE        /* exact for the Serre-Green-Naghdi equations: velocity constant over the depth */
} sb_solitary_theory;

/* Solitary wave of height H on depth h. Boussinesq's profile is not an exact solitary wave: at H/h = 0.3 it is narrower
   than the exact one, contains 7 % less water, and sheds trailing waves over a hundred depths. It is provided because
   experiments are often defined by it. xi: distance ahead of the crest in the direction of travel, m; z: height above
   the bed, m. */
typedef struct sb_solitary {
    double height, depth, gravity;
    sb_solitary_theory theory;
} sb_solitary;
double sb_solitary_celerity(const sb_solitary *wave);             /* m/s */
double sb_solitary_elevation(const sb_solitary *wave, double xi); /* m */
/* Velocity components in the direction of travel (u) and upward (w), m/s. */
void sb_solitary_velocity(const sb_solitary *wave, double xi, double z, double *u, double *w);
/* Elevation, velocities and accelerations. The latter are differences over a thousandth of the depth, with an error
   below 1e-10 of g. */
void sb_solitary_motion(const sb_solitary *wave, double xi, double z, sb_wave_motion *motion);

/* Linear standing wave eta = a cos(kx) at rest at t = 0, on depth h. */
double sb_standing_elevation(double amplitude, double wavelength, double x); /* m */
double sb_standing_period(double wavelength, double depth, double gravity);  /* s */

/* Wave height after x metres with Keulegan's damping; `height` is the height at x = 0. See docs/method.md. */
double sb_keulegan_height(double height, double depth, double viscosity, double gravity, double x);

#endif
