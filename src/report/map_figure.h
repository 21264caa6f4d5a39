/* A map in a page: a picture within SVG, with axes in m, marks and a legend. */
#ifndef SB_REPORT_MAP_FIGURE_H
#define SB_REPORT_MAP_FIGURE_H

#include "report/grid.h"

#include <stdio.h>

enum { SB_MAP_SIDE_MAX = 500 }; /* cells of a map in a page, in each direction */

typedef struct sb_map_look {
    const char *label, *palette; /* of the legend; as in sb_map_row */
    double low, high;            /* range of the colours */
} sb_map_look;

typedef struct sb_map_mark {
    const char *name; /* appears under the pointer */
    double x, y;      /* m; marks outside of the grid are left out */
    bool gauge;       /* a circle; else a body, a square */
} sb_map_mark;

/* Writes the figure; nothing if it fails. */
sb_status sb_map_figure(FILE *out, const sb_grid *grid, const sb_map_look *look, const sb_map_mark *marks, size_t count,
                        sb_error *error);

#endif
