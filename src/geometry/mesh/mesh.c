/* Allocates and frees meshes. */
#include "geometry/mesh/mesh.h"

#include "base/memory.h"

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
