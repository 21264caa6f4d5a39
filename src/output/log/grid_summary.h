/* The depth-averaged water in summary.json. */
#ifndef SB_OUTPUT_GRID_SUMMARY_H
#define SB_OUTPUT_GRID_SUMMARY_H

#include "output/log/json.h"

enum { SB_GRID_SIDES = 4 };

/* m^3 (m^2 in 2D): at the start and the end, what entered through each side, what the particles gave, what negative
   depths were made 0 by, and what all this does not explain. */
typedef struct sb_grid_volume {
    double first, now, entered[SB_GRID_SIDES], added, repaired, imbalance;
} sb_grid_volume;

/* The grid beside the particles of a run. */
typedef struct sb_grid_facts_beside {
    size_t columns, rows;
    double cell; /* m */
    uint64_t steps;
    sb_grid_volume volume;
} sb_grid_facts_beside;

/* Writes the object "volume". beside: of a grid beside particles, which may give it water. */
void sb_grid_volume_put(sb_json *json, const sb_grid_volume *volume, bool beside);

/* Writes the object "grid". */
void sb_grid_beside_put(sb_json *json, const sb_grid_facts_beside *grid);

#endif
