/* summary.json of a run of the depth-averaged model. */
#ifndef SB_APP_GRID_REPORT_H
#define SB_APP_GRID_REPORT_H

#include "app/grid/water.h"
#include "output/log/grid_summary.h"

typedef struct sb_grid_summary {
    const sb_scene *scene;
    const sb_offshore *water;
    const sb_grid_facts *facts;
    sb_status status;
    const char *reason;                      /* NULL unless it failed */
    double wall, processor, setup, stepping; /* s of wall time, of all threads; before the first step; of steps */
    uint64_t iterations;
    size_t breaking; /* most cells that broke at one time */
    size_t frames;
    int threads;
} sb_grid_summary;

/* Writes the file completely or not at all. */
sb_status sb_grid_summary_write(const char *path, const sb_grid_summary *summary, sb_error *error);

/* Volume that the balance does not explain, m^3 (m^2 in 2D). */
double sb_grid_imbalance(const sb_offshore_balance *balance);

/* The balance of the model's volume. */
sb_grid_volume sb_grid_volume_of(const sb_offshore *water);

/* Estimates for the time that the model runs. */
typedef struct sb_grid_cost {
    double cells, time_step, bytes, steps, seconds; /* s of the first step, bytes, s of wall time */
} sb_grid_cost;
sb_grid_cost sb_grid_find_cost(const sb_scene *scene, sb_offshore *water, double time);

#endif
