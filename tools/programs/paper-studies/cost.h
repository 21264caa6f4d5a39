/* Run time of a run, divided as in the paper. */
#ifndef SB_PAPER_STUDIES_COST_H
#define SB_PAPER_STUDIES_COST_H

#include "base/status.h"

/* Times in s of all processes of a run. Settling, which the published runs do not have, is separate. */
typedef struct sb_cost {
    double fluid, boundary, threads, steps, simulated, sweeps; /* sweeps: mean per step */
    double setup, settling;                                    /* before the first step; settling */
    double total;                                              /* T: sum of the four below, as in the paper */
    double structure;                                          /* T_c: sort and ghosts */
    double query;                                              /* T_q: neighbours, and with them density, B and A_ii */
    double advection;                                          /* T_a: all other stages */
    double pressure;                                           /* T_p: the solve */
    double other;                                              /* the rest without settling: set-up, measuring, files */
} sb_cost;

/* Reads the cost from the text of a run's summary.json. SB_BAD_INPUT: it has no stages. */
sb_status sb_cost_read(const char *summary, sb_cost *cost, sb_error *error);

/* ns per fluid particle and step. */
double sb_cost_per_particle_step(double seconds, double fluid, double steps);

/* Extrapolates the cost of some steps to a run of `steps` steps with `sweeps` each. The solve is proportional to the
   sweeps, other stages to the steps; the rest stays the same. */
sb_cost sb_cost_extrapolate(const sb_cost *some, double steps, double sweeps);

#endif
