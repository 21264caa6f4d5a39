/* Steady waves by a Fourier series of the stream function [Rienecker and Fenton 1981, J. Fluid Mech. 104]: no expansion
   in the height, so that Stokes' and cnoidal waves are the same problem. Waves that are both long and high need more
   terms than there are. */
#ifndef SB_STEADY_WAVE_H
#define SB_STEADY_WAVE_H

#include <stdbool.h>

/* A wave in a closed flume, where no water is carried on average. Lengths in m, speeds in m/s. */
typedef struct sb_steady_wave {
    double length;
    double speed;    /* of the crests over the ground */
    double current;  /* mean of the velocity at a fixed place below the troughs, negative */
    double first;    /* amplitude of the first harmonic of the surface */
    double residual; /* largest error of the equations, in units of depth and gravity */
} sb_steady_wave;

/* False: there is no such wave, or it is too near to breaking to be found (above 93 to 98 % of the highest, at kd 0.25
   86 %), or too long and high (above H/d = 0.57, 0.32, 0.19, 0.09 at kd = 0.17, 0.13, 0.1, 0.07), or below 1e-8 of the
   depth. Water deeper than kd = 100 counts as that deep. */
bool sb_steady_wave_of(double height, double period, double depth, double gravity, sb_steady_wave *wave);

#endif
