/* Result of the neighbour search: groups of particles, the records around each group, and lists of pairs. */
#ifndef SB_SIM_PAIRS_H
#define SB_SIM_PAIRS_H

#include "sim/state/simd.h"

#include <stddef.h>

/* Consecutive records in the arrays that neighbours are read from. */
typedef struct sb_run {
    uint32_t begin, count;
} sb_run;

/* A plane of walls near a group: unit normal, and normal . x on it with x in quanta from the group's corner. */
typedef struct sb_group_plane {
    sb_f4 plane;
    uint32_t mirror; /* index into walls.mirrors */
} sb_group_plane;

/* A record reflected by planes of its group. path: indices of the planes plus 1, the first reflection in the lowest
   byte; 0: no more. at: its place when the lists were made, as an offset from the group's corner, because to reflect it
   again in every pass took as long as the pass itself over the pairs (docs/decisions/0039). */
enum { SB_REFLECTIONS_MAX = 4, SB_REFLECTION_BITS = 8, SB_REFLECTION_MASK = 255 };
typedef struct sb_image {
    float at[3];         /* quanta */
    uint32_t from, path; /* from: right after `at` (sb_image_carrying) */
} sb_image;

/* Consecutive particles, and the records around them; see sim/search/around.h. */
typedef struct sb_group {
    uint32_t first, end;    /* particles [first, end) */
    uint32_t run, runs;     /* records around them, themselves included: runs [run, run + runs) */
    uint32_t image, images; /* images of records around them */
    uint32_t plane, planes; /* that reflect them */
    sb_record corner;       /* quanta: no record around is below it, or four cells or more above it */
} sb_group;

typedef struct sb_groups {
    sb_group *group;
    size_t count, capacity;
    uint32_t *order; /* several domains: indices of the groups, first the `inner` ones, which read no ghosts */
    size_t inner, order_capacity;
    sb_run *run;
    size_t used, room; /* runs */
    sb_image *image;
    size_t images_used, images_room;
    sb_group_plane *plane;
    size_t planes_used, planes_room;
} sb_groups;

/* Four neighbours. place: the argument of sb_at. slope: the root of m W'(r)/r times the quantum over sb_lists.unit,
   below 2^15. unit * slope^2 * offset in quanta is then m grad W, the same for both particles of a pair. The root is
   stored because W' decreases towards the support radius as a square or faster. */
typedef struct sb_four_pairs {
    uint16_t place[4], slope[4];
} sb_four_pairs;

/* Largest stored root: its square is the slope of a coincident particle in units of sb_lists.unit. */
enum { SB_ROOT_MAX = 32767 };

/* Fluid neighbours of particle i: groups of four [first[i], first[i] + count[i]). The last group is padded with the
   particle itself at slope 0. */
typedef struct sb_lists {
    uint32_t *first;  /* n */
    uint16_t *count;  /* n */
    uint16_t *direct; /* n: of the groups of four, those with particles, which come first; then those with images; NULL:
                         there are no images */
    sb_four_pairs *four;
    size_t used, capacity; /* groups of four */
    float unit;            /* < 0 */
} sb_lists;

static inline uint16_t sb_direct(const sb_lists *lists, size_t i)
{
    return lists->direct ? lists->direct[i] : lists->count[i];
}

/* What a pair (i, j) has besides its slope where its weight changes with the places of both: m W times the derivative
   of the weight by x_i (own) and by x_j (other), kg/m^4. head: own times the quanta by which the image is below its
   original, 0 of direct pairs. mirror: the facet that weighs the path. */
typedef struct sb_edge_pair {
    float own[3];
    uint32_t entry;
    float other[3];
    uint32_t mirror;
    float head[3];
} sb_edge_pair;

SB_INLINE sb_f4 sb_edge_own(const sb_edge_pair *e)
{
    return (sb_f4){e->own[0], e->own[1], e->own[2], 0};
}

SB_INLINE sb_f4 sb_edge_other(const sb_edge_pair *e)
{
    return (sb_f4){e->other[0], e->other[1], e->other[2], 0};
}

SB_INLINE sb_f4 sb_edge_head(const sb_edge_pair *e)
{
    return (sb_f4){e->head[0], e->head[1], e->head[2], 0};
}

/* Such pairs of particle i: [first[i], first[i] + count[i]). */
typedef struct sb_edge_pairs {
    uint32_t *first; /* n; NULL: walls do not reflect */
    uint16_t *count; /* n */
    sb_edge_pair *pair;
    size_t used, capacity;
} sb_edge_pairs;

/* Boundary particles around particle i: [first[i], first[i] + count[i]), padded to a multiple of four with slope 0. */
typedef struct sb_pairs {
    uint32_t *first; /* n; NULL: walls reflect, and there are no lists */
    uint16_t *count; /* n, padded to a multiple of 4 */
    uint32_t *index; /* see sim/walls/entry.h */
    float *slope;    /* psi W'(r)/r times the quantum */
    size_t used, capacity;
} sb_pairs;

#endif
