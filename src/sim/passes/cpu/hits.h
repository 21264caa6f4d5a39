/* Finds the neighbours of a particle among candidates: tests the candidates sixteen at a time and stores the hits
   contiguously. */
#ifndef SB_SIM_HITS_H
#define SB_SIM_HITS_H

#include "sim/state/simd.h"

#include <stddef.h>

enum {
    SB_LIST_MAX = 1024,  /* neighbours of one particle: 80 are normal */
    SB_HITS_MAX = 16352, /* the same with images that walls hide */
    SB_HIT_LANES = 8,
    SB_HIT_SPARE = 96, /* vector loads and stores may pass the end by 31 entries; 96 by measurement (0029) */
    SB_CANDIDATES_MAX = 16383,
    SB_CANDIDATE_RANGES_MAX = 27
};

/* Coordinates of candidates in quanta, relative to one corner. */
typedef struct sb_candidates {
    const float *x, *y, *z; /* SB_HIT_SPARE entries beyond the last can be read */
    const sb_f4 *place;     /* the same coordinates, one record each; the last lane has no meaning */
} sb_candidates;

/* Candidates [begin, end). */
typedef struct sb_candidate_range {
    uint32_t begin, end;
} sb_candidate_range;

/* The hits of one particle. */
typedef struct sb_hits {
    size_t count,
        padded; /* count rounded up to SB_HIT_LANES: filled with the particle itself at q = 1, where kernels vanish */
    float x[SB_HITS_MAX + SB_HIT_SPARE], y[SB_HITS_MAX + SB_HIT_SPARE], z[SB_HITS_MAX + SB_HIT_SPARE];
    float q2[SB_HITS_MAX + SB_HIT_SPARE], value[SB_HITS_MAX + SB_HIT_SPARE], slope[SB_HITS_MAX + SB_HIT_SPARE];
    float root[SB_HITS_MAX + SB_HIT_SPARE]; /* of the slopes, as lists store them */
    uint32_t candidate[SB_HITS_MAX + SB_HIT_SPARE];
} sb_hits;

/* Finds the candidates with (scale r)^2 < 1, except candidate `skip`, as offsets self - candidate in the order of the
   ranges. There are at most SB_CANDIDATE_RANGES_MAX ranges, which do not overlap and have at most SB_CANDIDATES_MAX
   candidates in all. Returns the number of hits; SB_HITS_MAX or more means that some may be missing. */
typedef size_t sb_find_hits(const sb_candidates *of, const sb_candidate_range *range, size_t ranges, sb_hits *hits,
                            sb_f4 self, float scale2, uint32_t skip);

/* The implementation for any processor. */
sb_find_hits sb_find_hits_portable;
/* The implementation for this processor; all give the same bits. */
sb_find_hits *sb_find_hits_choose(void);

#endif
