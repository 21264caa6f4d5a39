/* Heights of a grid that are most likely missing ones (nodata), whose value the file does not state. */
#ifndef SB_GEOMETRY_GRID_MISSING_H
#define SB_GEOMETRY_GRID_MISSING_H

#include "base/status.h"
#include "geometry/mesh/mesh.h"

/* Nodes whose heights are far from all others. */
typedef struct sb_missing {
    size_t count, first; /* their number, and the vertex of the first one */
    double least, most;  /* m, their heights */
    double low, high;    /* m, the heights of all others */
} sb_missing;

/* Searches the nodes in the box, seen from above; a node outside of it counts, too, if one of its triangles is partly
   within. The box's range of z is that of which the ground is expected. SB_FAILED without memory. */
sb_status sb_missing_find(const sb_mesh *mesh, sb_vec3 min, sb_vec3 max, sb_missing *found, sb_error *error);

/* Writes what is wrong with them; box: what the box is, such as "domain". */
void sb_missing_tell(const sb_missing *found, const sb_mesh *mesh, const char *box, char *text, size_t size);

#endif
