/* Finds the faults of a mesh and corrects the orientation of its faces. */
#include "base/memory.h"
#include "geometry/mesh/edges.h"
#include "geometry/mesh/weld.h"

#include <stdlib.h>
#include <string.h>

/* Measures the bounds of the triangles, the area, and the volume as a sum of tetrahedra. The tetrahedra start from
   the middle of the bounds, which keeps the precision of meshes far from the origin. */
static void measure(const sb_mesh *mesh, sb_mesh_report *report, sb_vec3 *area_vector)
{
    report->min = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    report->max = sb_scale(report->min, -1);
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        for (int k = 0; k < 3; ++k) {
            sb_vec3 at = mesh->vertices[mesh->triangles[i][k]];
            report->min = sb_min(report->min, at);
            report->max = sb_max(report->max, at);
        }
    if (mesh->triangle_count == 0) report->min = report->max = sb_vec(0, 0, 0);
    sb_vec3 middle = sb_scale(sb_add(report->min, report->max), 0.5);
    *area_vector = sb_vec(0, 0, 0);
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        sb_vec3 a = sb_sub(mesh->vertices[mesh->triangles[i][0]], middle);
        sb_vec3 b = sb_sub(mesh->vertices[mesh->triangles[i][1]], middle);
        sb_vec3 c = sb_sub(mesh->vertices[mesh->triangles[i][2]], middle);
        sb_vec3 area = sb_scale(sb_cross(sb_sub(b, a), sb_sub(c, a)), 0.5);
        report->area += sb_norm(area);
        report->volume += sb_dot(a, sb_cross(b, c)) / 6;
        *area_vector = sb_add(*area_vector, area);
    }
}

typedef struct corners {
    uint32_t corner[3];
} corners;

static int compare_corners(const void *left, const void *right)
{
    const corners *a = left, *b = right;
    for (int k = 0; k < 3; ++k)
        if (a->corner[k] != b->corner[k]) return a->corner[k] < b->corner[k] ? -1 : 1;
    return 0;
}

static void order(uint32_t *a, uint32_t *b)
{
    uint32_t low = *a < *b ? *a : *b;
    *b = *a < *b ? *b : *a;
    *a = low;
}

/* Returns -1 without memory. */
static int count_doubled(const sb_mesh *mesh, size_t *doubled)
{
    int failed = -1;
    size_t count = 0;
    uint32_t *first = sb_alloc_untouched(mesh->vertex_count, sizeof *first);
    corners *all = sb_alloc_untouched(mesh->triangle_count, sizeof *all);
    if (!first || !all || sb_mesh_find_twins(mesh, first)) goto done;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t *t = mesh->triangles[i];
        if (sb_mesh_is_degenerate(mesh->vertices[t[0]], mesh->vertices[t[1]], mesh->vertices[t[2]])) continue;
        uint32_t *to = all[count++].corner;
        for (int k = 0; k < 3; ++k) to[k] = first[t[k]];
        order(&to[0], &to[1]);
        order(&to[1], &to[2]);
        order(&to[0], &to[1]);
    }
    qsort(all, count, sizeof *all, compare_corners);
    for (size_t i = 1; i < count; ++i) *doubled += compare_corners(&all[i - 1], &all[i]) == 0;
    failed = 0;
done:
    sb_free(first);
    sb_free(all);
    return failed;
}

static void report_edges(const sb_mesh *mesh, const sb_mesh_edges *edges, sb_mesh_report *report)
{
    report->watertight = edges->count > 0;
    for (size_t i = 0, end; i < edges->count; i = end) {
        end = sb_mesh_edge_run(edges, i);
        size_t forward = 0;
        for (size_t j = i; j < end; ++j) forward += edges->edges[j].forward;
        if (2 * forward != end - i) report->watertight = false;
        if (end - i == 1 && report->open_edges++ == 0)
            report->first_open_edge =
                sb_scale(sb_add(mesh->vertices[edges->edges[i].low], mesh->vertices[edges->edges[i].high]), 0.5);
    }
    report->flipped_faces = edges->flipped_count;
    for (size_t i = 0; i < mesh->triangle_count && edges->flipped_count > 0; ++i) {
        if (!edges->flipped[i]) continue;
        const uint32_t *t = mesh->triangles[i];
        sb_vec3 sum = sb_add(mesh->vertices[t[0]], mesh->vertices[t[1]]);
        report->first_flipped_face = sb_scale(sb_add(sum, mesh->vertices[t[2]]), 1.0 / 3);
        break;
    }
}

sb_status sb_mesh_diagnose(const sb_mesh *mesh, sb_mesh_report *report, sb_error *error)
{
    sb_vec3 area_vector;
    *report = (sb_mesh_report){0};
    measure(mesh, report, &area_vector);
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t *t = mesh->triangles[i];
        report->degenerate_faces +=
            sb_mesh_is_degenerate(mesh->vertices[t[0]], mesh->vertices[t[1]], mesh->vertices[t[2]]);
    }
    sb_mesh_edges edges;
    if (sb_mesh_find_edges(mesh, &edges)) return sb_fail_memory(error, "the edges of a mesh");
    report_edges(mesh, &edges, report);
    int failed = count_doubled(mesh, &report->doubled_faces);
    sb_mesh_edges_free(&edges);
    return failed ? sb_fail_memory(error, "the faces of a mesh") : SB_OK;
}

static void turn(sb_mesh *mesh, size_t i)
{
    uint32_t swapped = mesh->triangles[i][1];
    mesh->triangles[i][1] = mesh->triangles[i][2];
    mesh->triangles[i][2] = swapped;
}

sb_status sb_mesh_orient(sb_mesh *mesh, sb_role role, sb_error *error)
{
    sb_mesh_edges edges;
    if (sb_mesh_find_edges(mesh, &edges)) return sb_fail_memory(error, "the edges of a mesh");
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        if (edges.flipped[i]) turn(mesh, i);
    size_t turned = edges.flipped_count;
    sb_vec3 area_vector;
    sb_mesh_report report = {0};
    measure(mesh, &report, &area_vector);
    /* The area vector of a closed terrain is zero. Its volume then gives the orientation, as for a solid. Upright
       surfaces, and open surfaces of role SOLID, keep the orientation of their file. */
    double facing = sb_norm(area_vector) / report.area, up = area_vector.z / report.area;
    bool by_volume = role == SB_ROLE_SOLID ? !mesh->open_surface && facing < 0.9 : facing < 1e-6;
    bool wrong = by_volume ? report.volume < 0 : role == SB_ROLE_TERRAIN && up < -0.05;
    if (wrong) {
        for (size_t i = 0; i < mesh->triangle_count; ++i) turn(mesh, i);
        turned = mesh->triangle_count - turned;
    }
    mesh->turned += turned;
    sb_mesh_edges_free(&edges);
    return SB_OK;
}
