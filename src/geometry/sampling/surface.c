/* Derives from a mesh what the sampling needs: the orientation of its faces, which of them share a plane, and where
   the boundary surface has to go round a concave edge or corner. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"
#include "base/sets.h"
#include "geometry/mesh/edges.h"

#include <stdlib.h>
#include <string.h>

/* In spacings: creases with a shorter arc on the boundary surface need no points of their own. */
static const double arc_min = 0.006;
/* Cosine above which normals around a corner count as one. */
static const double same_normal = 0.97;
static const double same_plane = 1 - 1e-9;
/* Cosine between normals above which an edge is too flat to count as a ridge. */
static const double ridge_cosine = 0.9;

typedef struct spoke {
    uint32_t vertex;
    size_t crease;
} spoke;

static int compare_spokes(const void *left, const void *right)
{
    const spoke *a = left, *b = right;
    if (a->vertex != b->vertex) return a->vertex < b->vertex ? -1 : 1;
    return (a->crease > b->crease) - (a->crease < b->crease);
}

static sb_vec3 corner(const sb_mesh *mesh, size_t triangle, int i)
{
    return mesh->vertices[mesh->triangles[triangle][i]];
}

static sb_vec3 centroid(const sb_mesh *mesh, size_t t)
{
    return sb_scale(sb_add(corner(mesh, t, 0), sb_add(corner(mesh, t, 1), corner(mesh, t, 2))), 1.0 / 3);
}

/* Turns the normals of faces towards the water, by checking which side of a face is inside the solid. */
static void orient_faces(sb_surface *surface, double step)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    const sb_solid *solid = surface->source->solid;
#pragma omp parallel for schedule(dynamic, 64)
    for (size_t t = 0; t < mesh->triangle_count; ++t) {
        sb_vec3 at = centroid(mesh, t), n = surface->normal[t];
        if (sb_solid_contains(solid, sb_madd(at, step, n)) && !sb_solid_contains(solid, sb_madd(at, -step, n)))
            surface->normal[t] = sb_scale(n, -1);
    }
}

static void orient(sb_surface *surface, const sb_mesh_edges *list, double spacing)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    const sb_mesh_edge *edges = list->edges;
    bool open = false;
    for (size_t i = 0, end; i < list->count; i = end) {
        end = sb_mesh_edge_run(list, i);
        bool pair = end - i == 2;
        open = open || !pair;
        surface->mixed = surface->mixed || (pair && edges[i].forward == edges[i + 1].forward);
    }
    double volume = 0;
    for (size_t t = 0; t < mesh->triangle_count; ++t) {
        sb_vec3 a = sb_sub(corner(mesh, t, 0), surface->min);
        sb_vec3 b = sb_sub(corner(mesh, t, 1), surface->min);
        sb_vec3 c = sb_sub(corner(mesh, t, 2), surface->min);
        volume += sb_dot(a, sb_cross(b, c)) / 6;
    }
    surface->sign = 1;
    if (surface->source->role == SB_ROLE_TERRAIN) {
        surface->bounded = true;
        for (size_t t = 0; t < mesh->triangle_count; ++t)
            if (surface->normal[t].z < -SB_SAMPLE_UPRIGHT) surface->normal[t] = sb_scale(surface->normal[t], -1);
    } else if (!mesh->open_surface && (open || surface->mixed)) {
        orient_faces(surface, 1e-3 * spacing);
    } else if (!mesh->open_surface) {
        surface->bounded = true;
        surface->sign = volume < 0 ? -1 : 1;
        for (size_t t = 0; volume < 0 && t < mesh->triangle_count; ++t)
            surface->normal[t] = sb_scale(surface->normal[t], -1);
    }
}

/* Whether an edge is concave: the corner of the triangle opposite to the edge is above the other face's plane, so
   the water lies in the smaller angle between the faces. */
static bool is_concave(const sb_surface *surface, const sb_mesh_edge *e, const sb_mesh_edge *other)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    sb_vec3 on = mesh->vertices[e->low], n = surface->normal[other->triangle];
    double rise = 0;
    for (int i = 0; i < 3; ++i) {
        double above = sb_dot(sb_sub(corner(mesh, e->triangle, i), on), n);
        rise = fabs(above) > fabs(rise) ? above : rise;
    }
    return rise > 0;
}

