/* Cnoidal waves: long periodic waves of constant form [Korteweg and de Vries 1895; constants as in Svendsen 2006,
   Introduction to Nearshore Hydrodynamics]. */
#ifndef SB_PHYSICS_CNOIDAL_H
#define SB_PHYSICS_CNOIDAL_H

#include "base/status.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/elliptic.h"

typedef struct sb_cnoidal {
    double height, depth;    /* m, trough to crest; mean depth */
    double length, celerity; /* m, m/s */
    double trough;           /* m, elevation of the trough, < 0 */
    sb_elliptic elliptic;
} sb_cnoidal;

/* Returns the wave with the elliptic parameter of that logit (see elliptic.h). Its celerity is 0 if no such wave
   exists, which is so for small m and large height/depth. */
sb_cnoidal sb_cnoidal_of_parameter(double height, double depth, double gravity, double logit);

/* Finds the wave of a period in s. SB_BAD_INPUT when there is none: the wave is too short for this theory, or so long
   that its crests are solitary waves. */
sb_status sb_cnoidal_of_period(double height, double period, double depth, double gravity, sb_cnoidal *wave,
                               sb_error *error);

/* Sets the motion at a phase in wavelengths ahead of a crest, |phase| <= 1/2, and z above the bed, at most that of the
   surface. The mean over the depth is u = C eta/(d + eta), so that volume is conserved exactly and no water is carried
   on average; u and w vary over the depth as irrotational flow requires to the order of the theory. */
void sb_cnoidal_at(const sb_cnoidal *wave, double phase, double z, sb_wave_motion *motion);

/* Displacement in m of a piston that moves with the mean velocity of the wave's water beside it, at t s after it was
   beside a crest at displacement 0 [Goring 1978]. phase: NULL, or set to the phase at the piston. */
double sb_cnoidal_piston(const sb_cnoidal *wave, double t, double *phase);

#endif
