/* Mirrors: the facets of bodies and of the domain's sides, at which water near them is reflected or, with boundary
   particles, only stopped. Lengths in quanta. */
#ifndef SB_SIM_MIRRORS_H
#define SB_SIM_MIRRORS_H

#include "sim/simulation.h"

typedef struct sb_mirror_edge {
    sb_vec3 from, to, inward;
    double distance; /* inward . x on the edge */
    sb_bend bend;
    sb_vec3 wall; /* as sb_facet_edge.wall */
} sb_mirror_edge;

/* One facet, or an image of it beyond a periodic side, at t = 0. */
typedef struct sb_mirror {
    sb_vec3 normal;
    double distance; /* normal . x on the plane */
    uint32_t body, edge, edges;
    uint32_t moving; /* index into walls.moving, UINT32_MAX: static */
    bool both;
    sb_facet_when when;
    sb_vec3 shift; /* m, from the original to this image beyond a periodic side */
} sb_mirror;

/* A mirror within a support radius of some place in a block of 2 x 2 x 2 cells. */
typedef struct sb_mirror_entry {
    uint64_t block;
    uint32_t mirror;
} sb_mirror_entry;

/* The facets near a group of particles, relative to the group's corner. */
enum { SB_NEAR_MAX = 200, SB_NEAR_EDGES_MAX = 1024 };

/* Two facets are at right angles if the cosine between their normals, without its sign, is below this. */
#define SB_FACETS_SQUARE 1e-3f

typedef struct sb_near_edge {
    sb_f4 inward; /* unit, in the facet's plane; last lane: inward . x on the edge; of a concave edge: the normal of the
                     wall that stands there, so that all water before both has no edge */
    sb_bend bend;
} sb_near_edge;

typedef struct sb_near_facet {
    sb_f4 plane;          /* unit normal; last lane: normal . x on the plane */
    uint32_t mirror;      /* index into walls.mirrors.mirror */
    uint32_t edge, edges; /* edges near the group that matter: [edge, edge + edges) of sb_near.edges */
    bool both;            /* water may be on both sides */
    bool parts;     /* there is water on both sides near the group: the facet may hide particles from each other */
    sb_f4 velocity; /* m/s, of the wall */
} sb_near_facet;

/* Smallest cosine between normals of facets of which none reflects what the other has reflected: 45 degrees. */
static const float SB_BENT = 0.7071f;

/* sb_near.sectors up to which facets reflect nothing of what the other has reflected: 120 degrees. */
static const float SB_SECTORS_LEAST = 1.5f;

typedef struct sb_near {
    size_t count, edge_count;
    bool simple;  /* no facet hides water or another facet */
    bool oblique; /* two facets meet at other than right angles and are not opposite: one may hide water from the other
                   */
    bool meeting; /* some path may be reflected at two facets */
    bool skew;    /* the same, at other than right angles; opposite facets included */
    bool moves;   /* a facet moves */
    bool full;    /* more than SB_NEAR_MAX facets or SB_NEAR_EDGES_MAX edges */
    sb_near_facet facet[SB_NEAR_MAX];
    sb_near_edge edges[SB_NEAR_EDGES_MAX];
    bool meets[SB_NEAR_MAX][SB_NEAR_MAX]; /* a path may be reflected at both, one after the other */
    /* pi over the angle between facets that meet, on the water's side; 2: a right angle, INFINITY: they face each
       other and are parallel; 0: they do not meet */
    float sectors[SB_NEAR_MAX][SB_NEAR_MAX];
    bool blunt[SB_NEAR_MAX]; /* it meets another one at more than a right angle and less than 120 degrees */
} sb_near;

/* Makes walls.mirrors of the model's facets, with their images beyond periodic sides. SB_FAILED without memory; also
   then the caller frees it with sb_mirrors_destroy. */
sb_status sb_mirrors_create(sb_sim *sim, sb_error *error);
void sb_mirrors_destroy(sb_sim *sim);
/* Lists those of moving bodies that water may meet where the bodies are now. */
void sb_mirrors_list_moving(sb_sim *sim);
size_t sb_mirrors_bytes(const sb_sim *sim);

/* Distance of a place from a mirror that has not moved, and of a place from a segment; places and distances in quanta.
 */
double sb_mirrors_distance(const sb_mirrors *m, const sb_mirror *mirror, sb_vec3 at);
double sb_mirrors_from_segment(sb_vec3 a, sb_vec3 b, sb_vec3 at);

/* near.c: finds the facets within a support radius of a group. low, high: the box of its particles, from the corner. */
void sb_mirrors_near(const sb_sim *sim, const sb_group *group, sb_f4 low, sb_f4 high, sb_near *near);

/* near.c: *count: the number of blocks in which there are more facets or edges near a single place than sb_near holds;
   moving bodies as they are placed. *place: the first such place, m. Returns 0, or -1 without memory. */
int sb_mirrors_crowded(const sb_sim *sim, size_t *count, sb_vec3 *place);

/* The entries of the block that a record is in, [returned, *end) of walls.mirrors.entry: facets of static bodies. */
size_t sb_mirrors_of_block(const sb_sim *sim, sb_record record, size_t *end);

/* Velocity of the wall, m/s. */
sb_f4 sb_mirror_velocity(const sb_sim *sim, uint32_t mirror);

/* Index of the model's body that a mirror belongs to, and the vector from an image of it beyond a periodic side to the
   original, m. */
uint32_t sb_mirror_body(const sb_sim *sim, uint32_t mirror);
sb_vec3 sb_mirror_shift(const sb_sim *sim, uint32_t mirror);

/* By how much q of an image below its original is larger, per quantum: beyond a wall the pressure goes on as in water
   at rest. With the same pressure on both sides the pressure at a floor would have no gradient. */
SB_INLINE float sb_hydrostatic(const sb_sim *sim)
{
    return sim->constant.gravity * (float)sim->space.quantum / sim->constant.rest_density;
}

#endif
