/* What the files of facets share. Private to src/geometry/model/facet*.c. */
#ifndef SB_GEOMETRY_MODEL_FACET_PARTS_H
#define SB_GEOMETRY_MODEL_FACET_PARTS_H

#include "geometry/facets/outlines.h"
#include "geometry/model/parts.h"

/* Cosine of the bend above which water sees an edge: 45 degrees. */
static const double SB_FACETS_BENT = 0.7071;

typedef struct sb_facet_builder {
    const sb_scene *scene;
    const sb_model *model;
    const sb_model_space *space;
    double spacing;       /* m */
    bool *plate;          /* by body: water may be on both sides of its surface */
    sb_outlines *of_body; /* by body; of the domain's sides, by side: of_side */
    sb_outlines of_side[SB_SIDES];
    size_t body;                 /* the present one */
    sb_vec3 shift;               /* m, of this body from its place at rest */
    const sb_outlines *outlines; /* of this body */
    const bool *kept;            /* of them, those that are not hidden */
    sb_facets *out;
    size_t capacity, edge_capacity;
} sb_facet_builder;

/* Whether the body has a mesh of its own; the sides of the domain have none. */
static inline bool sb_facets_has_mesh(const sb_facet_builder *b, size_t body)
{
    return b->model->bodies[body].mesh.triangle_count > 0;
}

/* Where a place on the present body is, seen from another body or the domain's sides (SIZE_MAX). What moves by the same
   law keeps its place beside it. */
static inline sb_vec3 sb_facets_place(const sb_facet_builder *b, size_t other, sb_vec3 at)
{
    const sb_model_body *bodies = b->model->bodies;
    const bool along =
        other != SIZE_MAX &&
        (other == b->body || (bodies[other].wavemaker >= 0 && bodies[other].wavemaker == bodies[b->body].wavemaker));
    return along ? at : sb_add(at, b->shift);
}

/* facet_plates.c: finds the bodies whose surface is open, so that water may be on both sides of it: b->plate. Returns
   0, or -1 without memory. */
int sb_facets_find_plates(sb_facet_builder *b);

/* facet_outlines.c: finds the outlines of all bodies: b->of_body. Where surfaces of two bodies meet at less than 45
   degrees, they are one bent surface: its facets end at the line in which they meet. Returns 0, or -1 without memory.
 */
int sb_facets_find_outlines(sb_facet_builder *b);
/* Cuts the domain's sides by the surfaces of bodies that meet them at less than 45 degrees, and these by the sides:
   b->of_side, b->of_body. A side that no body cuts stays whole. Returns 0, or -1 without memory. */
int sb_facets_cut_sides(sb_facet_builder *b);
/* Whether a side of the domain is a wall, and whether bodies cut it. */
bool sb_facets_is_wall(const sb_facet_builder *b, int side);
bool sb_facets_is_cut(const sb_facet_builder *b, int side);
/* Normal of a side, inwards; distance of a point from it in m, positive within the domain. */
sb_vec3 sb_facets_side_normal(int side);
double sb_facets_from_side(const sb_facet_builder *b, int side, sb_vec3 at);
/* Whether a point of an outline's plane lies in it, or nearer than `near` (m) to its border. */
bool sb_facets_near_outline(const sb_outline *o, sb_vec3 at, double near);

/* facet_bends.c: what stands behind an edge of a facet. self: the facet's outline, of b->outlines. Notes the wall at a
   concave edge. */
sb_bend sb_facets_bend(const sb_facet_builder *b, size_t self, const sb_facet *facet, sb_facet_edge *edge);

#endif
