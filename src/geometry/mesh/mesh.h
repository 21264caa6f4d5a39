/* Triangle meshes: import from files, analytic shapes, terrain grids, diagnosis and repair. */
#ifndef SB_GEOMETRY_MESH_H
#define SB_GEOMETRY_MESH_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdint.h>

/* A mesh. Vertices are in metres in the scene's axes. Triangles are counter-clockwise seen from the water. Arrays
   are owned. */
typedef struct sb_mesh {
    char name[SB_NAME_MAX];
    char original[SB_NAME_MAX]; /* the name in its file, any bytes, if a body may not have that name; else "" */
    size_t vertex_count;
    sb_vec3 *vertices;
    size_t triangle_count;
    uint32_t (*triangles)[3];
    bool open_surface; /* a surface that encloses nothing (plane, basin): the solid lies behind its normals */
    size_t dropped;    /* degenerate triangles of the file, which are left out */
    size_t turned;     /* triangles whose orientation was reversed to face the water */
    size_t closed;     /* triangles added where the file had a hole of one triangle */
    size_t ends;       /* open edges from which sb_mesh_skirt added walls */
    sb_vec3 first_end; /* m, middle of the first such edge */
    size_t node_count; /* number of vertices that are nodes of a grid; they come first */
    size_t hole_count; /* number of the grid's nodes without a height */
    sb_vec3 *holes;    /* positions of these nodes, z has no meaning */
    char *told;        /* lines that describe a terrain grid, for `check`; NULL: none */
    char *projection;  /* coordinate system of a terrain grid's ground; NULL: its files state none */
    double rounded;    /* m, rounding error of the file's coordinates in single precision */
} sb_mesh;

/* Allocates vertices and triangles without initialising them. *mesh is overwritten, not freed. */
sb_status sb_mesh_alloc(sb_mesh *mesh, size_t vertices, size_t triangles, sb_error *error);

/* Frees the mesh's arrays and zeroes it. A zeroed mesh is allowed. */
void sb_mesh_free(sb_mesh *mesh);

/* Place along a direction of the foremost vertex, m; -infinity without vertices. */
double sb_mesh_front(const sb_mesh *mesh, sb_vec3 direction);

/* Faults of a mesh: their counts and the place of the first of each kind. Vertices at the same place count as one. */
typedef struct sb_mesh_report {
    size_t open_edges;       /* edges with one triangle only */
    size_t flipped_faces;    /* triangles in the smaller part of a surface with inconsistent orientation */
    size_t degenerate_faces; /* triangles without area; they are not counted otherwise */
    size_t doubled_faces;    /* triangles on the same three vertices as an earlier one */
    sb_vec3 first_open_edge, first_flipped_face; /* m, middle of the edge, of the face */
    bool watertight;                             /* triangles traverse every edge equally often in both directions */
    double volume, area;                         /* m^3 (signed), m^2 */
    sb_vec3 min, max;                            /* m */
} sb_mesh_report;
/* Fills a report of the mesh. SB_FAILED without memory for the search for edges. */
sb_status sb_mesh_diagnose(const sb_mesh *mesh, sb_mesh_report *report, sb_error *error);

/* Reverses triangles that are oriented opposite to most of their surface. It then reverses the whole mesh if a SOLID
   has a negative volume or a TERRAIN faces downwards. Adds to mesh->turned. */
sb_status sb_mesh_orient(sb_mesh *mesh, sb_role role, sb_error *error);

/* Adds a triangle in each hole that is bounded by three edges, and adds to mesh->closed. Call it after
   sb_mesh_orient. The border of an open surface stays open, and so does a hole whose triangle would lie back to back
   with a neighbour. */
sb_status sb_mesh_close(sb_mesh *mesh, sb_error *error);

/* Whether a terrain's open edge needs a wall. Seen from above, the ground lies to the left of the way from `from` to
   `to`. */
typedef bool sb_mesh_ends(void *context, sb_vec3 from, sb_vec3 to);

/* Adds vertical walls that face outwards below those open edges of a terrain for which `ends` holds. They end
   `depth` (m) below both the edge and `floor`. Sets mesh->ends. A mesh without such edges is unchanged. */
sb_status sb_mesh_skirt(sb_mesh *mesh, sb_mesh_ends *ends, void *context, double floor, double depth, sb_error *error);

/* Merges vertices at the same place, and removes degenerate triangles (adding to mesh->dropped) and unused vertices.
   The order of the others is kept. SB_BAD_INPUT for non-finite vertices or invalid indices. */
sb_status sb_mesh_weld(sb_mesh *mesh, sb_error *error);

/* Reads OBJ, STL, PLY, glTF, GLB or DAE in a child process with limits (4 GiB; 20 s of processor time, and 1 s per
   MB). Returns one welded mesh for each node that has triangles. The mesh has the node's name; characters that a
   name of a scene may not have are replaced by _, and a node without a name gives "". The nodes' transforms are
   applied. Units and axes are the file's, except that a DAE is converted to metres by its own unit. The caller owns
   *meshes: sb_mesh_free each, then sb_free. The child opens no file outside of the mesh's folder; a mesh that refers
   to one is refused. SB_BAD_INPUT "file: what, expected", SB_INTERRUPTED by a signal (base/stop.h). */
sb_status sb_mesh_import(const char *path, sb_mesh **meshes, size_t *count, sb_error *error);

/* Returns which protections of the child (fence.h) this kernel does not have, as a line for a log; NULL if it
   has all. */
const char *sb_mesh_fence_gaps(void);

/* Reads the terrain heights of body->file as an open surface: ESRI ASCII (.asc; nodata cells are holes) or lines "x y
   z" on a regular grid (.xyz, in any order; missing points are holes). Coordinates and heights are the file's.
   mesh->told describes it, with the scale, datum and transform of the body. SB_BAD_INPUT "file:line: what, expected".
   *mesh is unchanged on error. */
sb_status sb_mesh_import_grid(const sb_body *body, sb_mesh *mesh, sb_error *error);

/* Analytic shapes with normals towards the water. The chord error of round shapes is at most tolerance (m). A
   plane's width is along z x normal (along x if the plane is horizontal), and its length is perpendicular to that. */
sb_status sb_mesh_box(sb_vec3 min, sb_vec3 max, sb_mesh *mesh, sb_error *error);
sb_status sb_mesh_cylinder(sb_vec3 base, double radius, double height, double tolerance, sb_mesh *mesh,
                           sb_error *error);
sb_status sb_mesh_plane(sb_vec3 center, sb_vec3 normal, double width, double length, sb_mesh *mesh, sb_error *error);
sb_status sb_mesh_basin(sb_vec3 min, sb_vec3 max, sb_mesh *mesh, sb_error *error);

/* Makes all meshes of one body of a scene, in the scene's coordinates. The result is one mesh with the body's name,
   or with body->split one mesh for each named node of its file, with "-2", "-3" appended to repeated names. Round
   shapes are accurate to 0.02 spacing. SB_BAD_INPUT also for a mesh file with coordinates so far from 0 that single
   precision rounds them by more than a quarter of the spacing. The caller owns the meshes as those of
   sb_mesh_import. */
sb_status sb_mesh_from_body(const sb_body *body, double spacing, sb_mesh **meshes, size_t *count, sb_error *error);

/* The same; of a terrain that is read in part (grid/terrain.h), only what the box from min to max (m, scene
   coordinates) needs, and `margin` (m) around it. */
sb_status sb_mesh_from_body_within(const sb_body *body, double spacing, sb_vec3 min, sb_vec3 max, double margin,
                                   sb_mesh **meshes, size_t *count, sb_error *error);

#endif
