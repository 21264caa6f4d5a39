/* Stokes waves of first to fifth order on constant depth [Fenton 1985, "A fifth-order Stokes theory for steady waves";
   coefficients of its Table 1, as programs that cite it give them, checked by the equations that they solve in
   tests/physics/test_stokes.c]. */
#ifndef SB_PHYSICS_STOKES_H
#define SB_PHYSICS_STOKES_H

#include "base/status.h"

enum { SB_STOKES_ORDERS = 5 };

typedef struct sb_stokes {
    int order;                         /* 1 to 5 */
    double height, length, depth;      /* m, trough to crest; mean depth */
    double number, celerity;           /* 1/m; m/s, relative to water whose mean velocity at a point below is 0 */
    double surface[SB_STOKES_ORDERS];  /* m: elevation = sum of surface[j] cos((j + 1) k x) */
    double velocity[SB_STOKES_ORDERS]; /* m/s: u = sum of velocity[j] cosh((j + 1) k z)/cosh((j + 1) k d) cos((j + 1) k
                                          x) */
} sb_stokes;

/* H L^2/d^3 up to which the fifth order is accurate [Fenton 1990]. */
#define SB_STOKES_URSELL 40.0

/* Finds the wave of a length. All values > 0. SB_BAD_INPUT for a wave that breaks (breaking.h), or that is too long:
   beyond SB_STOKES_URSELL, for the second order beyond SB_URSELL_LIMIT; the first order is given for all lengths. */
sb_status sb_stokes_create(int order, double height, double length, double depth, double gravity, sb_stokes *wave,
                           sb_error *error);

/* Finds the wave of a period: its length is the period times its celerity. All values > 0. Errors as above. */
sb_status sb_stokes_of_period(int order, double height, double period, double depth, double gravity, sb_stokes *wave,
                              sb_error *error);

/* Elevation in m at a distance ahead of a crest along the direction of travel. */
double sb_stokes_elevation(const sb_stokes *wave, double ahead);
/* Velocities in m/s along the direction of travel and upward, z above the bed. Above the surface they are those of the
   surface; of first order, those of the still level. */
void sb_stokes_velocity(const sb_stokes *wave, double ahead, double z, double *u, double *w);

#endif
