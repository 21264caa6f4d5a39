/* Goring's law for a piston that makes a solitary wave, without the smooth start and stop that the wave makers add. */
#ifndef SB_PHYSICS_WAVEMAKER_GORING_H
#define SB_PHYSICS_WAVEMAKER_GORING_H

#include <stdbool.h>

typedef struct sb_goring {
    double ratio;    /* H/h */
    double kappa;    /* 1/m */
    double celerity; /* m/s, C */
    double stroke;   /* m, S = 2H/(kappa h) */
    double period;   /* s, T = 2/(kappa C) (3.80 + H/h) */
} sb_goring;

/* Returns the constants of the paddle for a wave of height H on depth h, m: C = sqrt(g(h + H)), and Boussinesq's
   kappa^2 = 3H/(4h^3) or Rayleigh's kappa^2 = 3H/(4h^2(h + H)) [G78; S16 eqs. 43, 44, 48, 49]. */
sb_goring sb_goring_of(double height, double depth, double gravity, bool rayleigh);

/* Returns the displacement X(t - T/2) + S/2 in m for any t in s, and the speed in m/s if it is not NULL. At t = 0 and T
   the displacement is S/2 tanh(3.80) below and above S/2. */
double sb_goring_paddle(const sb_goring *law, double t, double *speed);

#endif
