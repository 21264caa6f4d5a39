/* Regular waves on constant depth, by the theory that fits their height and length. */
#ifndef SB_PHYSICS_REGULAR_WAVE_H
#define SB_PHYSICS_REGULAR_WAVE_H

#include "physics/waves/cnoidal.h"

typedef enum sb_wave_order {
    SB_WAVE_AUTO,    /* second order below the limit of the Ursell number, otherwise cnoidal */
    SB_WAVE_LINEAR,  /* first order in height over length */
    SB_WAVE_STOKES2, /* second order [Stokes 1847; Dean and Dalrymple 1991] */
    SB_WAVE_CNOIDAL
} sb_wave_order;

/* H L^2/d^3 from which second-order waves would have a second crest in their trough: 8 pi^2/3. */
#define SB_URSELL_LIMIT 26.318945069571623

typedef struct sb_regular_wave {
    sb_wave_order order; /* never AUTO */
    double height, period, depth, gravity;
    double number, length, celerity; /* 1/m, m, m/s */
    double ursell;                   /* H L^2/d^3 with the length of the linear wave */
    double second;                   /* m, amplitude of the second harmonic; 0 unless second order */
    double current;                  /* m/s, uniform, so that the second-order wave carries no water on average */
    sb_cnoidal cnoidal;
} sb_regular_wave;

/* Finds the wave. All values > 0. SB_BAD_INPUT for a wave that breaks (breaking.h) and for an order that is not valid
 * for it: second order beyond the limit, cnoidal where no such wave exists. */
sb_status sb_regular_wave_create(sb_wave_order order, double height, double period, double depth, double gravity,
                                 sb_regular_wave *wave, sb_error *error);

/* Sets the motion s metres along the direction of travel, t seconds after a crest passed s = 0, z metres above the bed.
   Above the surface it is that of the surface; of a linear wave, that of the still level. */
void sb_regular_wave_at(const sb_regular_wave *wave, double s, double t, double z, sb_wave_motion *motion);

/* Returns the elevation of the crest in m, and the greatest speed of the water in m/s. */
double sb_regular_wave_crest(const sb_regular_wave *wave);
double sb_regular_wave_speed(const sb_regular_wave *wave);

#endif
