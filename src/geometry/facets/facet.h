/* Convex facets of the surface of bodies, at which walls reflect water. Plain data. */
#ifndef SB_GEOMETRY_FACET_H
#define SB_GEOMETRY_FACET_H

#include "base/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How the surface goes on beyond an edge of a facet, seen from the water. */
typedef enum sb_bend {
    SB_BEND_SOFT,    /* another facet, turned away from the water by less than 45 degrees, or not at all */
    SB_BEND_HOLLOW,  /* another facet, turned towards the water by less than 45 degrees */
    SB_BEND_CONVEX,  /* it turns away by more, or ends: water sees round the edge */
    SB_BEND_CONCAVE, /* it turns towards the water by more, or the domain ends: water sees no edge */
} sb_bend;

typedef struct sb_facet_edge {
    sb_vec3 from, to; /* m; in 2D both are the same point */
    sb_vec3 inward;   /* unit, in the facet's plane */
    sb_bend bend;
    sb_vec3 wall; /* of a concave edge: unit normal of what stands there; 0 if it is not known */
} sb_facet_edge;

/* When water meets a facet: of a body that moves, some only while it stands at its place at rest, or has left it. The
   lower face of a gate is hidden by the floor on which it stands, and its edges are free once it is lifted. */
typedef enum sb_facet_when { SB_FACET_ALWAYS, SB_FACET_AT_REST, SB_FACET_AWAY } sb_facet_when;

typedef struct sb_facet {
    sb_vec3 normal;       /* unit, towards the water */
    double distance;      /* m, normal . x on the plane */
    uint32_t body;        /* index into model.bodies */
    uint32_t edge, edges; /* [edge, edge + edges) of sb_facets.edges; none: a whole side of the domain */
    bool both;            /* water may be on both sides: a facet of a plate */
    sb_facet_when when;
} sb_facet;

typedef struct sb_facets {
    size_t count, edge_count;
    sb_facet *facets;
    sb_facet_edge *edges;
} sb_facets;

#endif
