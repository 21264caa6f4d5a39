/* The non-hydrostatic pressure of the Serre-Green-Naghdi equations. Private to src/offshore. */
#ifndef SB_OFFSHORE_DISPERSION_H
#define SB_OFFSHORE_DISPERSION_H

#include "offshore/state.h"

/* The linear system for the pressure, scaled so that its diagonal is 1, and the arrays of its solution. Layout as in
   state.h. */
typedef struct sb_offshore_system {
    double *east, *north; /* coupling of a cell with the next one along x and y */
    double *scale;        /* pressure over unknown; 0: no pressure in this cell */
    double *unknown, *residual, *direction, *product;
    double *line_sum; /* per line */
    bool around_x, around_y;
} sb_offshore_system;

struct sb_offshore_dispersion {
    sb_offshore_system system;
    double *pressure; /* m^3/s^2, depth-integrated non-hydrostatic pressure over density, of the last solve */
    double *earlier;  /* at the beginning of the last step */
    double *active;   /* 1: the cell has a pressure; 0: breaking; -1: dry, shore or cliff */
    double *breaking; /* 1: breaking */
    double last_dt;   /* s, 0: before the first step */
    uint64_t iterations;
};

sb_status sb_offshore_dispersion_create(const sb_offshore *offshore, struct sb_offshore_dispersion **dispersion,
                                        sb_error *error);
void sb_offshore_dispersion_destroy(struct sb_offshore_dispersion *dispersion);
size_t sb_offshore_dispersion_bytes(size_t cells);

/* Fills force_x and force_y from a level whose primitives are ready. stage 0: the level at the beginning of a step of
   dt; 1: the one after its first stage. SB_FAILED when the solve does not converge. */
sb_status sb_offshore_find_dispersion(sb_offshore *offshore, const sb_offshore_level *level, int stage, double dt,
                                      sb_error *error);

void sb_offshore_dispersion_effort(const sb_offshore *offshore, uint64_t *iterations, size_t *breaking);

/* breaking.c: marks the cells that have a pressure. With `decide`, first decides where waves break; otherwise keeps the
   last decision. */
void sb_offshore_mark_active(sb_offshore *offshore, const sb_offshore_level *level, bool decide);

/* elliptic.c: conjugate gradients from the given unknown; residual holds the right-hand side and is overwritten. Stops
   at `tolerance` times its norm. Returns the iterations, negative when it did not converge. The bits do not depend on
   the number of threads. */
int sb_offshore_solve(const sb_offshore *offshore, const sb_offshore_system *system, double tolerance);

/* Copies the cells at periodic sides to those beyond the opposite side; other cells beyond sides get the value of the
   nearest cell times `other`. */
void sb_offshore_wrap(const sb_offshore *offshore, double *values, double other);

#endif
