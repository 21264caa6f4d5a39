/* A fully nonlinear tank of potential flow with a piston, as reference for wave makers: sources outside of the water,
   two spacings apart from it at most, whose strengths follow from the potential at the surface and the velocity of the
   piston [desingularised boundary integrals, Cao, Schultz and Beck 1991, Int. J. Numer. Methods Fluids 12]. The far
   third of the tank takes the waves. Lengths in m, times in s. */
#ifndef SB_TEST_POTENTIAL_TANK_H
#define SB_TEST_POTENTIAL_TANK_H

#include <complex.h>

typedef struct potential_tank {
    double depth, gravity, period;
    double stroke; /* the piston is at stroke sin(omega t) + Re(second exp(2 i omega t)), with a ramp of two periods */
    double complex second; /* m */
    int points;            /* of the surface, in a wavelength of linear theory */
    int lengths, periods;  /* wavelengths of the tank; periods of the run */
} potential_tank;

/* Returns the first harmonic of the surface over the last two periods, m: the mean of five places between 1 and 2
   wavelengths from the piston. NaN where the waves break. */
double potential_tank_run(const potential_tank *tank);

#endif
