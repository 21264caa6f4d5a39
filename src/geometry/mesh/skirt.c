/* Adds walls below the open edges of a terrain. The ground below a terrain's surface is solid. Where the surface
   ends, the solid ends in a vertical face that the file does not contain. */
#include "base/memory.h"
#include "geometry/mesh/edges.h"

#include <string.h>

/* An open edge in the direction in which its triangle traverses it. Seen from above, the surface lies to its left. */
typedef struct end_edge {
    uint32_t from, to;
} end_edge;

/* Cosine of the normal to the vertical: a face closer to vertical than this faces neither upwards nor downwards. */
static const double upright = 1e-9;

static bool faces_down(const sb_mesh *mesh, uint32_t triangle)
{
    const uint32_t *of = mesh->triangles[triangle];
    const sb_vec3 a = mesh->vertices[of[0]];
    const sb_vec3 normal = sb_cross(sb_sub(mesh->vertices[of[1]], a), sb_sub(mesh->vertices[of[2]], a));
    return normal.z < -upright * sb_norm(normal);
}

/* Collects the open edges that need a wall. */
static size_t collect_ends(const sb_mesh *mesh, const sb_mesh_edges *edges, sb_mesh_ends *ends, void *context,
                           end_edge *found)
{
    size_t count = 0;
    for (size_t i = 0, end; i < edges->count; i = end) {
        const sb_mesh_edge *e = edges->edges + i;
        end = sb_mesh_edge_run(edges, i);
        if (end - i > 1) continue;
        const bool forward = e->forward != faces_down(mesh, e->triangle);
        const end_edge one = {forward ? e->low : e->high, forward ? e->high : e->low};
        if (ends(context, mesh->vertices[one.from], mesh->vertices[one.to])) found[count++] = one;
    }
    return count;
}

/* Returns the vertex below another one. Neighbouring walls share it, so that they meet in an edge. */
static uint32_t foot_of(sb_mesh *mesh, uint32_t *foot, uint32_t top, double floor, double depth)
{
    if (foot[top] != 0) return foot[top];
    sb_vec3 at = mesh->vertices[top];
    at.z = fmin(at.z, floor) - depth;
    mesh->vertices[mesh->vertex_count] = at;
    foot[top] = (uint32_t)mesh->vertex_count++;
    return foot[top];
}

/* Adds two triangles below each edge, which face outwards. */
static sb_status add_walls(const sb_mesh *mesh, const end_edge *ends, size_t count, double floor, double depth,
                           sb_mesh *out, sb_error *error)
{
    if (mesh->vertex_count + 2 * count >= UINT32_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%zu vertices, expected fewer than 2^32", mesh->vertex_count + 2 * count);
    uint32_t *foot = sb_alloc(mesh->vertex_count, sizeof *foot);
    if (!foot) return sb_fail_memory(error, "the ends of a terrain");
    sb_mesh made;
    sb_status status = sb_mesh_alloc(&made, mesh->vertex_count + 2 * count, mesh->triangle_count + 2 * count, error);
    if (status == SB_OK) {
        made.vertex_count = mesh->vertex_count;
        made.triangle_count = mesh->triangle_count;
        memcpy(made.vertices, mesh->vertices, mesh->vertex_count * sizeof *made.vertices);
        memcpy(made.triangles, mesh->triangles, mesh->triangle_count * sizeof *made.triangles);
        for (size_t i = 0; i < count; ++i) {
            const uint32_t from = ends[i].from, to = ends[i].to;
            const uint32_t below_from = foot_of(&made, foot, from, floor, depth);
            const uint32_t below_to = foot_of(&made, foot, to, floor, depth);
            const uint32_t two[2][3] = {{to, from, below_from}, {to, below_from, below_to}};
            memcpy(made.triangles + made.triangle_count, two, sizeof two);
            made.triangle_count += 2;
        }
        *out = made;
    }
    sb_free(foot);
    return status;
}

sb_status sb_mesh_skirt(sb_mesh *mesh, sb_mesh_ends *ends, void *context, double floor, double depth, sb_error *error)
{
    sb_mesh_edges edges;
    if (sb_mesh_find_edges(mesh, &edges)) return sb_fail_memory(error, "the edges of a mesh");
    end_edge *found = sb_alloc_untouched(edges.count, sizeof *found);
    sb_status status = found ? SB_OK : sb_fail_memory(error, "the ends of a terrain");
    const size_t count = found ? collect_ends(mesh, &edges, ends, context, found) : 0;
    sb_mesh_edges_free(&edges);
    if (count > 0) {
        sb_mesh whole = {.vertex_count = 0};
        status = add_walls(mesh, found, count, floor, depth, &whole, error);
        if (status == SB_OK) {
            const sb_vec3 from = mesh->vertices[found[0].from], to = mesh->vertices[found[0].to];
            sb_free(mesh->vertices);
            sb_free(mesh->triangles);
            mesh->vertices = whole.vertices;
            mesh->vertex_count = whole.vertex_count;
            mesh->triangles = whole.triangles;
            mesh->triangle_count = whole.triangle_count;
            mesh->ends = count;
            mesh->first_end = sb_scale(sb_add(from, to), 0.5);
        }
    }
    sb_free(found);
    return status;
}
