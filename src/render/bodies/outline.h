/* Computes smooth normals and feature edges of a mesh for drawing. */
#ifndef SB_RENDER_OUTLINE_H
#define SB_RENDER_OUTLINE_H

#include "geometry/mesh/mesh.h"

typedef struct sb_outline {
    float (*normals)[3]; /* unit, one per triangle corner: 3 * triangle_count; owned */
    size_t edge_count;
    uint32_t (*edges)[2]; /* vertex indices of the mesh; owned */
} sb_outline;

/* Vertices at the same position are treated as one. Faces that meet at less than `crease` degrees share a smooth
   normal. Edges that are sharper, open or shared by more than two faces are feature edges. */
sb_status sb_outline_create(const sb_mesh *mesh, double crease, sb_outline *outline, sb_error *error);
void sb_outline_free(sb_outline *outline);

#endif
