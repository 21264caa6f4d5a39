/* Depth-averaged water on a grid of square cells: the nonlinear shallow-water equations, and on request the
   Serre-Green-Naghdi equations. Finite volumes of second order in space and time; water at rest stays at rest, and
   depths stay positive. One row of cells is the model in one dimension. The bits are the same for any number of
   threads. docs/offshore.md has the equations and their sources. */
#ifndef SB_OFFSHORE_OFFSHORE_H
#define SB_OFFSHORE_OFFSHORE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sb_offshore sb_offshore;

enum { SB_OFFSHORE_X_MIN, SB_OFFSHORE_X_MAX, SB_OFFSHORE_Y_MIN, SB_OFFSHORE_Y_MAX, SB_OFFSHORE_SIDES };

typedef enum sb_offshore_side {
    SB_OFFSHORE_WALL,
    SB_OFFSHORE_OPEN,     /* long waves leave; beyond the side the water rests at options.level */
    SB_OFFSHORE_PERIODIC, /* pairs along x or y */
    SB_OFFSHORE_GIVEN,    /* as open, but the water beyond is what options.given returns */
    SB_OFFSHORE_PADDLE    /* moves water as options.paddle does; a wall when it rests */
} sb_offshore_side;

/* Surface above the datum of the bed, m, and depth-averaged velocity, m/s. */
typedef struct sb_offshore_water {
    double surface, u, v;
} sb_offshore_water;

/* A law of motion for one side: offshore/paddle.h. */
typedef struct sb_offshore_paddle sb_offshore_paddle;

/* The water beyond a given side at that time, s, and place, m. Called from one thread. */
typedef sb_offshore_water sb_offshore_given(void *context, double time, double x, double y);

typedef struct sb_offshore_options {
    size_t columns, rows; /* at least 2 columns; 1 row (no motion along y) or at least 2 */
    double x, y, cell;    /* m, corner with the smallest coordinates, and the edge of a cell */
    double gravity;       /* m/s^2 */
    double manning;       /* s/m^(1/3), Manning's n; 0: no friction */
    double level;         /* m, still water beyond open sides */
    double dry_depth; /* m, below this the velocity of a film is reduced; 0: 1e-5 of the greatest depth, at most 1 mm */
    sb_offshore_side side[SB_OFFSHORE_SIDES]; /* those along y have no effect with one row */
    sb_offshore_given *given;                 /* NULL: no side is given */
    void *given_context;
    sb_offshore_paddle *paddle; /* NULL: no side is a paddle; a model that is created takes it over */
    bool dispersion;            /* Serre-Green-Naghdi instead of shallow water */
} sb_offshore_options;

/* Copies bed and depth: columns x rows values, m, [row * columns + column], row 0 at y. hu and hv (m^2/s) may be NULL:
   at rest. The caller owns *offshore. SB_BAD_INPUT names an option or the first cell whose value is not finite or whose
   depth is negative. */
sb_status sb_offshore_create(const sb_offshore_options *options, const double *bed, const double *depth,
                             const double *hu, const double *hv, sb_offshore **offshore, sb_error *error);
void sb_offshore_destroy(sb_offshore *offshore);

/* Advances by the largest stable time step, but by no more than `most` seconds (> 0). Returns what it took in *taken
   (may be NULL). SB_FAILED when a value is no longer finite; it names the first such cell. */
sb_status sb_offshore_step(sb_offshore *offshore, double most, double *taken, sb_error *error);

/* The largest stable time step of the present state, s; HUGE_VAL when all is dry. */
double sb_offshore_time_step(sb_offshore *offshore);

/* Read-only rows of the state: value of column i is [j * stride + i]. Valid until the next step or destroy. */
typedef struct sb_offshore_view {
    size_t columns, rows, stride;
    double x, y, cell, time, before, dry_depth; /* m, s; before: the time before the last step */
    const double *bed, *h, *hu, *hv;            /* m, m, m^2/s */
} sb_offshore_view;
sb_offshore_view sb_offshore_read(const sb_offshore *offshore);

/* The water at a place at the last two time levels, and the rates between them. Bilinear between cell centres; cells
   without water take part with the surface of their wet neighbours. */
typedef struct sb_offshore_sample {
    double time[2];             /* s; equal before the first step, when rates are 0 */
    bool wet[2];                /* whether the place has water; otherwise its surface is the bed */
    double bed;                 /* m */
    sb_offshore_water water[2]; /* [0]: earlier level */
    sb_offshore_water rate;     /* m/s, m/s^2 */
} sb_offshore_sample;
/* A place outside of the grid has the values of the nearest edge. */
sb_offshore_sample sb_offshore_at(const sb_offshore *offshore, double x, double y);
/* The same over other ground than the grid's, whose height is `ground`, m: the place has water where that of the cells
   around it stands above this ground. A dry place has the surface of this water, which is below its ground; without
   water in these cells the lower one of ground and bed. */
sb_offshore_sample sb_offshore_over(const sb_offshore *offshore, double x, double y, double ground);

/* Adds depth, m, and momentum per area, m^2/s, to one cell between two steps, for exchange with other models. No more
   water is removed than there is. Returns the depth that was added. The change is booked in the balance. */
double sb_offshore_add(sb_offshore *offshore, size_t column, size_t row, double depth, double hu, double hv);

/* A wave at a place: surface, velocity inwards, and non-hydrostatic pressure, integrated over the depth, over density.
 */
typedef struct sb_offshore_wave {
    double surface, inwards, pressure; /* m, m/s, m^3/s^2 */
} sb_offshore_wave;
/* A face between two parts of the grid. Outside, the water is that of the part within and a wave, which leaves the face
   outwards and does not enter the part within. */
typedef struct sb_offshore_jump {
    size_t column, row;                             /* the cell outside */
    int axis, sign;                                 /* of the next cell within: 0 along x, 1 along y; 1 or -1 */
    sb_offshore_wave outer, outside, within, inner; /* the wave at the centres of the two cells on either side */
} sb_offshore_jump;

/* Sets the jumps of the steps that follow; the caller keeps the array. count 0: none. The volume that they add outside
   is booked as added. */
void sb_offshore_set_jumps(sb_offshore *offshore, const sb_offshore_jump *jumps, size_t count);

/* Volumes in m^3 (one row: m^2, per metre of width). first + entered + added + repaired = now, but for rounding. */
typedef struct sb_offshore_balance {
    double first, now;                 /* at the start, now */
    double entered[SB_OFFSHORE_SIDES]; /* through each side since the start; negative: left */
    double added;                      /* by jumps, and by sb_offshore_add */
    double repaired;                   /* by setting negative depths to 0 */
    double kinetic, potential;         /* now, over density; potential energy from z = 0 */
    double momentum_x, momentum_y;     /* now, over density, m^4/s (m^3/s) */
} sb_offshore_balance;
sb_offshore_balance sb_offshore_find_balance(const sb_offshore *offshore);

/* Steps so far; iterations of the dispersive solve and cells where waves break, in the last step. */
typedef struct sb_offshore_effort {
    uint64_t steps, iterations;
    size_t breaking;
} sb_offshore_effort;
sb_offshore_effort sb_offshore_find_effort(const sb_offshore *offshore);

/* Heap bytes that a grid of so many cells needs, and those of a model. */
size_t sb_offshore_bytes(const sb_offshore_options *options);
size_t sb_offshore_held(const sb_offshore *offshore);

#endif
