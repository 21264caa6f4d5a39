#include "surface/water_mesh.h"

#include "base/memory.h"
#include "base/vec.h"

void sb_water_mesh_free(sb_water_mesh *mesh)
{
    sb_free(mesh->position);
    sb_free(mesh->normal);
    sb_free(mesh->velocity);
    sb_free(mesh->pressure);
    sb_free(mesh->corner);
    *mesh = (sb_water_mesh){0};
}

/* The sum of the tetrahedra of all triangles with the first vertex. */
double sb_water_mesh_volume(const sb_water_mesh *mesh)
{
    double volume = 0;
    for (size_t t = 0; t < mesh->triangles; t++) {
        sb_vec3 at[3];
        for (int k = 0; k < 3; k++) {
            const float *p = mesh->position[mesh->corner[t][k]], *from = mesh->position[0];
            at[k] =
                sb_vec((double)p[0] - (double)from[0], (double)p[1] - (double)from[1], (double)p[2] - (double)from[2]);
        }
        volume += sb_dot(at[0], sb_cross(at[1], at[2])) / 6;
    }
    return volume;
}
