/* Assembles the ground of a body from its grids. Private to src/geometry. */
#ifndef SB_GEOMETRY_TERRAIN_H
#define SB_GEOMETRY_TERRAIN_H

#include "geometry/grid/grid.h"

/* Whether the body's grid needs more than sb_mesh_import_grid does: another file format, several files, or a key for
   its projection, window, resampling or voids. */
bool sb_terrain_applies(const sb_body *body);

/* Reads the body's grids and makes its ground, in m of the projection less body->origin; heights as in the files, plus
   the datum of each file of a stack. mesh->told describes it.
   Projection: body->projection; else that of the first file with a system in metres; else, with degrees, the UTM zone
   of the middle of the finest such file. A file without a system is taken to be in m of the projection.
   Area: body->window; else `wanted` and two cells; NULL: all of the files.
   Nodes: those of the file if there is one file, in that projection, without body->resample; else a grid of
   body->resample, or of the finest cell, whose nodes are at multiples of it. A file covers files with larger cells.
   SB_BAD_INPUT "file: what, expected", SB_INTERRUPTED. */
sb_status sb_terrain_make(const sb_body *body, const sb_terrain_area *wanted, sb_mesh *mesh, sb_error *error);

#endif
