/* The depth-averaged model's arrays. Private to src/offshore. */
#ifndef SB_OFFSHORE_STATE_H
#define SB_OFFSHORE_STATE_H

#include "offshore/offshore.h"

#include <math.h>

/* Layers of cells beyond each side: a face needs the slopes of both cells, and a slope needs both neighbours. */
enum { SB_OFFSHORE_BEYOND = 2 };

/* Slopes of the bed beyond which the dispersive equations do not hold. */
#define SB_OFFSHORE_STEEPEST 0.5

/* Conserved values per cell: depth, m, and momentum, m^2/s. */
typedef struct sb_offshore_level {
    double *h, *hu, *hv;
} sb_offshore_level;

/* Velocity of water of depth h with the momentum q: q / h in water deeper than dry, m, and 0 with the depth
   (primitives.c). */
static inline double sb_offshore_velocity(double q, double h, double dry)
{
    return h > 0 ? 2 * h * q / (h * h + fmax(h * h, dry * dry)) : 0;
}

/* What a paddle does at its side. */
typedef struct sb_offshore_push {
    double velocity, rate; /* m/s inwards; m/s^2, at the place */
    double phase;          /* m/s, speed of the phase of its wave */
    bool form;             /* this wave keeps its form */
} sb_offshore_push;

/* Arrays have `stride` x `lines` values. Cell (0, 0) has index `origin`; cells beyond the sides surround it. With one
   row there are none beyond it along y. */
struct sb_offshore {
    sb_offshore_options options;
    size_t stride, lines, origin, cells; /* cells: stride x lines */
    const sb_offshore_jump *jumps;       /* of the next step; borrowed */
    size_t jump_count;
    sb_offshore_push push;    /* at the time of the level whose fluxes are next */
    double time, before_time; /* s, of now and of before */
    double longest;           /* s, longest stable time step so far; 0: none */
    uint64_t steps;
    double *bed;
    sb_offshore_level now, before, stage;      /* a step writes its result over `before` */
    double *surface, *u, *v;                   /* of the level whose fluxes are next */
    double *force_x, *force_y;                 /* m^2/s^2, dispersive force on hu and hv; NULL: none */
    struct sb_offshore_dispersion *dispersion; /* NULL: none */
    double *line_speed;                        /* 1/s, per line: greatest sum of wave speeds over cells */
    double *line_repaired;                     /* m, per line */
    double *edge;    /* m^2/s into the grid through x_min and x_max, per line; y_min, y_max per column */
    double *scratch; /* SB_OFFSHORE_ROWS rows per thread */
    int scratch_threads;
    double entered[SB_OFFSHORE_SIDES], added, repaired, first;          /* m^3 */
    double pending[SB_OFFSHORE_SIDES], pending_repaired, pending_added; /* m^3, of the step in progress */
};

/* create.c */
bool sb_offshore_flat(const sb_offshore *offshore); /* one row: nothing varies along y */

/* sample.c: the four cells around a place, and their weights; (column, row) is the first of them. */
typedef struct sb_offshore_corners {
    size_t column, row, at[4];
    double weight[4];
} sb_offshore_corners;
sb_offshore_corners sb_offshore_around(const sb_offshore *offshore, double x, double y);

/* sides.c: fills the cells beyond the sides of a level at that time. */
void sb_offshore_fill_sides(const sb_offshore *offshore, const sb_offshore_level *level, double time);

/* primitives.c: surface and velocities of a level, and line_speed. */
void sb_offshore_find_primitives(sb_offshore *offshore, const sb_offshore_level *level);

/* update.c: out = keep * first + (1 - keep) * (in + dt * L(in)), where the primitives are those of `in`. Adds the
   volume through the sides with weight 1 - keep, and negative depths that it sets to 0. */
typedef struct sb_offshore_update {
    const sb_offshore_level *first, *in, *out;
    double keep, dt;
} sb_offshore_update;
void sb_offshore_advance(sb_offshore *offshore, const sb_offshore_update *update);

/* friction.c: Manning's friction over dt, implicit. */
void sb_offshore_apply_friction(const sb_offshore *offshore, const sb_offshore_level *level, double dt);

/* Doubles of scratch per thread: rows of slopes and fluxes, see update.c. */
enum { SB_OFFSHORE_ROWS = 24 };

#endif
