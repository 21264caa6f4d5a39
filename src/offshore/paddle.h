/* A side of the grid that moves water as a paddle does. Private to src/offshore, but for its creation. */
#ifndef SB_OFFSHORE_PADDLE_H
#define SB_OFFSHORE_PADDLE_H

#include "offshore/state.h"
#include "physics/wavemakers/wavemaker.h"

typedef struct sb_offshore_paddle_options {
    sb_wavemaker_parameters law;
    double ahead; /* m, from the paddle's face before its motion to the side, inwards */
    double depth; /* m, still water at the side */
} sb_offshore_paddle_options;

/* SB_BAD_INPUT for values that the law cannot use. The caller owns *paddle. */
sb_status sb_offshore_paddle_create(const sb_offshore_paddle_options *options, sb_offshore_paddle **paddle,
                                    sb_error *error);
void sb_offshore_paddle_destroy(sb_offshore_paddle *paddle);

/* The water that the waves of a paddle have at the side at a time of the grid, s, which is that of the law. */
sb_offshore_push sb_offshore_paddle_at(const sb_offshore_paddle *paddle, double time);

/* How the surface, and the non-hydrostatic pressure over the depth, rise inwards at the side where the water is h deep:
   m/m and m^2/s^2. */
double sb_offshore_push_slope(const sb_offshore_push *push, double h);
double sb_offshore_push_pressure(const sb_offshore_push *push, double h, double gravity);

/* Adds what the side does to the right-hand side of the system for the pressure, before its faces are scaled; then to
   the pressure beyond the side, before its forces are found. scale: 0 where a cell has no pressure. */
void sb_offshore_paddle_system(const sb_offshore *offshore, const sb_offshore_level *level, const double *scale,
                               double *residual);
void sb_offshore_paddle_beyond(const sb_offshore *offshore, const sb_offshore_level *level, const double *scale,
                               double *pressure);

#endif
