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
/* A pass that leaves more than this fraction of the triangles is the last. */
static const double LITTLE = 0.9;
/* The height of terrain that is single-valued, as the library sees it, over its true height. In so flat a mesh
   triangles turn over only if they do so in plan, which the library prevents. */
static const double FLATTENED = 0.05;
/* Cosine of the largest angle between a triangle and the surface that it stands for. */
static const double TURNED = 0.5;
/* Over the tolerance: lower triangles are removed. */
static const double SLIVER = 1e-3, FLAT_SLIVER = 0.2;
enum { ATTEMPTS_MAX = 12, ROUNDS_MAX = 8 };

/* What is simplified. */
typedef struct source {
    const sb_mesh *mesh;     /* what the last pass has left */
    const sb_mesh *original; /* what it stands for */
    sb_role role;
    float *at;       /* coordinates for the library */
    double height;   /* factor of z in them */
    sb_solid *solid; /* of the original */
} source;

static sb_vec3 normal_of(const sb_mesh *mesh, const uint32_t corner[3])
{
    const sb_vec3 from = mesh->vertices[corner[0]];
    return sb_normalize(sb_cross(sb_sub(mesh->vertices[corner[1]], from), sb_sub(mesh->vertices[corner[2]], from)));
}

/* Whether a terrain has one height at each place: no wall, no overhang. */
static bool is_single_valued(const sb_mesh *mesh)
{
    for (size_t t = 0; t < mesh->triangle_count; ++t) {
        if (!(normal_of(mesh, mesh->triangles[t]).z > FLATTENED)) return false;
    }
    return true;
}

/* Coordinates in single precision from the mesh's corner, as the library takes them. NULL without memory. */
static float *single_precision(const sb_mesh *mesh, double height)
{
    float *at = sb_alloc_untouched(3 * mesh->vertex_count, sizeof *at);
    sb_vec3 min = mesh->vertices[0];
    for (size_t v = 1; v < mesh->vertex_count; ++v) min = sb_min(min, mesh->vertices[v]);
    for (size_t v = 0; v < mesh->vertex_count && at; ++v) {
        const sb_vec3 from = sb_sub(mesh->vertices[v], min);
        at[3 * v] = (float)from.x, at[3 * v + 1] = (float)from.y, at[3 * v + 2] = (float)(height * from.z);
    }
    return at;
}

/* The mesh's vertices that these corners use, in their order, with the triangles. origin[]: their numbers in the mesh.
 */
static sb_status take(const sb_mesh *mesh, const unsigned *corner, size_t corners, sb_mesh *simple, uint32_t *origin,
                      sb_error *error)
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
            origin[used] = (uint32_t)v;
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

/* Whether a triangle faces as the surface that it stands for does there. */
static bool faces_alike(const source *from, const sb_mesh *mesh, const uint32_t corner[3], double tolerance)
{
    const sb_vec3 own = normal_of(mesh, corner), middle = middle_of(mesh, corner);
    if (from->height < 1) return own.z > FLATTENED;
    for (int k = 0; k < 4; ++k) {
        sb_vec3 nearest, normal;
        const sb_vec3 at = k == 3 ? middle : sb_scale(sb_add(middle, mesh->vertices[corner[k]]), 0.5);
        if (sb_solid_distance(from->solid, at, tolerance, &nearest, &normal) < tolerance &&
            sb_dot(own, normal) >= TURNED)
            return true;
    }
    return false;
}

/* Removes slivers; of a flattened mesh those in plan, which can stand on edge. */
static sb_status remove_slivers(const source *from, double tolerance, sb_mesh *simple, sb_error *error)
{
    const bool flat = from->height < 1;
    for (size_t v = 0; v < simple->vertex_count && flat; ++v) simple->vertices[v].z *= from->height;
    const sb_status status = sb_mesh_remove_slivers(simple, (flat ? FLAT_SLIVER : SLIVER) * tolerance, error);
    for (size_t v = 0; v < simple->vertex_count && flat; ++v) simple->vertices[v].z /= from->height;
    return status;
}

/* Room for attempts. */
typedef struct room {
    unsigned *corner, *loose; /* 3 per triangle */
    uint32_t *origin;         /* by vertex of the simpler mesh: its number in the mesh */
    bool *kept, *at_fold;     /* by triangle; by vertex */
} room;

static sb_status make_room(const sb_mesh *mesh, room *r, sb_error *error)
{
    r->corner = sb_alloc_untouched(3 * mesh->triangle_count, sizeof *r->corner);
    r->loose = sb_alloc_untouched(3 * mesh->triangle_count, sizeof *r->loose);
    r->origin = sb_alloc_untouched(mesh->vertex_count, sizeof *r->origin);
    r->kept = sb_alloc_untouched(mesh->triangle_count, sizeof *r->kept);
    r->at_fold = sb_alloc_untouched(mesh->vertex_count, sizeof *r->at_fold);
    return r->corner && r->loose && r->origin && r->kept && r->at_fold ? SB_OK : sb_fail_memory(error, "a mesh");
}

static void free_room(room *r)
{
    sb_free(r->corner);
    sb_free(r->loose);
    sb_free(r->origin);
    sb_free(r->kept);
    sb_free(r->at_fold);
}