/* A mesh may contain duplicate faces, so more than two faces may meet in one edge. At most this many of them are
   considered. */
enum { MEETING_MAX = 16 };

static void join_planes(sb_surface *surface, const sb_mesh_edge *edge, const sb_mesh_edge *end)
{
    for (const sb_mesh_edge *one = edge; one < end; ++one)
        for (const sb_mesh_edge *other = one + 1; other < end; ++other)
            if (sb_dot(surface->normal[one->triangle], surface->normal[other->triangle]) > same_plane)
                sb_sets_join(surface->region, one->triangle, other->triangle);
}

/* Adds convex edges between any two of the faces that meet in [edge, end). */
static int add_ridges(sb_surface *surface, const sb_mesh_edge *edge, const sb_mesh_edge *end)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    if (surface->source->role != SB_ROLE_SOLID || mesh->open_surface || surface->mixed) return 0;
    for (const sb_mesh_edge *one = edge; one < end; ++one)
        for (const sb_mesh_edge *other = one + 1; other < end; ++other) {
            const sb_vec3 first = surface->normal[one->triangle], second = surface->normal[other->triangle];
            if (sb_dot(first, first) == 0 || sb_dot(second, second) == 0 || sb_dot(first, second) > ridge_cosine ||
                is_concave(surface, one, other))
                continue;
            if (sb_grow((void **)&surface->ridges, &surface->ridge_capacity, surface->ridge_count + 1,
                        sizeof *surface->ridges))
                return -1;
            surface->ridges[surface->ridge_count++] =
                (sb_ridge){mesh->vertices[one->low], mesh->vertices[one->high], {one->triangle, other->triangle}};
        }
    return 0;
}

/* Finds planes and creases from the pairs of faces that share an edge. */
static int join_faces(sb_surface *surface, const sb_mesh_edges *list, const sb_sample_settings *settings)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    const sb_mesh_edge *edges = list->edges;
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) surface->region[t] = t;
    for (size_t i = 0, end; i < list->count; i = end) {
        end = sb_mesh_edge_run(list, i);
        const sb_mesh_edge *meeting = edges + (end - i > MEETING_MAX ? i + MEETING_MAX : end);
        join_planes(surface, edges + i, meeting);
        if (add_ridges(surface, edges + i, meeting)) return -1;
        if (end - i != 2) continue;
        sb_vec3 first = surface->normal[edges[i].triangle];
        sb_vec3 second = surface->normal[edges[i + 1].triangle];
        if (sb_dot(first, first) == 0 || sb_dot(second, second) == 0 ||
            settings->offset * sb_norm(sb_sub(first, second)) < arc_min * settings->spacing ||
            !is_concave(surface, edges + i, edges + i + 1))
            continue;
        if (sb_grow((void **)&surface->creases, &surface->crease_capacity, surface->crease_count + 1,
                    sizeof *surface->creases))
            return -1;
        surface->creases[surface->crease_count++] =
            (sb_crease){mesh->vertices[edges[i].low], mesh->vertices[edges[i].high], {first, second}};
    }
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) surface->region[t] = sb_sets_root(surface->region, t);
    return 0;
}

enum { NORMALS_MAX = 8 };

static int add_caps(sb_surface *surface, sb_vec3 at, const sb_vec3 *normals, size_t count)
{
    for (size_t i = 1; i + 1 < count; ++i) {
        if (sb_grow((void **)&surface->caps, &surface->cap_capacity, surface->cap_count + 1, sizeof *surface->caps))
            return -1;
        surface->caps[surface->cap_count++] = (sb_cap){at, {normals[0], normals[i], normals[i + 1]}};
    }
    return 0;
}

static size_t add_normal(sb_vec3 *normals, size_t count, sb_vec3 normal)
{
    for (size_t i = 0; i < count; ++i)
        if (sb_dot(normals[i], normal) > same_normal) return count;
    if (count < NORMALS_MAX) normals[count++] = normal;
    return count;
}

