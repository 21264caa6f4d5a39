#include "surface/parts.h"

#include "base/memory.h"

/* The vertex that stands for the part of a vertex: the first one. Shortens the way to it. */
static uint32_t root_of(uint32_t *parent, uint32_t vertex)
{
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
}

static void join(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = root_of(parent, a);
    b = root_of(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

sb_status sb_mesh_parts_find(const sb_water_mesh *mesh, sb_mesh_parts *parts, sb_error *error)
{
    uint32_t *parent = sb_alloc_untouched(mesh->vertices, sizeof *parent);
    size_t count = 0;
    *parts = (sb_mesh_parts){0};
    if (!parent) return sb_fail_memory(error, "the parts of a surface");
    for (uint32_t v = 0; v < mesh->vertices; v++) parent[v] = v;
    for (size_t t = 0; t < mesh->triangles; t++) {
        join(parent, mesh->corner[t][0], mesh->corner[t][1]);
        join(parent, mesh->corner[t][1], mesh->corner[t][2]);
    }
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        parent[v] = root_of(parent, v);
        count += parent[v] == v;
    }
    parts->first = sb_alloc_untouched(count, sizeof *parts->first);
    if (!parts->first) {
        sb_free(parent);
        return sb_fail_memory(error, "the parts of a surface");
    }
    /* A vertex behind its root: the root's entry is its part's number already. */
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        if (parent[v] != v) {
            parent[v] = parent[parent[v]];
            continue;
        }
        parent[v] = (uint32_t)parts->count;
        parts->first[parts->count++] = v;
    }
    parts->part = parent;
    return SB_OK;
}

void sb_mesh_parts_free(sb_mesh_parts *parts)
{
    sb_free(parts->part);
    sb_free(parts->first);
    *parts = (sb_mesh_parts){0};
}
