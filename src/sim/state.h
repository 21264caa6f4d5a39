/* The simulation's insides, seen by the stages of a step only. Data of a step flow top to bottom. */
#ifndef SB_SIM_STATE_H
#define SB_SIM_STATE_H

#include "physics/wavemaker.h"
#include "sim/cells.h"
#include "sim/constants.h"
#include "sim/sim.h"
#include "sim/space.h"

enum {
    SB_BLOCK = 1024 /* particles per unit of work and of partial sums: fixed, so sums have one order */
};

/* How the water comes to rest before t = 0. */
enum sb_settling {
    SB_RUNNING,  /* not at all: time goes on */
    SB_DAMPED,   /* a sea: part of the velocity is lost in each step; an initial wave is held by a pull */
    SB_CALMED,   /* the same, at settling's end: pressures start from the run's share again */
    SB_CREEPING, /* boxes of water, which nothing holds: all of it */
    SB_POISED,   /* one step that moves nothing and tells how velocities change at t = 0 */
};

/* Where settling is between two of its steps. */
typedef struct sb_settle {
    bool under_way;
    int done, most; /* steps */
    int turn;       /* the step at which the last ones begin */
    int calm;       /* calm steps in a row */
    double speed;   /* m/s, the highest after the last of them; the next one tells it anew, so no checkpoint has it */
    double kinetic; /* J, at the last trial; INFINITY: there was none */
} sb_settle;

/* Images of owned particles beyond the periodic sides: entries n to n + count of the arrays that neighbours
   are read from. */
typedef struct sb_ghosts {
    size_t count;
    uint32_t *of;            /* the owned particle that each copies */
    sb_cells cells;          /* over their records */
    uint64_t *words, *other; /* for their sort */
    size_t of_capacity, words_capacity, other_capacity;
} sb_ghosts;

/* Boundary particles that share one search table: all static ones, or all that move; images beyond periodic
   sides included. */
typedef struct sb_wall_set {
    size_t count;
    sb_record *record; /* sorted by cell; last lane: psi_b in kg (kg/m in 2D) */
    uint32_t *body;    /* model body of each */
    sb_f4 *normal;     /* unit, towards the water; 0 0 0 where the model gives none */
    sb_cells cells;
    uint64_t *near; /* hash set of Z-order blocks with walls in or beside them */
    uint64_t near_mask;
} sb_wall_set;

enum { SB_STATIC, SB_MOVING, SB_WALL_SETS };

/* A body that moves: its boundary particles at rest, and where its paddle is. */
typedef struct sb_moving_body {
    sb_paddle paddle;
    sb_vec3 direction;
    double displacement, next_displacement; /* m, at t and t + dt */
    sb_vec3 velocity;                       /* m/s, between them */
} sb_moving_body;

/* Records next to each other in the arrays that neighbours are read from. */
typedef struct sb_run {
    uint32_t begin, count;
} sb_run;

/* Particles next to each other, and what lies around them; see sim/around.h. */
typedef struct sb_group {
    uint32_t first, end; /* particles [first, end) */
    uint32_t run, runs;  /* around them, themselves included: runs [run, run + runs) */
    uint32_t sleepers;   /* how many records come before the first sleeper's */
    sb_record corner;    /* quanta: no record around is below it, or four cells and more above */
} sb_group;

typedef struct sb_groups {
    sb_group *group;
    size_t count, capacity;
    sb_run *run;
    size_t used, room; /* runs */
} sb_groups;

/* Four neighbours. place: as sb_at wants it. slope: the root of m W'(r)/r times the quantum over sb_lists.unit, below
   2^15, so that unit * slope^2 * offset in quanta = m grad W, the same for both of a pair; a root, because W' fades
   out towards the support radius as a square or faster. */
typedef struct sb_four_pairs {
    uint16_t place[4], slope[4];
} sb_four_pairs;

/* Water around particle i: fours [first[i], first[i] + count[i]), the last filled up with the particle itself at
   slope 0. */
typedef struct sb_lists {
    uint32_t *first; /* n */
    uint16_t *count; /* n */
    sb_four_pairs *four;
    size_t used, capacity; /* fours */
    float unit;            /* < 0 */
} sb_lists;

