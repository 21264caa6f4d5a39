/* Second-order theory of a piston that makes regular waves. */
#ifndef SB_PHYSICS_PADDLE_SECOND_H
#define SB_PHYSICS_PADDLE_SECOND_H

#include <complex.h>

/* Returns X in m: with Re(X exp(2 i omega t)) beside the linear motion S/2 sin(omega t), no free wave of twice the
   frequency leaves the piston [the problem of Schaeffer 1996, solved here by Green's identity]. For long waves it is
   Madsen's e sin(2 omega t), e = H^2/(32 d) (3 cosh kd/sinh^3 kd - 2/W) [Madsen 1971]. height, depth in m, omega in
   1/s, gravity in m/s^2, all > 0. 0 where kd is above 100. */
double complex sb_paddle_second(double height, double omega, double depth, double gravity);

#endif
