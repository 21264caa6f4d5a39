/* Closes holes of one triangle: three open edges in a closed loop, between which exactly one face is missing. Larger
   holes stay open and the winding number decides what is inside, because the intended surface there is unknown. */
#include "base/memory.h"
#include "geometry/mesh/edges.h"
#include "geometry/mesh/weld.h"

#include <stdlib.h>
#include <string.h>

/* An open edge, in the direction in which its triangle traverses it. */
typedef struct rim {
    uint32_t from, to, triangle;
} rim;

static int compare_rims(const void *left, const void *right)
{
    const rim *a = left, *b = right;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return a->to < b->to ? -1 : a->to > b->to;
}

static size_t collect_rims(const sb_mesh_edges *edges, rim *rims)
{
    size_t count = 0;
    for (size_t i = 0, end; i < edges->count; i = end) {
        const sb_mesh_edge *e = edges->edges + i;
        end = sb_mesh_edge_run(edges, i);
        if (end - i > 1) continue;
        rims[count++] = e->forward ? (rim){e->low, e->high, e->triangle} : (rim){e->high, e->low, e->triangle};
    }
    qsort(rims, count, sizeof *rims, compare_rims);
    return count;
}

/* Returns the only open edge that starts at a vertex; NULL if there is none or more than one. */
static const rim *next_rim(const rim *rims, size_t count, uint32_t from)
{
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (rims[middle].from < from)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == count || rims[low].from != from) return NULL;
    return low + 1 < count && rims[low + 1].from == from ? NULL : rims + low;
}

static sb_vec3 normal_of(const sb_mesh *mesh, const uint32_t corner[3])
{
    const sb_vec3 *v = mesh->vertices;
    const sb_vec3 n = sb_cross(sb_sub(v[corner[1]], v[corner[0]]), sb_sub(v[corner[2]], v[corner[0]]));
    const double length = sb_norm(n);
    return length > 0 ? sb_scale(n, 1 / length) : n;
}

/* Finds the missing face of a loop. If the face would lie back to back with a neighbour, the loop is the border of
   an open surface or of a single triangle, and it stays open. */
static bool missing_face(const sb_mesh *mesh, const rim *rims, size_t count, const rim *first, uint32_t face[3])
{
    static const double FOLDED = -0.99; /* cosine between normals */
    const rim *second = next_rim(rims, count, first->to), *third = second ? next_rim(rims, count, second->to) : NULL;
    if (!third || third->to != first->from) return false;
    if (first->from > second->from || first->from > third->from) return false; /* each ring once */
    face[0] = first->from;
    face[1] = third->from;
    face[2] = second->from;
    const sb_vec3 *v = mesh->vertices;
    if (sb_mesh_is_degenerate(v[face[0]], v[face[1]], v[face[2]])) return false;
    const sb_vec3 normal = normal_of(mesh, face);
    const rim *ring[] = {first, second, third};
    for (int k = 0; k < 3; k++)
        if (sb_dot(normal, normal_of(mesh, mesh->triangles[ring[k]->triangle])) < FOLDED) return false;
    return true;
}

static sb_status add_faces(sb_mesh *mesh, uint32_t (*faces)[3], size_t count, sb_error *error)
{
    uint32_t(*all)[3] = sb_alloc_untouched(mesh->triangle_count + count, sizeof *all);
    if (!all) return sb_fail_memory(error, "the faces of a mesh");
    memcpy(all, mesh->triangles, mesh->triangle_count * sizeof *all);
    memcpy(all + mesh->triangle_count, faces, count * sizeof *all);
    sb_free(mesh->triangles);
    mesh->triangles = all;
    mesh->triangle_count += count;
    mesh->closed += count;
    return SB_OK;
}

sb_status sb_mesh_close(sb_mesh *mesh, sb_error *error)
{
    sb_mesh_edges edges;
    if (sb_mesh_find_edges(mesh, &edges)) return sb_fail_memory(error, "the edges of a mesh");
    rim *rims = sb_alloc_untouched(edges.count, sizeof *rims);
    const size_t count = rims ? collect_rims(&edges, rims) : 0;
    uint32_t(*faces)[3] = sb_alloc_untouched(count / 3 + 1, sizeof *faces);
    size_t found = 0;
    sb_status status = rims && faces ? SB_OK : sb_fail_memory(error, "the holes of a mesh");
    for (size_t i = 0; status == SB_OK && i < count; i++)
        found += missing_face(mesh, rims, count, rims + i, faces[found]);
    if (status == SB_OK && found > 0) status = add_faces(mesh, faces, found, error);
    sb_mesh_edges_free(&edges);
    sb_free(rims);
    sb_free(faces);
    return status;
}