/* Boundary particles around particle i: [first[i], first[i] + count[i]), padded to four with slope 0. */
typedef struct sb_pairs {
    uint32_t *first; /* n */
    uint16_t *count; /* n, padded to a multiple of 4 */
    uint32_t *index; /* see sim/wall_entry.h */
    float *slope;    /* psi W'(r)/r times the quantum */
    size_t used, capacity;
} sb_pairs;

struct sb_ledger_sums; /* sim/ledger.h */
struct sb_sleep;       /* sim/sleep.h */

enum { SB_SIM_SKIPPED_MAX = 15 };

typedef struct sb_sim {
    const sb_scene *scene;
    const sb_model *model;
    sb_constants constant;
    sb_space space;

    /* persistent fields, n each; moved together by the sort */
    size_t n;            /* those asleep not among them */
    size_t capacity;     /* of position, velocity, acceleration and scratch: n, the ghosts and the fringe */
    sb_record *position; /* quanta; last lane: argument of the pressure operator */
    sb_f4 *velocity;     /* m/s; last lane: pressure in Pa, the next step's warm start */
    uint32_t *id;
    float *deficit; /* by id, kg/m^3, added to the density's sum (sim/deficit.h); NULL: none. NAN: not known yet */

    /* fields of one step */
    sb_f4 *acceleration; /* m/s^2, of the pressure argument; last lane 0. After the stage accelerate:
                            the new velocity and pressure */
    sb_f4 *wall;         /* sum_b psi_b grad W_ib; last lane: sum_b psi_b v_b . grad W_ib */
    sb_f4 *rubbed;       /* m/s^2, by the walls along themselves, of particles beside them; NULL where walls do not */
    float *density;      /* kg/m^3, deficit included */
    float *eddy;         /* m^2/s, nu_t at the step's start; NULL without a turbulence model */
    float *diagonal;     /* -a_ii > 0 for q as unknown; 0: no pressure here */
    float *source;       /* b_i, kg/m^3 */
    float *unknown;      /* q = p / rho^2 */
    float *residual;     /* e_i = (A q)_i - b_i */
    float *direction;    /* of the solver's search; allocated for solvers that need it */
    float *product;      /* A times the argument */
    int last_sweeps;     /* iterations of the step before; 0: there is none */
    bool listed, told;   /* since the last step's end: lists are those of the particles; residual holds the
                            pressures that the water bears (sim/bearing.c) */

    sb_cells cells;
    sb_ghosts ghosts;
    sb_groups groups;
    sb_lists pairs;
    sb_pairs wall_pairs;
    uint64_t *sort_a, *sort_b; /* in the memory of `wall`, which is made after the sort */
    void *scratch;             /* 16 bytes per particle, for the permutation */
    double *partial;           /* per block, 5 values: partial sums */

    sb_wall_set walls[SB_WALL_SETS];
    sb_record *moving_rest; /* boundary particles of moving bodies at displacement 0 */
    uint32_t *moving_rest_body;
    sb_f4 *moving_rest_normal;
    size_t moving_rest_count;
    size_t moving_count;
    sb_moving_body *moving;   /* bodies */
    uint32_t *moving_of_body; /* model body -> index into moving, UINT32_MAX: static */

    double *block_impulse; /* per block and body 9 values, of one step */
    unsigned char *block_touched;
    sb_body_impulse *impulse; /* per body */

    struct sb_sleep *sleep; /* still water left alone; NULL where none was laid to sleep */

    struct sb_ledger_sums *block_ledger; /* per block, of one step */
    sb_ledger ledger;
    sb_vec3 stress_gain; /* kg m/s, of the stage packing in one step; round-off alone */

    enum sb_settling settling;
    sb_settle settle;
    sb_step_report report;
    uint64_t left_domain, lost;
    sb_departures departures; /* sim/departures.h */
    sb_stage_time stage[SB_STAGES_MAX];
    size_t stage_count;
    sb_skipped skipped[SB_SIM_SKIPPED_MAX + 1];
    size_t bytes_fixed;
} sb_sim;

