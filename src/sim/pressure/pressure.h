/* The pressure problem of one step and its solvers.
   Unknown q = p/rho^2 >= 0; A q = dt^2 div(G q) is symmetric and negative semidefinite; with
   e = A q - b (predicted excess density) the solution has q >= 0, e <= 0, q e = 0. */
#ifndef SB_SIM_PRESSURE_H
#define SB_SIM_PRESSURE_H

#include "sim/sim.h"
#include "sim/state/simd.h"

/* Error of the present iterate. */
typedef struct sb_pressure_error {
    double mean; /* of max(0, e) over all particles, relative to the rest density */
    /* Natural residual of the complementarity problem q >= 0, -e >= 0, q e = 0: mean over all particles of
       |min(D q, -e)|, with D = -a_ii, relative. It is 0 at the solution only. */
    double residual;
    double max; /* of max(0, e), relative */
} sb_pressure_error;

/* A solver starts from sim->work.unknown and sim->work.source, and leaves its iterate in sim->work.unknown. It updates
   sim->work.solve.iterations and error_* by sb_pressure_judge. */
typedef struct sb_pressure_solver {
    const char *name, *summary, *reference;
    bool needs_direction, needs_product;              /* fields needed in addition to residual */
    bool goes_ahead;                                  /* on several ranks: sb_pressure_ahead */
    sb_status (*solve)(sb_sim *sim, sb_error *error); /* NULL: steps have no solve */
} sb_pressure_solver;

/* Rows in the order of enum sb_solver. */
extern const sb_pressure_solver *const sb_pressure_solvers[];
extern const sb_pressure_solver sb_solver_jacobi, sb_solver_chebyshev, sb_solver_cg;
/* No solver: explicit steps (sim/wcsph/wcsph.h). */
extern const sb_pressure_solver sb_solver_wcsph;

/* Largest eigenvalue of D^-1 A that the solvers assume: that of a full lattice with a margin for disorder and walls. */
double sb_pressure_spectrum(const sb_sim *sim);
/* Violently moving water may have larger ones: the error then grows from sweep to sweep. True when it has doubled since
   the least of this solve, or since it last had; *least, at first INFINITY, follows it. The solver then assumes an
   eigenvalue SB_PRESSURE_WIDER times as large. */
bool sb_pressure_grown(const sb_pressure_error *error, double *least);
static const double SB_PRESSURE_WIDER = 1.4;

/* Copies a field into the last lane of the records: the argument of the next product. */
void sb_pressure_load(sb_sim *sim, const float *argument);
/* The same for the pass over groups that comes next: that of other domains is still on its way. */
void sb_pressure_load_begin(sb_sim *sim, const float *argument);
/* The first pass of a product: acceleration = G argument, 0 for particles that are held to a given sea. */
void sb_pressure_accelerate(sb_sim *sim);
/* The second pass of a product: out = dt^2 [sum_j m (a_i - a_j) . grad W_ij + a_i . B_i]. The accelerations of the
   ghosts must be up to date. */
void sb_pressure_diverge(sb_sim *sim, float *out);
/* out = A argument, both passes: dt^2 [sum_j m (a_i - a_j) . grad W_ij + a_i . B_i]. */
void sb_pressure_product(sb_sim *sim, float *out);

/* residual = A unknown - source. Leaves the acceleration G unknown in sim->work.acceleration. */
void sb_pressure_residual(sb_sim *sim);

/* Computes the errors of the residual field, and adds one iteration to the report. */
sb_pressure_error sb_pressure_judge(sb_sim *sim);
/* The same in two parts, of several domains: the errors' sums are on their way in between. */
void sb_pressure_judge_begin(sb_sim *sim);
sb_pressure_error sb_pressure_judge_end(sb_sim *sim);

/* In between: begins the first pass of the next product, of work.unknown_ahead, over groups that read no ghosts, until
   the sums have come. Then one of the others is called: `keep` makes the unknown ahead the unknown, and
   sb_pressure_residual goes on with the pass; `drop` forgets it. Until then the unknown and its acceleration are as
   they were. */
void sb_pressure_ahead(sb_sim *sim);
void sb_pressure_keep_ahead(sb_sim *sim);
void sb_pressure_drop_ahead(sb_sim *sim);

/* Whether the error meets the tolerance. */
bool sb_pressure_met(const sb_sim *sim, const sb_pressure_error *error);
/* Whether the tolerance is met or max_iterations have been done; sets `capped` of work.solve in the second case. */
bool sb_pressure_done(sb_sim *sim, const sb_pressure_error *error);

#endif
