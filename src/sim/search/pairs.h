/* Result of the neighbour search: groups of particles, the records around each group, and lists of pairs. */
#ifndef SB_SIM_PAIRS_H
#define SB_SIM_PAIRS_H

#include "sim/state/simd.h"

#include <stddef.h>

/* Consecutive records in the arrays that neighbours are read from. */
typedef struct sb_run {
    uint32_t begin, count;
} sb_run;

/* Consecutive particles, and the records around them; see sim/search/around.h. */
typedef struct sb_group {
    uint32_t first, end; /* particles [first, end) */
    uint32_t run, runs;  /* records around them, themselves included: runs [run, run + runs) */
    sb_record corner;    /* quanta: no record around is below it, or four cells or more above it */
} sb_group;

typedef struct sb_groups {
    sb_group *group;
    size_t count, capacity;
    sb_run *run;
    size_t used, room; /* runs */
} sb_groups;

/* Four neighbours. place: the argument of sb_at. slope: the root of m W'(r)/r times the quantum over sb_lists.unit,
   below 2^15. unit * slope^2 * offset in quanta is then m grad W, the same for both particles of a pair. The root is
   stored because W' decreases towards the support radius as a square or faster. */
typedef struct sb_four_pairs {
    uint16_t place[4], slope[4];
} sb_four_pairs;

/* Largest stored root, and its square: the slope of a coincident particle in units of sb_lists.unit. */
enum { SB_ROOT_MAX = 32767 };
static const float SB_SLOPE_OWN = (float)SB_ROOT_MAX * (float)SB_ROOT_MAX;

/* Fluid neighbours of particle i: groups of four [first[i], first[i] + count[i]). The last group is padded with the
   particle itself at slope 0. */
typedef struct sb_lists {
    uint32_t *first; /* n */
    uint16_t *count; /* n */
    sb_four_pairs *four;
    size_t used, capacity; /* groups of four */
    float unit;            /* < 0 */
} sb_lists;

/* Boundary particles around particle i: [first[i], first[i] + count[i]), padded to a multiple of four with slope 0. */
typedef struct sb_pairs {
    uint32_t *first; /* n */
    uint16_t *count; /* n, padded to a multiple of 4 */
    uint32_t *index; /* see sim/walls/entry.h */
    float *slope;    /* psi W'(r)/r times the quantum */
    size_t used, capacity;
} sb_pairs;

#endif
