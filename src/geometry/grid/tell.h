/* Describes a terrain for `check`. Private to src/geometry/grid. */
#ifndef SB_GEOMETRY_GRID_TELL_H
#define SB_GEOMETRY_GRID_TELL_H

#include "geometry/grid/layer.h"

/* A terrain that is made. */
typedef struct sb_terrain {
    size_t count;
    sb_layer *layers;                 /* coarse first */
    char projection[SB_LAYER_SYSTEM]; /* "": the files name none */
    bool zone;                        /* the projection is the UTM zone of the finest file */
    sb_terrain_area area;             /* m of the projection */
    sb_grid grid;
    size_t voids, filled, outside; /* nodes without a height in the files, of these filled, in no file */
} sb_terrain;

/* Writes lines without a newline at the end: for each file its coordinate system, extent, resolution and vertical
   system; then those of the ground, its heights and voids, and how the body moves it. The caller frees *text. */
sb_status sb_terrain_tell(const sb_body *body, const sb_terrain *ground, char **text, sb_error *error);

#endif
