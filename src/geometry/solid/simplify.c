#include "geometry/solid/simplify.h"

#include "base/memory.h"
#include "geometry/mesh/slivers.h"
#include "geometry/solid/solid.h"

#include <math.h>
#include <meshoptimizer.h>
#include <string.h>

/* The library bounds the mean distance of a vertex from the planes of the triangles that were there. The tolerance is
   for the largest distance of surfaces, which can be less or more. FIRST: the first bound that is tried, over the
   tolerance; then half of it, and so on. */
static const double FIRST = 2, NEXT = 0.7;
/* Over the tolerance: lower triangles are removed. */
static const double SLIVER = 1e-3;
enum { ATTEMPTS_MAX = 12 };

/* What is simplified. */
typedef struct source {
    const sb_mesh *mesh;
    sb_role role;
    float *at;       /* coordinates for the library */
    sb_solid *solid; /* of the mesh */
} source;

/* Coordinates in single precision from the mesh's corner, as the library takes them. NULL without memory. */
static float *single_precision(const sb_mesh *mesh)
{
    float *at = sb_alloc_untouched(3 * mesh->vertex_count, sizeof *at);
    sb_vec3 min = mesh->vertices[0];
    for (size_t v = 1; v < mesh->vertex_count; ++v) min = sb_min(min, mesh->vertices[v]);
    for (size_t v = 0; v < mesh->vertex_count && at; ++v) {
        const sb_vec3 from = sb_sub(mesh->vertices[v], min);
        at[3 * v] = (float)from.x, at[3 * v + 1] = (float)from.y, at[3 * v + 2] = (float)from.z;
    }
    return at;
}

/* The mesh's vertices that these corners use, in their order, with the triangles. */
static sb_status take(const sb_mesh *mesh, const unsigned *corner, size_t corners, sb_mesh *simple, sb_error *error)
{
    uint32_t *number = sb_alloc(mesh->vertex_count, sizeof *number);
    if (!number) return sb_fail_memory(error, "a mesh");
    for (size_t k = 0; k < corners; ++k) number[corner[k]] = 1;
    uint32_t used = 0;
    for (size_t v = 0; v < mesh->vertex_count; ++v) used += number[v];
    sb_mesh made;
    const sb_status status = sb_mesh_alloc(&made, used, corners / 3, error);
    if (status == SB_OK) {
        made.open_surface = mesh->open_surface;
        made.ends = mesh->ends;
        used = 0;
        for (size_t v = 0; v < mesh->vertex_count; ++v) {
            if (!number[v]) continue;
            made.vertices[used] = mesh->vertices[v];
            number[v] = used++;
        }
        for (size_t k = 0; k < corners; ++k) made.triangles[k / 3][k % 3] = number[corner[k]];
        *simple = made;
    }
    sb_free(number);
    return status;
}

static sb_vec3 middle_of(const sb_mesh *mesh, const uint32_t corner[3])
{
    const sb_vec3 sum = sb_add(sb_add(mesh->vertices[corner[0]], mesh->vertices[corner[1]]), mesh->vertices[corner[2]]);
    return sb_scale(sum, 1 / 3.0);
}

/* Whether all vertices of a mesh and the middles of its edges and triangles are within the tolerance of a solid's
   surface. */
static bool is_near(const sb_mesh *mesh, const sb_solid *solid, double tolerance)
{
    bool near = true;
#pragma omp parallel for schedule(dynamic, 1024) reduction(&& : near)
    for (size_t t = 0; t < mesh->triangle_count; ++t)
        for (int k = 0; k < 3 && near; ++k) {
            const uint32_t *corner = mesh->triangles[t];
            const sb_vec3 from = mesh->vertices[corner[k]], to = mesh->vertices[corner[(k + 1) % 3]];
            const sb_vec3 middle = sb_scale(sb_add(from, to), 0.5);
            near = sb_solid_distance(solid, from, tolerance, NULL, NULL) < tolerance &&
                   sb_solid_distance(solid, middle, tolerance, NULL, NULL) < tolerance &&
                   (k > 0 || sb_solid_distance(solid, middle_of(mesh, corner), tolerance, NULL, NULL) < tolerance);
        }
    return near;
}

/* One attempt, with a bound on the mean error in m and options of the library. *near: whether the result is within the
   tolerance. */
static sb_status attempt(const source *from, double bound, unsigned options, double tolerance, sb_mesh *simple,
                         bool *near, sb_error *error)
{
    const sb_mesh *mesh = from->mesh;
    const size_t corners = 3 * mesh->triangle_count, vertices = mesh->vertex_count, stride = 3 * sizeof *from->at;
    unsigned *corner = sb_alloc_untouched(corners, sizeof *corner);
    if (!corner) return sb_fail_memory(error, "a mesh");
    const float scale = meshopt_simplifyScale(from->at, vertices, stride);
    const size_t left = scale > 0 ? meshopt_simplify(corner, mesh->triangles[0], corners, from->at, vertices, stride, 0,
                                                     (float)bound / scale, options, NULL)
                                  : corners;
    sb_status status = SB_OK;
    *near = true;
    if (left > 0 && left < corners) {
        sb_solid *solid = NULL;
        status = take(mesh, corner, left, simple, error);
        if (status == SB_OK) status = sb_mesh_remove_slivers(simple, SLIVER * tolerance, error);
        if (status == SB_OK) status = sb_solid_create(simple, from->role, &solid, error);
        *near = status == SB_OK && is_near(mesh, solid, tolerance) && is_near(simple, from->solid, tolerance);
        sb_solid_destroy(solid);
        if (!*near) sb_mesh_free(simple);
    } else {
        *near = left == corners;
    }
    sb_free(corner);
    return status;
}

/* Leaves *simple empty if nothing can be left out. */
static sb_status simplify(const source *from, unsigned options, double tolerance, sb_mesh *simple, sb_error *error)
{
    sb_status status = SB_OK;
    bool near = false;
    double bound = FIRST * tolerance;
    *simple = (sb_mesh){0};
    for (int k = 0; k < ATTEMPTS_MAX && status == SB_OK && !near; ++k, bound *= NEXT)
        status = attempt(from, bound, options, tolerance, simple, &near, error);
    return status;
}

sb_status sb_mesh_simplify(const sb_mesh *mesh, sb_role role, double tolerance, sb_mesh *simple, sb_error *error)
{
    *simple = (sb_mesh){0};
    if (mesh->triangle_count == 0) return SB_OK;
    source from = {.mesh = mesh, .role = role, .at = single_precision(mesh)};
    sb_status status = from.at ? sb_solid_create(mesh, role, &from.solid, error) : sb_fail_memory(error, "a mesh");
    if (status == SB_OK) status = simplify(&from, meshopt_SimplifyLockBorder, tolerance, simple, error);
    /* All corners of an open border may be too many, but without them a corner of the border may be lost. */
    if (status == SB_OK && (mesh->open_surface || role == SB_ROLE_TERRAIN)) {
        sb_mesh other;
        status = simplify(&from, 0, tolerance, &other, error);
        const bool better =
            other.triangle_count > 0 && (simple->triangle_count == 0 || other.triangle_count < simple->triangle_count);
        sb_mesh_free(better ? simple : &other);
        if (better) *simple = other;
    }
    if (status != SB_OK) sb_mesh_free(simple);
    sb_solid_destroy(from.solid);
    sb_free(from.at);
    return status;
}
