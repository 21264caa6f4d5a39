/* The maps of a run, maps/<name>.asc. Each is one row of a table, by which it is written and plotted. */
#ifndef SB_OUTPUT_MAPS_H
#define SB_OUTPUT_MAPS_H

#include "base/status.h"
#include "frame/records.h"

typedef struct sb_map_row {
    const char *name, *grid_name; /* of a run's only model of water; of the grid beside particles */
    size_t values;                /* offset of its values in sb_map_record */
    const char *label;            /* of the colours in the plot, with the unit */
    const char *palette;          /* gnuplot: fraction of the range and colour, ... */
    bool from_zero;               /* the range of colours begins at 0 */
    bool drawn;                   /* in plots and reports */
} sb_map_row;

/* All maps; the last row has no name. */
extern const sb_map_row sb_map_rows[];

/* The name of a map; NULL after the last one. */
const char *sb_map_name(size_t map);

const char *sb_grid_map_name(size_t map);

/* Writes maps/<name>.asc for each row whose values are recorded, below directory. beside: of the grid beside
   particles. */
sb_status sb_maps_write(const char *directory, const sb_map_record *map, bool beside, sb_error *error);

#endif
