/* Depth-averaged models whose bed and water are functions of the place, for tests. */
#ifndef SB_TESTS_OFFSHORE_GRID_CASE_H
#define SB_TESTS_OFFSHORE_GRID_CASE_H

#include "../check.h"
#include "offshore/offshore.h"

typedef struct grid_water {
    double h, u, v;
} grid_water;

typedef double grid_bed(double x, double y);
typedef grid_water grid_state(double x, double y, double time);

/* A model with the values at cell centres at t = 0; fails the test on an error. */
sb_offshore *grid_create(const sb_offshore_options *options, grid_bed *bed, grid_state *state);

/* Steps to exactly this time. */
void grid_run(sb_offshore *offshore, double until);

/* Mean over the grid of |h - exact| at the model's time, m. */
double grid_error(const sb_offshore *offshore, grid_state *exact);

/* Greatest |u|, |v| where the water is deeper than dry_depth, m/s. */
double grid_fastest(const sb_offshore *offshore);

/* Volume that the balance does not explain, relative to the volume. */
double grid_imbalance(const sb_offshore *offshore);

#endif
