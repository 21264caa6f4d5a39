/* Drag of walls: friction and shear of one pair. It is used for the acceleration of the water and for the force on the
   body. */
#ifndef SB_SIM_WALL_DRAG_H
#define SB_SIM_WALL_DRAG_H

#include "sim/simulation.h"

/* Factors of one step. Lengths are in quanta where noted. */
typedef struct sb_wall_drag {
    bool on;
    float friction;                 /* sigma h c_s / (2 quanta) [S16, eq. 33]; 0: none */
    float epsilon;                  /* 0.01 h^2, quanta^2 */
    bool shear;                     /* whether there is smooth-wall shear */
    float viscosity, rest_density;  /* m^2/s; kg/m^3, used because density sums beside walls are not those of water */
    float quantum, offset, nearest; /* m; quanta: wall offset, and smallest distance from the wall */
} sb_wall_drag;

sb_wall_drag sb_wall_drag_make(const sb_sim *sim);

#endif
