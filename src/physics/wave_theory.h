/* Waves known in closed form: initial states and yardsticks. */
#ifndef SB_PHYSICS_WAVE_THEORY_H
#define SB_PHYSICS_WAVE_THEORY_H

/* Solitary wave of height H on depth h (Boussinesq; Rayleigh's width when rayleigh != 0).
   xi: m ahead of the crest in the direction of travel; z: m above the bed. */
typedef struct sb_solitary { double height, depth, gravity; int rayleigh; } sb_solitary;
double sb_solitary_celerity(const sb_solitary *wave);                /* m/s, sqrt(g(h+H)) */
double sb_solitary_wavenumber(const sb_solitary *wave);              /* 1/m, kappa */
double sb_solitary_elevation(const sb_solitary *wave, double xi);    /* m */
/* Speed along the travel and upward, m/s: u = C eta/(h+eta), w from continuity. */
void sb_solitary_velocity(const sb_solitary *wave, double xi, double z, double *u, double *w);

/* Linear standing wave eta = a cos(kx) at rest at t = 0, on depth h. */
double sb_standing_elevation(double amplitude, double wavelength, double x);          /* m */
double sb_standing_period(double wavelength, double depth, double gravity);           /* s */

/* Keulegan's damped height after x metres, H0 at x = 0: see docs/method.md. */
double sb_keulegan_height(double height, double depth, double viscosity, double gravity, double x);

#endif
