/* Linear waves on water of constant depth: wave number, ratios of hyperbolic functions, the motion that a piston makes.
   Lengths in m, times in s, z above the bed. */
#ifndef SB_PHYSICS_DISPERSION_H
#define SB_PHYSICS_DISPERSION_H

/* Water at one place and instant in a wave that travels along one axis. */
typedef struct sb_wave_motion {
    double elevation;      /* m above the still-water level */
    double u, w;           /* m/s, along the direction of travel, and upward */
    double u_rate, w_rate; /* m/s2, their derivatives in time at the place */
} sb_wave_motion;

/* Returns k in 1/m of omega^2 = g k tanh(k d), to rounding. period, depth, gravity > 0. */
double sb_wave_number(double period, double depth, double gravity);

/* Returns the speed of the energy of waves of the wave number k, m/s: omega/k (1 + 2kd/sinh 2kd)/2. */
double sb_group_speed(double omega, double k, double depth);

/* Return cosh(k z)/sinh(k d) and sinh(k z)/sinh(k d), without overflow in deep water. 0 <= z, k d > 0. */
double sb_cosh_over_sinh(double k, double z, double depth);
double sb_sinh_over_sinh(double k, double z, double depth);

/* Returns H/S0 of a piston with the full stroke S0 in water of k d: 4 sinh^2 kd/(2 kd + sinh 2 kd) [Biesel 1951]. */
double sb_piston_height_over_stroke(double kd);

/* Wave number times depth of the wave j >= 1 that stays where it is made: the root of x tan x = -y in ((j - 1/2) pi, j
   pi), with y = omega^2 depth/gravity, by Newton's method on atan, which is almost linear there. */
double sb_evanescent_root(int j, double y);

#endif
