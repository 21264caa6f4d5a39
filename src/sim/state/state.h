/* The simulation's internal state, private to src/sim. */
#ifndef SB_SIM_STATE_H
#define SB_SIM_STATE_H

#include "sim/exchange/ghosts.h"
#include "sim/search/cells.h"
#include "sim/search/pairs.h"
#include "sim/sim.h"
#include "sim/state/constants.h"
#include "sim/state/space.h"
#include "sim/step/settle.h"
#include "sim/walls/walls.h"

enum {
    SB_BLOCK = 1024 /* particles per unit of work */
};

enum { SB_FORCE_VALUES = 9 }; /* of a body: pressure and drag, N, and moment, N m: three components each */

/* Sums over all particles in one step, per unit of mass. v is the velocity at the step's start, after the stress
   correction; v* that before the pressure; w that at the step's end. With u = (v + w)/2 a change d of the velocity does
   the work d.u. */
typedef struct sb_ledger_sums {
    double forces;         /* (v* - v).u: gravity, viscosity, friction */
    double solve;          /* (w - v*).u: pressure and contact */
    double fall;           /* z component of u, m/s */
    double rise;           /* change of z in the step, quanta */
    double gain[3], size;  /* w - v, and |w - v| */
    double friction;       /* part of the forces, over dt */
    double contact;        /* part of the solve */
    double contact_bodies; /* work of moving bodies by contact */
} sb_ledger_sums;

struct sb_passes; /* sim/passes/passes.h */

enum { SB_SIM_SKIPPED_MAX = 15 };

struct sb_sim {
    const sb_scene *scene;
    const sb_model *model;
    sb_constants constant;
    sb_space space;
    const struct sb_passes *passes; /* of the pressure solve, in the implementation for this processor */

    /* persistent fields, n entries each; the sort reorders them together */
    size_t n;
    size_t capacity;           /* entries of position, velocity, acceleration and scratch: n and the ghosts */
    sb_record *position;       /* quanta; last lane: argument of the pressure operator */
    sb_f4 *velocity;           /* m/s; last lane: pressure in Pa, the next step's warm start */
    uint32_t *id;              /* a particle keeps its number, and no number is used twice */
    sb_f4 *start_velocity;     /* m/s, at t = 0; NULL after settling, and where all are 0 */
    float *density_correction; /* c_i by id, kg/m^3 (sim/terms/density_correction.h); NULL: off. NAN: not known yet */

    /* fields of one step */
    sb_f4 *acceleration; /* m/s^2, by the pressure argument; last lane 0. After the stage accelerate: new velocity and
                            pressure */
    sb_f4 *wall;         /* sum_b psi_b grad W_ib; last lane: sum_b psi_b v_b . grad W_ib */
    sb_f4 *wall_drag;    /* m/s^2, by friction and shear of walls, for particles beside walls; NULL without drag */
    float *density;      /* kg/m^3, density correction included */
    float *eddy;         /* m^2/s, nu_t at the step's start; NULL without a turbulence model */
    float *diagonal;     /* -a_ii > 0 for q as unknown; 0: no pressure here */
    float *source;       /* b_i, kg/m^3 */
    float *unknown;      /* q = p / rho^2 */
    float *residual;     /* e_i = (A q)_i - b_i */
    float *direction;    /* search direction of the solver; allocated for solvers that need it */
    float *product;      /* A times the argument; allocated for solvers that need it */
    int last_sweeps;     /* iterations of the step before; 0: no step before */
    bool lists_current;  /* the lists belong to the present particles */
    bool virial_known;   /* residual holds the virial pressures (sim/terms/virial_pressure.c) */

    sb_cells cells;
    sb_ghosts ghosts;
    sb_groups groups;
    sb_lists pairs;
    sb_pairs wall_pairs;
    uint64_t *sort_a, *sort_b; /* in the memory of `wall`, which is computed after the sort */
    void *scratch;             /* 16 bytes per particle, for the permutation */

    sb_wall_set walls[SB_WALL_SETS];
    sb_record *moving_rest; /* boundary particles of moving bodies at displacement 0 */
    uint32_t *moving_rest_body;
    sb_f4 *moving_rest_normal;
    size_t moving_rest_count;
    size_t moving_count;
    sb_moving_body *moving;   /* bodies */
    uint32_t *moving_of_body; /* model body -> index into moving, UINT32_MAX: static */

    double *body_force;       /* per body SB_FORCE_VALUES values, of one step */
    sb_body_impulse *impulse; /* per body */

    sb_ledger_sums step_sums; /* of one step */
    sb_ledger ledger;
    sb_vec3 stress_gain; /* kg m/s, momentum from the stress correction in one step: only round-off */

    enum sb_settling settling;
    sb_settle settle;
    sb_step_report report;
    uint64_t left_domain, lost;
    sb_departures departures; /* sim/search/departures.h */
    sb_stage_time stage[SB_STAGES_MAX];
    size_t stage_count;
    sb_skipped skipped[SB_SIM_SKIPPED_MAX + 1];
    size_t bytes_fixed;
};

static inline size_t sb_blocks(const sb_sim *sim)
{
    return (sim->n + SB_BLOCK - 1) / SB_BLOCK;
}

static inline size_t sb_block_end(const sb_sim *sim, size_t block)
{
    size_t end = (block + 1) * SB_BLOCK;
    return end < sim->n ? end : sim->n;
}

#endif
