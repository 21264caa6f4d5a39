/* Tait's equation of state for weakly compressible water with gamma = 7 [W]: p = B [(rho/rho_0)^7 - 1],
   B = c_0^2 rho_0/7. Densities are given as the excess over rho_0, because single precision would lose most digits of
   p in rho itself. */
#ifndef SB_PHYSICS_TAIT_H
#define SB_PHYSICS_TAIT_H

#include <math.h>

/* B in Pa, for a rest density in kg/m^3 and a speed of sound in m/s. */
static inline double sb_tait_stiffness(double rest_density, double sound_speed)
{
    return sound_speed * sound_speed * rest_density / 7;
}

/* p in Pa for the relative excess s = rho/rho_0 - 1: (1 + s)^7 - 1 without cancellation. */
static inline float sb_tait_pressure(float stiffness, float s)
{
    return stiffness * (s * (7 + s * (21 + s * (35 + s * (35 + s * (21 + s * (7 + s)))))));
}

/* The relative excess at a pressure in Pa, more than -B. */
static inline double sb_tait_excess(double stiffness, double pressure)
{
    return expm1(log1p(pressure / stiffness) / 7);
}

#endif
