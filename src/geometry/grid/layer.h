/* One file of a terrain: where it lies, and its heights. Private to src/geometry/grid. */
#ifndef SB_GEOMETRY_GRID_LAYER_H
#define SB_GEOMETRY_GRID_LAYER_H

#include "geometry/grid/projection.h"
#include "geometry/grid/raster.h"

enum { SB_LAYER_SYSTEM = 400 };

typedef struct sb_layer {
    const char *path;
    double datum;                 /* m, added to its heights */
    bool down;                    /* its numbers are depths, which become heights when they are read */
    bool raster;                  /* read in part, by raster.h; else whole, as text */
    sb_raster_about about;        /* of a text grid: its nodes only */
    char system[SB_LAYER_SYSTEM]; /* its coordinate system; "": none */
    sb_projection_unit unit;      /* of that */
    sb_projection *projection;    /* to that of the ground; NULL: the same */
    sb_terrain_area area;         /* its cells, in m of the ground's projection */
    double cell;                  /* m, the smaller side of a cell in its middle */
    sb_grid grid;                 /* in file units; heights NULL: not read yet */
} sb_layer;

/* Reads what a file states, and a text grid. `crs`: the system that the scene gives; "" or NULL: the file's own. */
sb_status sb_layer_open(const char *path, const char *crs, double datum, sb_layer *layer, sb_error *error);
void sb_layer_close(sb_layer *layer);

/* The rectangle of a grid's cells, in file units. */
sb_terrain_area sb_layer_cells(const sb_raster_about *about);

/* Sets projection, area and cell for the ground's projection; "": the layer is in m of it. */
sb_status sb_layer_project(sb_layer *layer, const char *to, sb_error *error);

/* Reads the nodes within the area (m of the projection) and `around` more at each side; a text grid is cut to them. An
   area without nodes gives a layer whose heights are NULL. */
sb_status sb_layer_load(sb_layer *layer, const sb_terrain_area *area, int around, sb_error *error);

/* The height at a place in m of the projection, as sb_grid_height. */
double sb_layer_height(const sb_layer *layer, double x, double y);

#endif
