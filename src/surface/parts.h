/* The connected parts of a mesh. */
#ifndef SB_SURFACE_PARTS_H
#define SB_SURFACE_PARTS_H

#include "base/status.h"
#include "surface/water_mesh.h"

typedef struct sb_mesh_parts {
    size_t count;
    uint32_t *part;  /* of each vertex, 0, 1, ... in the order of their first vertices */
    uint32_t *first; /* first vertex of each part */
} sb_mesh_parts;

/* The caller frees. SB_FAILED if memory runs out. */
sb_status sb_mesh_parts_find(const sb_water_mesh *mesh, sb_mesh_parts *parts, sb_error *error);
void sb_mesh_parts_free(sb_mesh_parts *parts);

#endif
