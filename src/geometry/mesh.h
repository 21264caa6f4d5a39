/* Triangle meshes: imported, made from analytic shapes or terrain grids, and diagnosed. */
#ifndef SB_GEOMETRY_MESH_H
#define SB_GEOMETRY_MESH_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdint.h>

/* Vertices in metres, scene axes. Triangles counter-clockwise seen from the water. Owned. */
typedef struct sb_mesh {
    char name[SB_NAME_MAX];
    size_t vertex_count;
    sb_vec3 *vertices;
    size_t triangle_count;
    uint32_t (*triangles)[3];
    bool sheet; /* open on purpose (plane, basin): solid is what lies behind the normals */
} sb_mesh;

/* Room for so many vertices and triangles, zeroed; *mesh is overwritten, not freed. */
sb_status sb_mesh_alloc(sb_mesh *mesh, size_t vertices, size_t triangles, sb_error *error);

/* Frees what the mesh owns and zeroes it; fine on a zeroed mesh. */
void sb_mesh_free(sb_mesh *mesh);

/* What is wrong with a mesh, as counts and the place of the first of each. */
typedef struct sb_mesh_report {
    size_t open_edges, flipped_faces, degenerate_faces, doubled_faces;
    sb_vec3 first_open_edge, first_flipped_face;
    bool watertight;
    double volume, area; /* m^3 (signed), m^2 */
    sb_vec3 min, max;
} sb_mesh_report;
void sb_mesh_diagnose(const sb_mesh *mesh, sb_mesh_report *report);

/* Reads a mesh file in a child process with limits; named nodes give one mesh each. Raw file units,
   file axes. *meshes is owned by the caller: sb_mesh_free each, then sb_free. */
sb_status sb_mesh_import(const char *path, sb_mesh **meshes, size_t *count, sb_error *error);

/* Terrain heights as a sheet mesh: ESRI ASCII (.asc; nodata cells are holes) or lines "x y z" on a
   regular grid (.xyz). */
sb_status sb_mesh_import_grid(const char *path, double datum, sb_mesh *mesh, sb_error *error);

/* Analytic shapes, outward normals towards the water; chord error of round ones <= tolerance (m). */
sb_status sb_mesh_box(sb_vec3 min, sb_vec3 max, sb_mesh *mesh, sb_error *error);
sb_status sb_mesh_cylinder(sb_vec3 base, double radius, double height, double tolerance,
                           sb_mesh *mesh, sb_error *error);
sb_status sb_mesh_plane(sb_vec3 center, sb_vec3 normal, double width, double length, sb_mesh *mesh,
                        sb_error *error);
sb_status sb_mesh_basin(sb_vec3 min, sb_vec3 max, sb_mesh *mesh, sb_error *error);

/* All meshes that one scene body stands for, transformed to the scene. */
sb_status sb_mesh_from_body(const sb_body *body, double spacing, sb_mesh **meshes, size_t *count,
                            sb_error *error);

#endif
