/* Spatial queries on a mesh: distance, inside, rays. A solid does not change after its creation and may be used by
   any number of threads. */
#ifndef SB_GEOMETRY_SOLID_H
#define SB_GEOMETRY_SOLID_H

#include "geometry/mesh/mesh.h"

typedef struct sb_solid sb_solid;

/* Creates a solid. It keeps a pointer to the mesh, which must outlive it. role determines the meaning of "inside".
   SB_BAD_INPUT for a mesh without triangles or with an invalid index or vertex. */
sb_status sb_solid_create(const sb_mesh *mesh, sb_role role, sb_solid **solid, sb_error *error);
void sb_solid_destroy(sb_solid *solid);

/* Returns the distance to the surface in m, at most `limit` (returned if nothing is nearer). *nearest and *normal
   (of the nearest triangle) may be NULL and are unchanged if nothing is nearer. */
double sb_solid_distance(const sb_solid *solid, sb_vec3 point, double limit, sb_vec3 *nearest, sb_vec3 *normal);

/* Whether a triangle counts, given its point nearest to the query's point and its normal. */
typedef bool sb_solid_counts(const void *context, sb_vec3 nearest, sb_vec3 normal);

/* Like sb_solid_distance, for the triangles that count only. */
double sb_solid_distance_where(const sb_solid *solid, sb_vec3 point, double limit, sb_solid_counts *counts,
                               const void *context, sb_vec3 *nearest, sb_vec3 *normal);

/* Returns the generalised winding number (Barill et al. 2018): 1 inside, 0 outside, fractions near holes. */
double sb_solid_winding(const sb_solid *solid, sb_vec3 point);

/* Whether a point is inside. SOLID: |winding| > 1/2 within the bounding box (a wholly flipped mesh gives the same
   result). An open surface (mesh->open_surface, or a mesh whose triangles mostly face one way) encloses nothing:
   inside means behind the angle-weighted normal at the nearest point. TERRAIN: a triangle lies straight above; no
   point beside the terrain's footprint is inside. A point on the surface may be either. */
bool sb_solid_contains(const sb_solid *solid, sb_vec3 point);

/* Whether the nearest point of an open surface lies on its border, where triangles fill half a turn or less. The
   point is then beside the surface, neither in front of nor behind it. */
bool sb_solid_beside(const sb_solid *solid, sb_vec3 point);

/* Returns the distance t of the first hit along origin + t direction (unit), 0 < t <= limit, or a negative number. */
double sb_solid_raycast(const sb_solid *solid, sb_vec3 origin, sb_vec3 direction, double limit);

#endif
