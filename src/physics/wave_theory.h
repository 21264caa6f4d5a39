/* Waves known in closed form: initial states and yardsticks. */
#ifndef SB_PHYSICS_WAVE_THEORY_H
#define SB_PHYSICS_WAVE_THEORY_H

typedef enum sb_solitary_theory {
    SB_SOLITARY_THIRD_ORDER, /* of H/h [Grimshaw 1971] */
    SB_SOLITARY_BOUSSINESQ   /* the first [S16, eqs. 42 to 44] */
} sb_solitary_theory;

/* Solitary wave of height H on depth h. Boussinesq's is not one in water as it is: at H/h = 0.3 it is narrower, holds 7
   % less water, and sheds for a hundred depths; but it is how experiments are often defined. xi: m ahead of the crest
   in the direction of travel; z: m above the bed. */
typedef struct sb_solitary {
    double height, depth, gravity;
    sb_solitary_theory theory;
} sb_solitary;
double sb_solitary_celerity(const sb_solitary *wave);             /* m/s */
double sb_solitary_elevation(const sb_solitary *wave, double xi); /* m */
/* Speed along the travel and upward, m/s. */
void sb_solitary_velocity(const sb_solitary *wave, double xi, double z, double *u, double *w);

/* Linear standing wave eta = a cos(kx) at rest at t = 0, on depth h. */
double sb_standing_elevation(double amplitude, double wavelength, double x); /* m */
double sb_standing_period(double wavelength, double depth, double gravity);  /* s */

/* Keulegan's damped height after x metres, H0 at x = 0: see docs/method.md. */
double sb_keulegan_height(double height, double depth, double viscosity, double gravity, double x);

#endif
