/* What third order takes from the waves of a piston. */
#ifndef SB_PHYSICS_PADDLE_THIRD_H
#define SB_PHYSICS_PADDLE_THIRD_H

#include <stdbool.h>

/* Returns g: a piston that moves for the amplitude a by linear theory, with the motion of second order that cancels the
   free wave of twice the frequency (paddle_second.h), makes a first harmonic of the amplitude a (1 - g (ka)^2). By
   interpolation between runs of a tank of nonlinear potential flow (tests/physics/potential_tank.h; decision 0111),
   within 15 % for kd from 0.3 to 8; beyond that by the slope, or the value, at the end. kd > 0. */
double sb_paddle_third_loss(double kd);

/* Returns the amplitude of linear theory, m, for which the piston makes a first harmonic of `first` m, but at most 1.21
   times that. number: 1/m. *steep: there is no such amplitude, since g (ka)^2 would have to be above 1/3; may be NULL.
 */
double sb_paddle_third_amplitude(double first, double number, double depth, bool *steep);

#endif
