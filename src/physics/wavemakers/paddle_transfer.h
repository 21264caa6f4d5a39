/* Linear theory of the waves that a paddle makes, and the filter with which it absorbs waves that come back. */
#ifndef SB_PHYSICS_PADDLE_TRANSFER_H
#define SB_PHYSICS_PADDLE_TRANSFER_H

#include <complex.h>
#include <stddef.h>

typedef enum sb_paddle_motion {
    SB_PADDLE_PISTON, /* the same displacement at all heights */
    SB_PADDLE_FLAP    /* turns about the bed; its displacement is that at the still level */
} sb_paddle_motion;

/* Height of the waves far away over the full stroke, for a wave number and a depth, both > 0 [Biesel 1951; Dean and
   Dalrymple 1991]. */
double sb_paddle_gain(sb_paddle_motion motion, double number, double depth);

/* Surface of the waves that stay near the paddle, at a distance from it in m, over the paddle's displacement, with
   which they are in phase. */
double sb_paddle_evanescent(sb_paddle_motion motion, double omega, double depth, double gravity, double distance);

/* The velocity of the paddle over the surface at a distance from it, for which no wave is sent back: of surface less
   that of the waves to be made, with time as exp(i omega t). */
double complex sb_paddle_absorbing(sb_paddle_motion motion, double omega, double depth, double gravity,
                                   double distance);

/* One frequency of the waves to be absorbed, and its energy. */
typedef struct sb_band_part {
    double omega, weight;
} sb_band_part;

/* velocity = -gain pole/(s + pole) of the surface without its slow part, which two filters s/(s + slow) remove. gain
   and pole are positive, so that the filter takes energy at all frequencies above `slow` of waves longer than four
   times the distance; it sends shorter ones back higher. */
typedef struct sb_absorbing_filter {
    double gain;    /* 1/s */
    double pole;    /* 1/s; infinity: no lag */
    double slow;    /* 1/s */
    double square;  /* 1/m, sb_paddle_mean_of_square of the band */
    double gravity; /* m/s^2 */
} sb_absorbing_filter;

/* Mean of second order, in m, that the surface beside a moving paddle has above the level of a closed flume that is
   full of waves: <V^2>/(2 g) + square <eta^2>, V the paddle's velocity. Returns `square`, in 1/m, for a wave number. */
double sb_paddle_mean_of_square(double number, double depth);

/* Fits the filter to a band by least squares of its inverse, weighted by energy; one frequency is met exactly. */
sb_absorbing_filter sb_absorbing_filter_of(sb_paddle_motion motion, const sb_band_part *band, size_t count, double slow,
                                           double depth, double gravity, double distance);

/* Reflected over incident amplitude by linear theory at one frequency. */
double sb_absorbing_reflection(const sb_absorbing_filter *filter, sb_paddle_motion motion, double omega, double depth,
                               double gravity, double distance);

#endif
