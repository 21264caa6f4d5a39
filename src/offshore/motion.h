/* Water of the depth-averaged model at a place and time, with its velocity over the depth. */
#ifndef SB_OFFSHORE_MOTION_H
#define SB_OFFSHORE_MOTION_H

#include "offshore/offshore.h"

/* At the height z over the bed the velocity is (u, v) + (depth^2/6 - z^2/2) bend, and its vertical part
   -z divergence, to second order in depth over wavelength [SGN]. */
typedef struct sb_offshore_motion {
    bool wet;
    double bed, surface;         /* m; surface = bed where it is dry */
    double u, v, u_rate, v_rate; /* m/s, means over the depth; m/s^2, at the place */
    double divergence;           /* 1/s, of the mean velocity */
    double bend[2];              /* 1/(m s), gradient of the divergence; 0 without dispersion, and where waves break */
    double lift;                 /* m/s^2, second rate of the depth that moves with the water; 0 likewise */
} sb_offshore_motion;

/* Linear in time through the last two time levels, also before and after them; bilinear between cell centres. A place
   outside of the grid has the values of the nearest edge. */
void sb_offshore_motion_at(const sb_offshore *offshore, double time, double x, double y, sb_offshore_motion *out);
/* The same over other ground than the grid's, with this height, m: there is water where that of the cells around the
   place stands above this ground. `surface` is that of this water also where it is below the ground; where these cells
   have no water, it is at most the ground's height. */
void sb_offshore_motion_over(const sb_offshore *offshore, double time, double x, double y, double ground,
                             sb_offshore_motion *out);

#endif
