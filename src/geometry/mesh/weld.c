/* Merges vertices of a mesh that lie at the same place. */
#include "geometry/mesh/weld.h"

#include "base/hash.h"
#include "base/memory.h"

int sb_mesh_find_twins(const sb_mesh *mesh, uint32_t *first)
{
    size_t slots = 16;
    while (slots < 2 * mesh->vertex_count) slots *= 2;
    uint32_t *table = sb_alloc_untouched(slots, sizeof *table);
    if (!table) return -1;
    memset(table, 0xff, slots * sizeof *table);
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        sb_vec3 at = sb_add(mesh->vertices[i], sb_vec(0, 0, 0)); /* -0 + 0 is 0 */
        size_t slot = sb_hash(0, &at, sizeof at) & (slots - 1);
        for (; table[slot] != UINT32_MAX; slot = (slot + 1) & (slots - 1)) {
            sb_vec3 other = mesh->vertices[table[slot]];
            if (other.x == at.x && other.y == at.y && other.z == at.z) break;
        }
        if (table[slot] == UINT32_MAX) table[slot] = (uint32_t)i;
        first[i] = table[slot];
    }
    sb_free(table);
    return 0;
}

bool sb_mesh_is_degenerate(sb_vec3 a, sb_vec3 b, sb_vec3 c)
{
    sb_vec3 ab = sb_sub(b, a), ac = sb_sub(c, a), bc = sb_sub(c, b);
    double longest2 = fmax(sb_dot(ab, ab), fmax(sb_dot(ac, ac), sb_dot(bc, bc)));
    return !(sb_norm(sb_cross(ab, ac)) > 1e-12 * longest2);
}

static sb_status check(const sb_mesh *mesh, sb_error *error)
{
    if (mesh->vertex_count >= UINT32_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%zu vertices, expected fewer than 2^32", mesh->vertex_count);
    for (size_t i = 0; i < mesh->vertex_count; ++i)
        if (!sb_isfinite(mesh->vertices[i]))
            return sb_fail(error, SB_BAD_INPUT, "vertex %zu is (%g, %g, %g), expected finite numbers", i,
                           mesh->vertices[i].x, mesh->vertices[i].y, mesh->vertices[i].z);
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        for (int k = 0; k < 3; ++k)
            if (mesh->triangles[i][k] >= mesh->vertex_count)
                return sb_fail(error, SB_BAD_INPUT, "triangle %zu has vertex %u, expected below %zu", i,
                               mesh->triangles[i][k], mesh->vertex_count);
    return SB_OK;
}

sb_status sb_mesh_weld(sb_mesh *mesh, sb_error *error)
{
    sb_status status = check(mesh, error);
    if (status != SB_OK) return status;
    uint32_t *first = sb_alloc_untouched(mesh->vertex_count, sizeof *first);
    uint32_t *place = sb_alloc(mesh->vertex_count, sizeof *place);
    if (!first || !place || sb_mesh_find_twins(mesh, first)) {
        status = sb_fail_memory(error, "merging the vertices of a mesh");
        goto done;
    }
    size_t triangles = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        uint32_t corner[3];
        for (int k = 0; k < 3; ++k) corner[k] = first[mesh->triangles[i][k]];
        if (sb_mesh_is_degenerate(mesh->vertices[corner[0]], mesh->vertices[corner[1]], mesh->vertices[corner[2]])) {
            ++mesh->dropped;
            continue;
        }
        for (int k = 0; k < 3; ++k) place[corner[k]] = 1;
        memcpy(mesh->triangles[triangles++], corner, sizeof corner);
    }
    uint32_t vertices = 0;
    for (size_t i = 0; i < mesh->vertex_count; ++i)
        if (place[i]) {
            mesh->vertices[vertices] = mesh->vertices[i];
            place[i] = vertices++;
        }
    for (size_t i = 0; i < triangles; ++i)
        for (int k = 0; k < 3; ++k) mesh->triangles[i][k] = place[mesh->triangles[i][k]];
    mesh->triangle_count = triangles;
    mesh->vertex_count = vertices;
done:
    sb_free(first);
    sb_free(place);
    return status;
}
