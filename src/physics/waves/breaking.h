/* Heights at which waves on constant depth break. */
#ifndef SB_PHYSICS_BREAKING_H
#define SB_PHYSICS_BREAKING_H

#include "base/status.h"

#include <stdbool.h>

/* Greatest height of a solitary wave over its depth [Longuet-Higgins and Fenton 1974: 0.827; Hunter and Vanden-Broeck
   1983: 0.8332]. Waves of constant form approach it with their length. */
#define SB_SOLITARY_HIGHEST 0.8332

/* Returns the height in m of the highest steady wave of the number k [Williams 1981, as fitted by Fenton 1990, eq. 32]:
   0.141 L in deep water, that of a solitary wave in shallow water. With k of the linear wave of a period it is up to
   14 % low in deep water, where the highest wave of the period is longer, and less elsewhere. */
double sb_breaking_height(double number, double depth);

/* Greatest height of a standing wave over L tanh kd [Penney and Price 1952: 0.218 in deep water]. */
#define SB_STANDING_STEEPEST 0.218

/* Returns whether a wave (m) is above a thousand depths (m) long: waves of the amplitude a break after L d/(3 pi a),
   here a hundred depths or more, so that at the scale of a scene it is a tide. */
bool sb_is_tide(double length, double depth);

/* A limit rounded down to three digits, as messages show it: what they name is accepted. */
double sb_breaking_shown(double most);

/* The height of a sum of linear waves. Begin with {0}. */
typedef struct sb_sum_height {
    double square, sum; /* m^2, m: of the amplitudes */
    double highest;     /* m, the greatest amplitude */
    double number;      /* 1/m, of the wave that has it; of equal ones the longest */
} sb_sum_height;

void sb_sum_height_add(sb_sum_height *all, double amplitude, double number);
/* Returns the significant height in m, four standard deviations; or twice the sum of the amplitudes where that is less,
   which is the height of a single wave. */
double sb_sum_height_of(const sb_sum_height *all);
/* SB_BAD_INPUT if that height is above the one at which the highest of the waves would break. */
sb_status sb_sum_height_check(const sb_sum_height *all, double depth, sb_error *error);

#endif
