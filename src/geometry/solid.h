/* Spatial questions to a mesh: distance, inside, rays. Const once made: ask from any thread. */
#ifndef SB_GEOMETRY_SOLID_H
#define SB_GEOMETRY_SOLID_H

#include "geometry/mesh.h"

typedef struct sb_solid sb_solid;

/* Keeps a pointer to the mesh, which must outlive it. role decides what "inside" means.
   SB_BAD_INPUT for a mesh without triangles or with an index or a vertex out of range. */
sb_status sb_solid_create(const sb_mesh *mesh, sb_role role, sb_solid **solid, sb_error *error);
void sb_solid_destroy(sb_solid *solid);

/* Distance to the surface in m, at most `limit` (returned when nothing is nearer); *nearest and
 *normal (of the nearest triangle) may be NULL and are untouched when nothing is nearer. */
double sb_solid_distance(const sb_solid *solid, sb_vec3 point, double limit, sb_vec3 *nearest, sb_vec3 *normal);

/* Whether a triangle counts: its point nearest to the one asked about, and its normal. */
typedef bool sb_solid_counts(const void *context, sb_vec3 nearest, sb_vec3 normal);

/* As sb_solid_distance, of the triangles that count alone. */
double sb_solid_distance_where(const sb_solid *solid, sb_vec3 point, double limit, sb_solid_counts *counts,
                               const void *context, sb_vec3 *nearest, sb_vec3 *normal);

/* Generalised winding number (Barill et al. 2018): 1 inside, 0 outside, fractions near holes. */
double sb_solid_winding(const sb_solid *solid, sb_vec3 point);

/* SOLID: |winding| > 1/2 within the bounding box (a wholly flipped mesh is as good). An open sheet
   (mesh->sheet, or all its triangles facing much the same way) has no inside: there it is behind
   the angle-weighted normal at the nearest point. TERRAIN: some triangle lies straight above; beside
   the terrain's footprint nothing is inside. A point on the surface may be either. */
bool sb_solid_contains(const sb_solid *solid, sb_vec3 point);

/* Whether the point of an open sheet that is nearest lies on its rim, where triangles fill half a turn or less: such a
   point is beside the sheet, neither before nor behind it. */
bool sb_solid_beside(const sb_solid *solid, sb_vec3 point);

/* First hit along origin + t direction (unit), 0 < t <= limit: t, or a negative number. */
double sb_solid_raycast(const sb_solid *solid, sb_vec3 origin, sb_vec3 direction, double limit);

#endif