/* Finds the corners where creases meet, and adds a fan of caps over the normals around each. */
static int find_caps(sb_surface *surface, const sb_mesh_edges *list)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    spoke *spokes = sb_alloc_untouched(2 * surface->crease_count, sizeof *spokes);
    if (!spokes) return -1;
    /* The creases are in the order of the edges. Their merged vertices are found by traversing both lists. */
    size_t count = 0, c = 0;
    for (size_t i = 0; i < list->count && c < surface->crease_count; ++i) {
        const sb_mesh_edge *edge = list->edges + i;
        sb_vec3 a = sb_sub(mesh->vertices[edge->low], surface->creases[c].a);
        sb_vec3 b = sb_sub(mesh->vertices[edge->high], surface->creases[c].b);
        if (sb_dot(a, a) != 0 || sb_dot(b, b) != 0) continue;
        spokes[count++] = (spoke){edge->low, c};
        spokes[count++] = (spoke){edge->high, c++};
    }
    qsort(spokes, count, sizeof *spokes, compare_spokes);
    int failed = 0;
    for (size_t i = 0, n; i < count && !failed; i += n) {
        sb_vec3 normals[NORMALS_MAX];
        size_t normal_count = 0;
        for (n = 0; i + n < count && spokes[i + n].vertex == spokes[i].vertex; ++n)
            for (int k = 0; k < 2; ++k)
                normal_count = add_normal(normals, normal_count, surface->creases[spokes[i + n].crease].normal[k]);
        failed = add_caps(surface, mesh->vertices[spokes[i].vertex], normals, normal_count);
    }
    sb_free(spokes);
    return failed;
}

void sb_surface_free(sb_surface *surface)
{
    sb_free(surface->normal);
    sb_free(surface->region);
    sb_free(surface->lattices);
    sb_free(surface->creases);
    sb_free(surface->caps);
    sb_free(surface->ridges);
    *surface = (sb_surface){0};
}

/* Whether a face lies in a periodic side, behind which the solid continues at the opposite side. */
static bool on_side(const sb_sample_settings *settings, const sb_vec3 corners[3])
{
    const double slack = SB_SAMPLE_SIDE * settings->spacing;
    for (int axis = 0; axis < 3; ++axis) {
        bool low = settings->repeats[axis], high = low;
        for (int i = 0; i < 3; ++i) {
            double at = sb_sample_along(corners[i], axis);
            low = low && fabs(at - sb_sample_along(settings->min, axis)) < slack;
            high = high && fabs(at - sb_sample_along(settings->max, axis)) < slack;
        }
        if (low || high) return true;
    }
    return false;
}

static void measure(sb_surface *surface, const sb_sample_settings *settings)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    surface->min = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    surface->max = sb_scale(surface->min, -1);
    for (size_t t = 0; t < mesh->triangle_count; ++t) {
        sb_vec3 a = corner(mesh, t, 0), b = corner(mesh, t, 1), c = corner(mesh, t, 2);
        surface->normal[t] = on_side(settings, (const sb_vec3[3]){a, b, c})
                                 ? sb_vec(0, 0, 0)
                                 : sb_normalize(sb_cross(sb_sub(b, a), sb_sub(c, a)));
        surface->min = sb_min(surface->min, sb_min(a, sb_min(b, c)));
        surface->max = sb_max(surface->max, sb_max(a, sb_max(b, c)));
    }
}

sb_status sb_surface_build(const sb_sample_source *source, const sb_sample_settings *settings, sb_surface *surface,
                           sb_error *error)
{
    const sb_mesh *mesh = source->mesh;
    sb_surface made = {.source = source};
    made.normal = sb_alloc_untouched(mesh->triangle_count, sizeof *made.normal);
    made.region = sb_alloc_untouched(mesh->triangle_count, sizeof *made.region);
    sb_mesh_edges edges = {0};
    int failed = !made.normal || !made.region || sb_mesh_find_edges(mesh, &edges);
    if (!failed) {
        measure(&made, settings);
        orient(&made, &edges, settings->spacing);
        failed = join_faces(&made, &edges, settings) || find_caps(&made, &edges);
    }
    sb_mesh_edges_free(&edges);
    if (failed) {
        sb_surface_free(&made);
        return sb_fail_memory(error, "the sampling of a surface");
    }
    *surface = made;
    return SB_OK;
}
