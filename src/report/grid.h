/* A map of a run (maps/<name>.asc) in memory, and as a picture. */
#ifndef SB_REPORT_GRID_H
#define SB_REPORT_GRID_H

#include "render/image/image.h"

#include <stddef.h>

typedef struct sb_grid {
    size_t columns, rows;
    double x_min, y_min, cell; /* m */
    float *values;             /* row 0 is the northernmost; NaN: never wet */
    double low, high;          /* of the values that are not NaN */
    size_t wet;                /* number of these */
} sb_grid;

/* SB_BAD_INPUT names the file, the line or the number of values, and what was expected. */
sb_status sb_grid_read(const char *path, sb_grid *grid, sb_error *error);
void sb_grid_free(sb_grid *grid);

/* Halves the grid until neither side has more than `most` cells: each cell has the greatest of its values. */
sb_status sb_grid_coarsen(sb_grid *grid, size_t most, sb_error *error);

/* Colours: fractions of the range in increasing order. Reads at most SB_STOPS_MAX from a palette of sb_map_row. */
enum { SB_STOPS_MAX = 8 };
typedef struct sb_stops {
    size_t count;
    double at[SB_STOPS_MAX];
    unsigned char rgb[SB_STOPS_MAX][3];
} sb_stops;
sb_stops sb_stops_of(const char *palette);

/* Colours the values from `low` to `high`; cells that never were wet are light grey. */
sb_status sb_grid_draw(const sb_grid *grid, const sb_stops *stops, double low, double high, sb_image *image,
                       sb_error *error);

#endif
