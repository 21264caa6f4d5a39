/* Sums of linear waves of any directions on constant depth. */
#ifndef SB_PHYSICS_WAVE_SUM_H
#define SB_PHYSICS_WAVE_SUM_H

#include <stddef.h>

/* One wave: a cos(k . x - omega t + phase). */
typedef struct sb_wave_component {
    double amplitude, period; /* m, s */
    double direction, phase;  /* rad; direction: of travel, from +x towards +y */
    double omega, number;     /* rad/s, 1/m: set by sb_wave_component_prepare */
    double along[2];          /* unit vector of travel */
} sb_wave_component;

/* Water at one place and instant. */
typedef struct sb_wave_sum {
    double elevation;                     /* m */
    double velocity[3], velocity_rate[3]; /* m/s, m/s2 */
} sb_wave_sum;

/* Sets the derived members. period, depth, gravity > 0. */
void sb_wave_component_prepare(sb_wave_component *wave, double depth, double gravity);

/* Sums the waves at (x, y) from the point where the phases are given, and z above the bed. Above the still level
   velocities are those at the still level, where the vertical one agrees with the elevation. */
void sb_wave_sum_at(const sb_wave_component *waves, size_t count, double depth, double t, double x, double y, double z,
                    sb_wave_sum *sum);

/* Upper bounds: the sum of the amplitudes in m, and that of the speeds at the still level in m/s. */
double sb_wave_sum_crest(const sb_wave_component *waves, size_t count);
double sb_wave_sum_speed(const sb_wave_component *waves, size_t count, double depth);

#endif
