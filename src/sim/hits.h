/* Who is in reach of a particle: candidates side by side, tested sixteen at a time, the hits packed together. */
#ifndef SB_SIM_HITS_H
#define SB_SIM_HITS_H

#include "sim/simd.h"

#include <stddef.h>

enum {
    SB_LIST_MAX = 1024, /* neighbours of one particle: 80 are normal */
    SB_HIT_LANES = 8,
    SB_HIT_SPARE = 96, /* vector loads and stores may run past the end, by 31; as many, for it was timed (0029) */
    SB_CANDIDATES_MAX = 16383,
    SB_CANDIDATE_RANGES_MAX = 27
};

/* Coordinates of candidates in quanta, from a corner of their own. */
typedef struct sb_candidates {
    const float *x, *y, *z; /* SB_HIT_SPARE entries beyond the last can be read */
    const sb_f4 *place;     /* the same, a record each; its last lane means nothing */
} sb_candidates;

/* Candidates [begin, end). */
typedef struct sb_candidate_range {
    uint32_t begin, end;
} sb_candidate_range;

/* The hits of one particle. */
typedef struct sb_hits {
    size_t count,
        padded; /* padded to SB_HIT_LANES by the particle itself at the support radius, where kernels vanish */
    float x[SB_LIST_MAX + SB_HIT_SPARE], y[SB_LIST_MAX + SB_HIT_SPARE], z[SB_LIST_MAX + SB_HIT_SPARE];
    float q2[SB_LIST_MAX + SB_HIT_SPARE], value[SB_LIST_MAX + SB_HIT_SPARE], slope[SB_LIST_MAX + SB_HIT_SPARE];
    float root[SB_LIST_MAX + SB_HIT_SPARE]; /* as lists store slopes */
    uint32_t candidate[SB_LIST_MAX + SB_HIT_SPARE];
} sb_hits;

/* Candidates with (scale r)^2 < 1 as offsets self - candidate, in the order of the stretches, without candidate
   `skip`. SB_CANDIDATE_RANGES_MAX stretches of SB_CANDIDATES_MAX candidates together at most, none in two. Returns how
   many hits; SB_LIST_MAX or more means that some may have been left out. */
typedef size_t sb_find_hits(const sb_candidates *of, const sb_candidate_range *stretch, size_t stretches, sb_hits *hits,
                            sb_f4 self, float scale2, uint32_t skip);

/* For any processor. */
sb_find_hits sb_find_hits_portable;
/* The form for this machine; all give the same bits. */
sb_find_hits *sb_find_hits_choose(void);

#endif
