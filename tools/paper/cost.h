/* What a run cost, in the paper's terms. */
#ifndef SB_PAPER_COST_H
#define SB_PAPER_COST_H

#include "base/status.h"

/* Times in s, of all the processes that worked on a run. What it took to bring the water to rest, which the published
   runs do not do, stands by itself. */
typedef struct sb_cost {
    double fluid, boundary, threads, steps, simulated, sweeps; /* sweeps: mean per step */
    double setup, settling;                                    /* before the first step; bringing the water to rest */
    double total;                                              /* T: the sum of the four below, as theirs is */
    double structure;                                          /* T_c: sort and ghosts */
    double query;                                              /* T_q: neighbours, and with them density, B and A_ii */
    double advection;                                          /* T_a: all other stages */
    double pressure;                                           /* T_p: the solve */
    double other;                                              /* all else but settling: set-up, measuring, files */
} sb_cost;

/* From the text of a run's summary.json. SB_BAD_INPUT when it has no stages. */
sb_status sb_cost_read(const char *summary, sb_cost *cost, sb_error *error);

/* ns per fluid particle and step. */
double sb_cost_per_particle_step(double seconds, double fluid, double steps);

/* A whole run of `steps` steps with `sweeps` each, from the cost of some: stages but the solve go with
   steps, the solve with sweeps; all else is left as it is. */
sb_cost sb_cost_extrapolate(const sb_cost *some, double steps, double sweeps);

#endif
