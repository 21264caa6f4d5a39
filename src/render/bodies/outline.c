/* Finds the normals and the feature edges of a mesh. */
#include "render/bodies/outline.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* The faces around each welded vertex v: faces[first[v]] .. faces[first[v + 1] - 1]. Vertices at the same position are
   welded: they are represented by one of them. */
struct topology {
    uint32_t *weld; /* per vertex: its representative */
    sb_vec3 *area;  /* per face: normal times twice the area */
    size_t *first;
    uint32_t *faces;
};

struct place {
    int64_t at[3];
    uint32_t vertex;
};

static int compare_places(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p->at[i] != q->at[i]) return p->at[i] < q->at[i] ? -1 : 1;
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

/* Positions are compared after rounding to a millionth of the mesh's size, so that vertices that differ by a file's
   rounding are welded, too. */
static sb_status weld(const sb_mesh *mesh, uint32_t *weld_to, sb_error *error)
{
    size_t count = mesh->vertex_count;
    struct place *places = sb_alloc(count, sizeof *places);
    if (!places) return sb_fail_memory(error, "welding a mesh");
    sb_vec3 min = mesh->vertices[0], max = min;
    for (size_t i = 1; i < count; i++) {
        min = sb_min(min, mesh->vertices[i]);
        max = sb_max(max, mesh->vertices[i]);
    }
    double size = sb_norm(sb_sub(max, min)), scale = size > 0 ? 1e6 / size : 0;
    for (size_t i = 0; i < count; i++) {
        sb_vec3 at = sb_scale(sb_sub(mesh->vertices[i], min), scale);
        places[i] = (struct place){{llround(at.x), llround(at.y), llround(at.z)}, (uint32_t)i};
    }
    qsort(places, count, sizeof *places, compare_places);
    for (size_t i = 0, lead = 0; i < count; i++) {
        if (memcmp(places[i].at, places[lead].at, sizeof places[i].at) != 0) lead = i;
        weld_to[places[i].vertex] = places[lead].vertex;
    }
    sb_free(places);
    return SB_OK;
}

static void topology_free(struct topology *topology)
{
    sb_free(topology->weld);
    sb_free(topology->area);
    sb_free(topology->first);
    sb_free(topology->faces);
}

static sb_status topology_create(const sb_mesh *mesh, struct topology *topology, sb_error *error)
{
    size_t faces = mesh->triangle_count, vertices = mesh->vertex_count;
    topology->weld = sb_alloc(vertices, sizeof *topology->weld);
    topology->area = sb_alloc(faces, sizeof *topology->area);
    topology->first = sb_alloc(vertices + 2, sizeof *topology->first);
    topology->faces = sb_alloc(3 * faces, sizeof *topology->faces);
    if (!topology->weld || !topology->area || !topology->first || !topology->faces)
        return sb_fail_memory(error, "the edges of a mesh");
    sb_status status = weld(mesh, topology->weld, error);
    if (status != SB_OK) return status;
    /* Counting sort of corners by vertex; first[] is shifted by one while it is being filled. */
    for (size_t f = 0; f < faces; f++) {
        const uint32_t *t = mesh->triangles[f];
        sb_vec3 a = mesh->vertices[t[0]];
        topology->area[f] = sb_cross(sb_sub(mesh->vertices[t[1]], a), sb_sub(mesh->vertices[t[2]], a));
        for (int c = 0; c < 3; c++) topology->first[topology->weld[t[c]] + 2]++;
    }
    for (size_t v = 2; v < vertices + 2; v++) topology->first[v] += topology->first[v - 1];
    for (size_t f = 0; f < faces; f++)
        for (int c = 0; c < 3; c++)
            topology->faces[topology->first[topology->weld[mesh->triangles[f][c]] + 1]++] = (uint32_t)f;
    return SB_OK;
}

