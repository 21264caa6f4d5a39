/* A box as a mesh, for scenes of tests. */
#ifndef SB_TESTS_RENDER_BOX_H
#define SB_TESTS_RENDER_BOX_H

#include "base/memory.h"
#include "geometry/mesh/mesh.h"

#include <string.h>

/* Its faces point outward, towards the water. Free its vertices and triangles with sb_free. */
static inline sb_mesh box(sb_vec3 min, sb_vec3 max)
{
    static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    sb_mesh mesh = {.vertex_count = 8, .triangle_count = 12};
    mesh.vertices = sb_alloc(8, sizeof *mesh.vertices);
    mesh.triangles = sb_alloc(12, sizeof *mesh.triangles);
    for (int i = 0; i < 8; i++)
        mesh.vertices[i] = sb_vec(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
    memcpy(mesh.triangles, faces, sizeof faces);
    return mesh;
}

#endif
