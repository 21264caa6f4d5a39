/* Goring's law for a piston that makes a solitary wave, before its ends are eased. */
#ifndef SB_PHYSICS_WAVEMAKER_GORING_H
#define SB_PHYSICS_WAVEMAKER_GORING_H

#include "physics/wave_theory.h"

typedef struct sb_goring {
    double ratio;    /* H/h */
    double kappa;    /* 1/m */
    double celerity; /* m/s, C */
    double stroke;   /* m, S = 2H/(kappa h) */
    double period;   /* s, T = 2/(kappa C) (3.80 + H/h) */
} sb_goring;

/* The constants of a wave's paddle [G78; S16 eqs. 43, 44, 48, 49]. */
sb_goring sb_goring_of(const sb_solitary *wave);

/* The law X(t - T/2) + S/2 in m, any t in s: S/2 tanh(3.80) below and above S/2 at t = 0 and T, and
   speed in m/s. */
double sb_goring_paddle(const sb_goring *law, double t, double *speed);

#endif