static void corner_normals(const sb_mesh *mesh, const struct topology *topology, double cosine, float (*normals)[3])
{
    for (size_t f = 0; f < mesh->triangle_count; f++) {
        sb_vec3 own = sb_normalize(topology->area[f]);
        for (int c = 0; c < 3; c++) {
            uint32_t v = topology->weld[mesh->triangles[f][c]];
            sb_vec3 sum = sb_vec(0, 0, 0);
            for (size_t k = topology->first[v]; k < topology->first[v + 1]; k++) {
                sb_vec3 other = topology->area[topology->faces[k]];
                if (sb_dot(own, other) >= cosine * sb_norm(other)) sum = sb_add(sum, other);
            }
            sum = sb_normalize(sum);
            normals[3 * f + (size_t)c][0] = (float)sum.x;
            normals[3 * f + (size_t)c][1] = (float)sum.y;
            normals[3 * f + (size_t)c][2] = (float)sum.z;
        }
    }
}

struct edge {
    uint32_t low, high, face;
};

static int compare_edges(const void *a, const void *b)
{
    const struct edge *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    return p->face < q->face ? -1 : p->face > q->face;
}

static int is_feature(const struct topology *topology, const struct edge *edges, size_t count, double cosine)
{
    if (count != 2) return 1;
    sb_vec3 a = topology->area[edges[0].face], b = topology->area[edges[1].face];
    return sb_dot(a, b) < cosine * sb_norm(a) * sb_norm(b);
}

static sb_status feature_edges(const sb_mesh *mesh, const struct topology *topology, double cosine, sb_outline *outline,
                               sb_error *error)
{
    struct edge *edges = sb_alloc(3 * mesh->triangle_count, sizeof *edges);
    if (!edges) return sb_fail_memory(error, "the edges of a mesh");
    size_t count = 0, kept = 0;
    for (size_t f = 0; f < mesh->triangle_count; f++)
        for (int c = 0; c < 3; c++) {
            uint32_t a = topology->weld[mesh->triangles[f][c]];
            uint32_t b = topology->weld[mesh->triangles[f][(c + 1) % 3]];
            if (a != b) edges[count++] = (struct edge){a < b ? a : b, a < b ? b : a, (uint32_t)f};
        }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (size_t begin = 0, end; begin < count; begin = end) {
        for (end = begin + 1;
             end < count && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high;)
            end++;
        if (is_feature(topology, edges + begin, end - begin, cosine)) edges[kept++] = edges[begin];
    }
    outline->edges = sb_alloc(kept, sizeof *outline->edges);
    if (!outline->edges) {
        sb_free(edges);
        return sb_fail_memory(error, "the edges of a mesh");
    }
    outline->edge_count = kept;
    for (size_t i = 0; i < kept; i++) {
        outline->edges[i][0] = edges[i].low;
        outline->edges[i][1] = edges[i].high;
    }
    sb_free(edges);
    return SB_OK;
}

sb_status sb_outline_create(const sb_mesh *mesh, double crease, sb_outline *outline, sb_error *error)
{
    *outline = (sb_outline){0};
    if (mesh->triangle_count == 0) return SB_OK;
    struct topology topology = {0};
    sb_outline made = {0};
    double cosine = cos(crease * 3.14159265358979323846 / 180);
    sb_status status = topology_create(mesh, &topology, error);
    if (status != SB_OK) goto done;
    made.normals = sb_alloc(3 * mesh->triangle_count, sizeof *made.normals);
    if (!made.normals) {
        status = sb_fail_memory(error, "the normals of a mesh");
        goto done;
    }
    corner_normals(mesh, &topology, cosine, made.normals);
    status = feature_edges(mesh, &topology, cosine, &made, error);
    if (status != SB_OK) goto done;
    *outline = made;
    made = (sb_outline){0};
done:
    sb_outline_free(&made);
    topology_free(&topology);
    return status;
}

void sb_outline_free(sb_outline *outline)
{
    sb_free(outline->normals);
    sb_free(outline->edges);
    *outline = (sb_outline){0};
}