/* Collapses edges, but for the triangles that are kept. Returns the number of corners. */
static size_t collapse(const source *from, double bound, unsigned options, room *r)
{
    const sb_mesh *mesh = from->mesh;
    const size_t stride = 3 * sizeof *from->at, size = sizeof mesh->triangles[0];
    size_t loose = 0;
    for (size_t t = 0; t < mesh->triangle_count; ++t)
        if (!r->kept[t]) memcpy(r->loose + 3 * loose++, mesh->triangles[t], size);
    if (loose < mesh->triangle_count) options |= meshopt_SimplifyLockBorder;
    const float scale = meshopt_simplifyScale(from->at, mesh->vertex_count, stride);
    if (!(scale > 0)) return 3 * mesh->triangle_count;
    size_t left = meshopt_simplify(r->corner, r->loose, 3 * loose, from->at, mesh->vertex_count, stride, 0,
                                   (float)(from->height * bound) / scale, options, NULL);
    for (size_t t = 0; t < mesh->triangle_count; ++t)
        if (r->kept[t]) {
            memcpy(r->corner + left, mesh->triangles[t], size);
            left += 3;
        }
    return left;
}

/* Collapsed edges can leave triangles that stand on edge or upside down, although no vertex is far from the surface.
   Marks the triangles around them to be kept as they were. Returns whether it has marked any. */
static bool keep_around_folds(const source *from, const sb_mesh *simple, double tolerance, room *r)
{
    const sb_mesh *mesh = from->mesh;
    bool more = false;
    for (size_t v = 0; v < mesh->vertex_count; ++v) r->at_fold[v] = false;
#pragma omp parallel for schedule(dynamic, 1024)
    for (size_t t = 0; t < simple->triangle_count; ++t)
        for (int k = 0; k < 3 && !faces_alike(from, simple, simple->triangles[t], tolerance); ++k) {
#pragma omp atomic write
            r->at_fold[r->origin[simple->triangles[t][k]]] = true;
        }
    for (size_t t = 0; t < mesh->triangle_count; ++t) {
        const uint32_t *corner = mesh->triangles[t];
        if (r->kept[t] || !(r->at_fold[corner[0]] || r->at_fold[corner[1]] || r->at_fold[corner[2]])) continue;
        r->kept[t] = more = true;
    }
    return more;
}

/* One attempt, with a bound on the mean error in m and options of the library. *near: whether the result is within the
   tolerance and has no folds but those of the mesh itself; with an empty result, whether there is nothing to leave out.
 */
static sb_status attempt(const source *from, double bound, unsigned options, double tolerance, room *r, sb_mesh *simple,
                         bool *near, sb_error *error)
{
    const sb_mesh *mesh = from->mesh;
    sb_status status = SB_OK;
    bool folds = true;
    for (size_t t = 0; t < mesh->triangle_count; ++t) r->kept[t] = false;
    *simple = (sb_mesh){0};
    for (int round = 0; round < ROUNDS_MAX && folds && status == SB_OK; ++round) {
        sb_mesh_free(simple);
        *simple = (sb_mesh){0};
        const size_t left = collapse(from, bound, options, r);
        const bool whole = left == 3 * mesh->triangle_count;
        *near = whole && round == 0;
        if (whole || left == 0) return SB_OK;
        status = take(mesh, r->corner, left, simple, r->origin, error);
        if (status == SB_OK) status = remove_slivers(from, tolerance, simple, error);
        folds = status == SB_OK && keep_around_folds(from, simple, tolerance, r);
    }
    sb_solid *solid = NULL;
    if (status == SB_OK && !folds) status = sb_solid_create(simple, from->role, &solid, error);
    *near = solid && is_near(from->original, solid, tolerance) && is_near(simple, from->solid, tolerance);
    sb_solid_destroy(solid);
    if (!*near) sb_mesh_free(simple);
    if (!*near) *simple = (sb_mesh){0};
    return status;
}

/* One pass over what is left. Leaves *simple empty if nothing can be left out. */
static sb_status one_pass(const source *from, unsigned options, double tolerance, sb_mesh *simple, sb_error *error)
{
    room r = {0};
    sb_status status = make_room(from->mesh, &r, error);
    bool near = false;
    double bound = FIRST * tolerance;
    *simple = (sb_mesh){0};
    for (int k = 0; k < ATTEMPTS_MAX && status == SB_OK && !near; ++k, bound *= NEXT)
        status = attempt(from, bound, options, tolerance, &r, simple, &near, error);
    free_room(&r);
    return status;
}

/* Passes until they leave out little: what a pass has kept around folds, the next may leave out. Leaves *simple empty
   if nothing can be left out. */
static sb_status simplify(const source *whole, unsigned options, double tolerance, sb_mesh *simple, sb_error *error)
{
    sb_status status = SB_OK;
    *simple = (sb_mesh){0};
    for (bool more = true; more && status == SB_OK;) {
        source from = *whole;
        sb_mesh next;
        if (simple->triangle_count > 0) from.mesh = simple;
        from.at = single_precision(from.mesh, from.height);
        status = from.at ? one_pass(&from, options, tolerance, &next, error) : sb_fail_memory(error, "a mesh");
        sb_free(from.at);
        if (status != SB_OK) break;
        more = next.triangle_count > 0 && (double)next.triangle_count < LITTLE * (double)from.mesh->triangle_count;
        if (next.triangle_count == 0) break;
        sb_mesh_free(simple);
        *simple = next;
    }
    return status;
}

sb_status sb_mesh_simplify(const sb_mesh *mesh, sb_role role, double tolerance, sb_mesh *simple, sb_error *error)
{
    *simple = (sb_mesh){0};
    if (mesh->triangle_count == 0) return SB_OK;
    source from = {.mesh = mesh, .original = mesh, .role = role};
    from.height = role == SB_ROLE_TERRAIN && is_single_valued(mesh) ? FLATTENED : 1;
    sb_status status = sb_solid_create(mesh, role, &from.solid, error);
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
    return status;
}
