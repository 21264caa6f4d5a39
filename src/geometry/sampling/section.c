/* Cuts a mesh with the plane y = 0 for 2D scenes. The section is a mesh of strips perpendicular to that plane, so
   that distances, rays and inside tests work as in 3D. */
#include "geometry/sampling/sample.h"

#include "base/memory.h"

static double side_of(sb_vec3 a)
{
    return a.y >= 0 ? 1 : -1;
}

/* Returns the point where the edge crosses y = 0, with the same bits in either direction of the edge. */
static sb_vec3 crossing(sb_vec3 a, sb_vec3 b)
{
    sb_vec3 low = a.y < b.y ? a : b, high = a.y < b.y ? b : a;
    double t = low.y / (low.y - high.y);
    return sb_vec(low.x + t * (high.x - low.x), 0, low.z + t * (high.z - low.z));
}

/* Cuts a triangle with y = 0. Its normal is to the left of the piece from a to b seen along +y. Returns false if
   there is no piece. */
static bool cut(const sb_mesh *mesh, size_t t, sb_vec3 piece[2])
{
    const sb_vec3 c[3] = {mesh->vertices[mesh->triangles[t][0]], mesh->vertices[mesh->triangles[t][1]],
                          mesh->vertices[mesh->triangles[t][2]]};
    int count = 0;
    for (int i = 0; i < 3; ++i)
        if (side_of(c[i]) * side_of(c[(i + 1) % 3]) < 0 && count < 2) piece[count++] = crossing(c[i], c[(i + 1) % 3]);
    sb_vec3 arm = count == 2 ? sb_sub(piece[1], piece[0]) : sb_vec(0, 0, 0);
    if (!(sb_dot(arm, arm) > 0)) return false;
    sb_vec3 n = sb_cross(sb_sub(c[1], c[0]), sb_sub(c[2], c[0]));
    if (arm.z * n.x - arm.x * n.z > 0) {
        sb_vec3 swap = piece[0];
        piece[0] = piece[1];
        piece[1] = swap;
    }
    return true;
}

static void add_strip(sb_mesh *section, const sb_vec3 piece[2], double half_width)
{
    uint32_t v = (uint32_t)section->vertex_count;
    for (int i = 0; i < 4; ++i) {
        section->vertices[v + (uint32_t)i] = piece[i % 2];
        section->vertices[v + (uint32_t)i].y = i < 2 ? -half_width : half_width;
    }
    const uint32_t two[2][3] = {{v, v + 1, v + 2}, {v + 3, v + 2, v + 1}};
    for (int k = 0; k < 2; ++k, ++section->triangle_count)
        for (int i = 0; i < 3; ++i) section->triangles[section->triangle_count][i] = two[k][i];
    section->vertex_count += 4;
}

sb_status sb_section_mesh(const sb_mesh *mesh, double half_width, sb_mesh *section, sb_error *error)
{
    sb_vec3 piece[2];
    size_t count = 0;
    for (size_t t = 0; t < mesh->triangle_count; ++t) count += cut(mesh, t, piece);
    sb_mesh made;
    sb_status status = sb_mesh_alloc(&made, 4 * count, 2 * count, error);
    if (status != SB_OK) return status;
    made.vertex_count = made.triangle_count = 0;
    made.open_surface = mesh->open_surface;
    made.ends = mesh->ends;
    for (size_t t = 0; t < mesh->triangle_count; ++t)
        if (cut(mesh, t, piece)) add_strip(&made, piece, half_width);
    for (int i = 0; i < SB_NAME_MAX; ++i) made.name[i] = mesh->name[i];
    *section = made;
    return SB_OK;
}
