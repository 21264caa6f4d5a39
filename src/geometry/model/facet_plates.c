/* Bodies whose surface is open: water may be on both sides of it. */
#include "base/memory.h"
#include "geometry/mesh/edges.h"
#include "geometry/model/facet_parts.h"
#include "geometry/solid/solid.h"

#include <math.h>

/* In spacings: how far behind an open edge the winding number is taken. It is 1 behind a closed surface, and at most
   about 3/4 beside an opening that is wider than this. */
static const double BEHIND = 0.1, CLOSED = 0.9;

/* Whether the winding number behind some open edge of a body's mesh is not that of a closed surface. It is where edges
   of the mesh coincide without sharing their corners: nothing is open there. Returns -1 without memory. */
static int is_open(const sb_facet_builder *b, size_t body)
{
    const sb_mesh *mesh = &b->model->bodies[body].mesh;
    const double away = BEHIND * b->spacing;
    sb_mesh_edges edges;
    if (b->model->dimensions == 2 || !b->space->solid[body]) return true;
    if (sb_mesh_find_edges(mesh, &edges) != 0) return -1;
    bool open = false;
    for (size_t k = 0, end = 0; k < edges.count && !open; k = end) {
        const sb_mesh_edge *e = &edges.edges[k];
        end = sb_mesh_edge_run(&edges, k);
        if (end - k != 1) continue;
        const uint32_t *v = mesh->triangles[e->triangle];
        const sb_vec3 from = mesh->vertices[e->forward ? e->low : e->high],
                      to = mesh->vertices[e->forward ? e->high : e->low];
        const sb_vec3 normal = sb_normalize(sb_cross(sb_sub(mesh->vertices[v[1]], mesh->vertices[v[0]]),
                                                     sb_sub(mesh->vertices[v[2]], mesh->vertices[v[0]])));
        const sb_vec3 inward = sb_normalize(sb_cross(normal, sb_sub(to, from)));
        const sb_vec3 behind = sb_madd(sb_scale(sb_add(from, to), 0.5), away, sb_sub(inward, normal));
        open = fabs(sb_solid_winding(b->space->solid[body], behind)) < CLOSED;
    }
    sb_mesh_edges_free(&edges);
    return open;
}

int sb_facets_find_plates(sb_facet_builder *b)
{
    b->plate = sb_alloc(b->model->body_count, sizeof *b->plate);
    if (!b->plate) return -1;
    for (size_t k = 0; k < b->model->body_count; k++) {
        const sb_model_body *of = &b->model->bodies[k];
        sb_mesh_report report;
        sb_error error = {0};
        if (!sb_facets_has_mesh(b, k) || of->role == SB_ROLE_TERRAIN || of->mesh.open_surface) continue;
        if (sb_mesh_diagnose(&of->mesh, &report, &error) != SB_OK) return -1;
        const int open = report.watertight ? 0 : is_open(b, k);
        if (open < 0) return -1;
        b->plate[k] = open;
    }
    return 0;
}
