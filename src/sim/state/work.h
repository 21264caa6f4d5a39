/* The workspace of a step: the arrays that its stages hand on to each other. They share one block of memory. Each array
   is a view with a lifetime, from the phase that writes it to the last phase that reads it; views whose lifetimes
   overlap have separate memory. Nothing in it outlives the step but what a snapshot or a query reads. */
#ifndef SB_SIM_WORK_H
#define SB_SIM_WORK_H

#include "base/exact.h"
#include "sim/needs.h"
#include "sim/search/pairs.h"
#include "sim/sim.h"

/* The phases of a step, in order: its stages, of which the stress correction has three. */
typedef enum sb_phase {
    SB_PHASE_SORT,
    SB_PHASE_GHOSTS,
    SB_PHASE_NEIGHBOURS,
    SB_PHASE_DENSITY_CORRECTION,
    SB_PHASE_STRAIN,
    SB_PHASE_DEVIATOR, /* stress correction: deviators, their means, velocities */
    SB_PHASE_STRESS,
    SB_PHASE_CORRECTED,
    SB_PHASE_TURBULENCE,
    SB_PHASE_FORCES,
    SB_PHASE_SOURCE,
    SB_PHASE_PRESSURE,
    SB_PHASE_ACCELERATE,
    SB_PHASE_IMPULSE,
    SB_PHASE_FOAM,
    SB_PHASE_MOVE,
    SB_PHASE_AFTER, /* snapshots and queries between two steps */
    SB_PHASES
} sb_phase;

/* Sums over all particles in one step, per unit of mass. v is the velocity at the step's start, after the stress
   correction; v* that before the pressure; w that at the step's end. With u = (v + w)/2 a change d of the velocity does
   the work d.u. */
typedef struct sb_ledger_sums {
    double forces;         /* (v* - v).u: gravity, viscosity, friction, hydrostatic push of images */
    double solve;          /* (w - v*).u: pressure and contact */
    double fall;           /* z component of u, m/s */
    double rise;           /* change of z in the step, quanta */
    double gain[3], size;  /* w - v, and |w - v| */
    double friction;       /* part of the forces, over dt */
    double contact;        /* part of the solve */
    double contact_bodies; /* work of moving bodies by contact */
} sb_ledger_sums;

/* Progress of the step's pressure solve. */
typedef struct sb_solve {
    int iterations, last; /* so far; those of the step before, 0: no step before */
    double tolerance;     /* relative density error at which it stops */
    double first;         /* residual of the initial guess */
    bool capped;          /* it stopped at max_iterations above its tolerance */
} sb_solve;

/* No body: there are no boundary particles around a particle; or they are of several bodies or images of them. */
#define SB_WALL_NONE UINT32_MAX
#define SB_WALL_SEVERAL (UINT32_MAX - 1)

enum { SB_FORCE_VALUES = 9 }; /* of a body: pressure and drag, N, and moment, N m: three components each */

/* Sums over the particles of a cell: yy, xy, xz, yz of their strains; xx, and their number. */
typedef struct sb_cell_sum {
    sb_f4 rest, more;
} sb_cell_sum;

/* A particle's stress or rate of strain without trace: xx, and yy, xy, xz, yz. In views that neighbours read xx is
   carried by the records (sb_pressure_load). */
