/* Triangle meshes: imported, made from analytic shapes or terrain grids, and diagnosed. */
#ifndef SB_GEOMETRY_MESH_H
#define SB_GEOMETRY_MESH_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdint.h>

/* Vertices in metres, scene axes. Triangles counter-clockwise seen from the water. Owned. */
typedef struct sb_mesh {
    char name[SB_NAME_MAX];
    char original[SB_NAME_MAX]; /* the name in its file, any bytes, where that is no name of a body; else "" */
    size_t vertex_count;
    sb_vec3 *vertices;
    size_t triangle_count;
    uint32_t (*triangles)[3];
    bool sheet;        /* open on purpose (plane, basin): solid is what lies behind the normals */
    size_t dropped;    /* degenerate triangles that the file had, left out */
    size_t turned;     /* triangles that were turned round to face the water */
    size_t closed;     /* triangles put where the file had a hole of one */
    size_t ends;       /* open edges that walls were hung from, by sb_mesh_skirt */
    sb_vec3 first_end; /* m, middle of the first of them */
    size_t node_count; /* the first vertices are so many nodes of a grid */
    size_t hole_count; /* nodes of a grid that have no height */
    sb_vec3 *holes;    /* where they are, z without meaning */
    double rounded;    /* m, by which a mesh file's numbers, read in single precision, may be off */
} sb_mesh;

/* Room for so many vertices and triangles, not yet written; *mesh is overwritten, not freed. */
sb_status sb_mesh_alloc(sb_mesh *mesh, size_t vertices, size_t triangles, sb_error *error);

/* Frees what the mesh owns and zeroes it; fine on a zeroed mesh. */
void sb_mesh_free(sb_mesh *mesh);

/* What is wrong with a mesh, as counts and the place of the first of each. Vertices at the same
   place are one. */
typedef struct sb_mesh_report {
    size_t open_edges;                           /* with a triangle on one side only */
    size_t flipped_faces;                        /* the lesser part of a surface whose neighbours face the other way */
    size_t degenerate_faces;                     /* without area; they count for nothing else */
    size_t doubled_faces;                        /* a further triangle on the same three vertices */
    sb_vec3 first_open_edge, first_flipped_face; /* m, middle of the edge, of the face */
    bool watertight;                             /* every edge is run through as often forth as back */
    double volume, area;                         /* m^3 (signed), m^2 */
    sb_vec3 min, max;                            /* m */
} sb_mesh_report;
/* SB_FAILED without memory for the search of edges. */
sb_status sb_mesh_diagnose(const sb_mesh *mesh, sb_mesh_report *report, sb_error *error);

/* Turns triangles that face the other way than most of their surface; then the whole mesh, when a
   SOLID has a negative volume or a TERRAIN looks down. Adds to mesh->turned. */
sb_status sb_mesh_orient(sb_mesh *mesh, sb_role role, sb_error *error);

/* Puts a triangle into each hole whose rim is three edges, adding to mesh->closed; after sb_mesh_orient. A sheet's rim
   and what would lie back to back with a neighbour stay open. */
sb_status sb_mesh_close(sb_mesh *mesh, sb_error *error);

/* Whether a terrain's open edge is to have a wall; seen from above its ground lies on the left from `from` to `to`. */
typedef bool sb_mesh_ends(void *context, sb_vec3 from, sb_vec3 to);

/* Hangs walls that look outwards from the open edges of a terrain that are ends, down to `depth` (m) below both the
   edge and `floor`; sets mesh->ends. A mesh without any is left as it is. */
sb_status sb_mesh_skirt(sb_mesh *mesh, sb_mesh_ends *ends, void *context, double floor, double depth, sb_error *error);

/* Makes vertices at the same place one, drops degenerate triangles (adding to mesh->dropped) and
   unused vertices. The order of what stays is kept. SB_BAD_INPUT for non-finite vertices or bad
   indices. */
sb_status sb_mesh_weld(sb_mesh *mesh, sb_error *error);

/* Reads OBJ, STL, PLY, glTF, GLB or DAE in a child process with limits (4 GiB; 20 s of processor
   time, and 1 s per MB). One mesh, welded, for each node that has triangles, named after it (""
   when it has no name; characters that no name of a scene has become _); the nodes'
   transforms are applied. File units and axes, but a DAE is in metres by its own unit. *meshes is
   owned by the caller: sb_mesh_free each, then sb_free. The child opens no file outside of the mesh's folder; a mesh
   that names one is refused. SB_BAD_INPUT "file: what, expected", SB_INTERRUPTED by a signal (base/stop.h). */
sb_status sb_mesh_import(const char *path, sb_mesh **meshes, size_t *count, sb_error *error);

/* What of its guards (mesh_fence.h) this kernel does not have, as a line for a log; NULL: nothing. */
const char *sb_mesh_fence_gaps(void);

/* Terrain heights as a sheet mesh: ESRI ASCII (.asc; nodata cells are holes) or lines "x y z" on a
   regular grid (.xyz, in any order; missing points are holes). File units; datum is added to the
   heights. SB_BAD_INPUT "file:line: what, expected". */
sb_status sb_mesh_import_grid(const char *path, double datum, sb_mesh *mesh, sb_error *error);

/* Analytic shapes, outward normals towards the water; chord error of round ones <= tolerance (m).
   A plane's width is along z x normal (along x when it is level), its length across that. */
sb_status sb_mesh_box(sb_vec3 min, sb_vec3 max, sb_mesh *mesh, sb_error *error);
sb_status sb_mesh_cylinder(sb_vec3 base, double radius, double height, double tolerance, sb_mesh *mesh,
                           sb_error *error);
sb_status sb_mesh_plane(sb_vec3 center, sb_vec3 normal, double width, double length, sb_mesh *mesh, sb_error *error);
sb_status sb_mesh_basin(sb_vec3 min, sb_vec3 max, sb_mesh *mesh, sb_error *error);

/* All meshes that one scene body stands for, transformed to the scene. SB_BAD_INPUT also for a mesh file whose numbers,
   far from 0, single precision rounds by more than a quarter of the spacing. One, named as the body; or
   with body->split one per named node of its file, names made unique by "-2", "-3". Round shapes
   are true to 0.02 spacing. Owned by the caller as from sb_mesh_import. */
sb_status sb_mesh_from_body(const sb_body *body, double spacing, sb_mesh **meshes, size_t *count, sb_error *error);

#endif
