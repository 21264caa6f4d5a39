/* Meshes: their memory, and how far they reach. */
#include "geometry/mesh/mesh.h"

#include "base/memory.h"

#include <math.h>

sb_status sb_mesh_alloc(sb_mesh *mesh, size_t vertices, size_t triangles, sb_error *error)
{
    *mesh = (sb_mesh){.vertex_count = vertices, .triangle_count = triangles};
    mesh->vertices = sb_alloc_untouched(vertices, sizeof *mesh->vertices);
    mesh->triangles = sb_alloc_untouched(triangles, sizeof *mesh->triangles);
    if (mesh->vertices && mesh->triangles) return SB_OK;
    sb_mesh_free(mesh);
    return sb_fail_memory(error, "a mesh");
}

void sb_mesh_free(sb_mesh *mesh)
{
    if (!mesh) return;
    sb_free(mesh->vertices);
    sb_free(mesh->triangles);
    sb_free(mesh->holes);
    sb_free(mesh->told);
    sb_free(mesh->projection);
    *mesh = (sb_mesh){0};
}

double sb_mesh_front(const sb_mesh *mesh, sb_vec3 direction)
{
    double front = -(double)INFINITY;
    for (size_t v = 0; v < mesh->vertex_count; v++) front = fmax(front, sb_dot(mesh->vertices[v], direction));
    return front;
}