typedef struct sb_work {
    sb_lists pairs; /* with fluid particles, and with boundary particles */
    sb_pairs wall_pairs;
    sb_edge_pairs edge_pairs;

    uint64_t *sort_words, *sort_other; /* keys and indices */
    sb_record *sorted;                 /* one state field of any type, in its new order */
    sb_record *images;                 /* beyond periodic sides, in the order of their originals */

    sb_f4 *wall;          /* sum_b psi_b grad W_ib; last lane: sum_b psi_b v_b . grad W_ib; NULL: walls reflect */
    float *flux;          /* the last lane of `wall` by walls that reflect; NULL: they do not */
    sb_f4 *image_push;    /* m/s^2, by the hydrostatic part of the pressure of images; NULL: walls do not reflect */
    float *density;       /* kg/m^3, density correction included */
    float *water_squared; /* |sum_j m grad W_ij|^2 */
    float *diagonal;      /* -a_ii > 0 for q as unknown; over dt^2 before the stage pressure; 0: no pressure here */

    float *last_unknown; /* q of the last step, Pa m^6/kg^2 */
    float *strained;     /* kg/m^3/s, sum of the packing strain */
    float *deviator_xx, *stress_xx;
    sb_f4 *deviator, *stress;
    sb_cell_sum *cell_sum; /* by cell: owned, of the halo, of images (sim/terms/cell_mean.h) */
    size_t cell_sum_capacity;
    double *node; /* SB_TENSION_VALUES per node of a grid around the water; NULL without surface tension */
    size_t node_capacity;
    sb_f4 *corrected; /* m/s, velocity after the stress correction */

    float *eddy;         /* m^2/s, nu_t at the step's start, and of viscous sponges; NULL without both */
    sb_f4 *wall_drag;    /* m/s^2, by friction and shear of walls, for particles beside walls; NULL without drag */
    uint32_t *wall_body; /* the body of all boundary particles around a particle, or SB_WALL_NONE, SB_WALL_SEVERAL; NULL
                            with lists of them, or without drag */
    sb_f4 *pull;         /* m/s^2, by surface tension (sim/terms/surface_tension.h); NULL without it */
    sb_f4 *differences;  /* m/s, L v of hyperviscosity; NULL without it */
    sb_f4 *predicted;    /* m/s, v*: the velocity before the pressure */

    float *source;       /* b_i, kg/m^3 */
    float *rate;         /* kg/m^3/s, of the density, of wcsph; NULL: steps are implicit */
    float *unknown;      /* q = p / rho^2 */
    float *residual;     /* e_i = (A q)_i - b_i */
    float *direction;    /* search direction of the solver; NULL: it needs none */
    float *product;      /* A times the argument; NULL: not needed */
    sb_f4 *acceleration; /* m/s^2, by the pressure argument; last lane 0 */
    /* The same of the sweep that comes next, if the stopping test lets it; NULL: it is not begun before. */
    float *unknown_ahead;
    sb_f4 *acceleration_ahead;
    size_t groups_ahead; /* inner groups whose accelerations ahead are there */
    sb_f4 *end_velocity; /* m/s, at t + dt; last lane: pressure in Pa */
    sb_f4 *surface;      /* unit normal out of the water, and the length of which it is a fraction (sim/foam/foam.h) */
    uint32_t *emission;  /* particles of foam to be emitted: their expected number, then their first index */
    float *virial;       /* Pa, virial pressures (sim/terms/virial_pressure.c) */

    uint64_t everywhere;  /* owned particles of all domains */
    double *body_force;   /* per body SB_FORCE_VALUES values, of all domains */
    double *stress_force; /* the same by the stress correction, with images, or by the pressures of
                            dynamic boundary particles; else 0 */
    sb_ledger_sums sums;
    double first_rise;   /* quanta, sum of the changes of z in the first half; else 0 */
    double sponge_work;  /* per unit of mass, by sponges */
    double tension_work; /* per unit of mass, by surface tension */
    sb_vec3 sponge_gain; /* kg m/s, momentum by sponges */
    sb_vec3 stress_gain; /* kg m/s, momentum from the stress correction: only round-off */
    sb_solve solve;
    bool lists_current; /* the lists and densities belong to the present particles */
    bool virial_known;

    void *block;            /* of all views */
    size_t bytes;           /* of the block */
    size_t owned, capacity; /* entries of views without and with ghosts */
} sb_work;

/* One view. Its phases include both ends. */
typedef struct sb_work_view {
    const char *name, *unit;
    size_t pointer; /* offset of the typed pointer in sb_work */
    size_t size;    /* bytes of an entry */
    bool ghosts;    /* whether it has entries for ghosts */
    sb_phase first, last;
    /* Name of a view whose memory it takes over: entry i is written after entry i of the other has been read for the
       last time. NULL: none. */
    const char *replaces;
    size_t needed; /* flag of sb_needs, or SB_ALWAYS */
} sb_work_view;

/* Ends with a row without name. */
extern const sb_work_view sb_work_views[];

/* Allocates the block and places the views in it: `owned` entries, `capacity` of those with ghosts. A block that exists
   is freed first. Returns 0, or -1 without memory. */
int sb_work_create(sb_work *work, const sb_needs *needs, size_t owned, size_t capacity);
void sb_work_destroy(sb_work *work);
/* Bytes per particle that a view which the scene does not need would add; 0 if it would share memory with others. */
size_t sb_work_cost(const sb_needs *needs, const char *name);

#ifdef SB_DEBUG
/* Fills the views that begin in a phase with NaN, so that a stage that reads what nothing has written is found. */
void sb_work_enter(sb_work *work, sb_phase phase);
#else
static inline void sb_work_enter(sb_work *work, sb_phase phase)
{
    (void)work, (void)phase;
}
#endif

#endif