static inline size_t sb_blocks(const sb_sim *sim)
{
    return (sim->n + SB_BLOCK - 1) / SB_BLOCK;
}

static inline size_t sb_block_end(const sb_sim *sim, size_t block)
{
    size_t end = (block + 1) * SB_BLOCK;
    return end < sim->n ? end : sim->n;
}

/* sim/settle.c: whether the step that was the last has been made. What it left behind is not saved: the water is let
   go from it at once. */
bool sb_settle_over(const sb_settle *settle);
/* Horizontal acceleration (m/s^2) that keeps an initial wave's surface level while it settles:
   with g it stands everywhere across the surface, g d(eta)/dx. */
float sb_settle_pull(const sb_sim *sim, sb_record at);
/* sim/sort_stage.c: wraps or drops particles outside, sorts the rest along the Z-curve, builds the cells. */
sb_status sb_stage_sort(sb_sim *sim, sb_error *error);
/* sim/ghosts.c: images of what is near periodic sides, their places and velocities as after the sort. */
sb_status sb_stage_ghosts(sb_sim *sim, sb_error *error);
/* Gives the ghosts the values of a field (a velocity, an acceleration, an eddy viscosity) whose owned part has changed;
   0 to sleepers. */
void sb_ghosts_refresh(const sb_sim *sim, sb_f4 *field);
void sb_ghosts_refresh_values(const sb_sim *sim, float *field);
void sb_ghosts_destroy(sb_sim *sim);
/* Room for `beyond` entries after the owned ones; owned ones and ghosts keep their values. 0, or -1. */
int sb_ghosts_room(sb_sim *sim, size_t beyond);
/* sim/walls.c */
sb_status sb_walls_create(sb_sim *sim, sb_error *error);
void sb_walls_destroy(sb_sim *sim);
/* sim/wall_volumes.c: psi_b = gamma rho_0 / sum_k W_bk over the boundary particles of `set` in reach, itself
   included [A12, eq. 4; S16, eq. 30]; only_own: those of the same body only. The set holds no images. */
int sb_wall_volumes(const sb_sim *sim, sb_wall_set *set, bool only_own);
/* Adds the images beyond periodic sides, with the volume, body and normal of their own. */
int sb_wall_images(sb_wall_set *set, const sb_space *space);
sb_status sb_stage_walls(sb_sim *sim, sb_error *error); /* paddles to t, their table, their velocity */
/* The moving bodies' table at their displacements, when those have been set from outside. */
sb_status sb_walls_restore(sb_sim *sim, sb_error *error);
/* Whether a cell may have boundary particles of the set in reach. */
bool sb_walls_near(const sb_wall_set *set, const sb_space *space, sb_record record);
/* sim/lists.c: lists, densities, wall vectors, diagonal, all in one pass; and for the stage completion, in the
   place of source and residual, the walls' part of the densities and |sum_j m grad W_ij|^2. */
sb_status sb_stage_neighbours(sb_sim *sim, sb_error *error);
/* sim/neighbours.c: sb_lists.unit of a simulation, so that W'/r of coincident particles, the steepest, is 2^15 - 1. */
float sb_lists_unit(const sb_sim *sim);
/* sim/viscosity.c: v* = v + dt (g + viscosity + wall friction). */
sb_status sb_stage_forces(sb_sim *sim, sb_error *error);
/* sim/pressure.c: source, solve, final acceleration. */
sb_status sb_stage_source(sb_sim *sim, sb_error *error);
sb_status sb_stage_pressure(sb_sim *sim, sb_error *error);
/* sim/impulse.c: forces of the water on bodies over the step. */
sb_status sb_stage_impulse(sb_sim *sim, sb_error *error);
/* sim/time_step.c: the report's time step; fails when the run has diverged. */
sb_status sb_stage_time_step(sb_sim *sim, sb_error *error);
/* sim/integrate.c: fails with where the particle is and the velocity that it would reach. */
sb_status sb_sim_diverged(const sb_sim *sim, size_t particle, sb_f4 velocity, sb_error *error);
sb_status sb_stage_accelerate(sb_sim *sim, sb_error *error); /* new velocities, in acceleration */
sb_status sb_stage_move(sb_sim *sim, sb_error *error);

#endif
