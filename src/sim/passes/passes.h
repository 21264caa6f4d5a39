/* The two passes of a pressure iteration over one group of particles, which take most of a run's time. There are two
   implementations, which give the same bits; the faster one depends on the processor (docs/decisions/0029). */
#ifndef SB_SIM_PASSES_H
#define SB_SIM_PASSES_H

#include "sim/search/around.h"

typedef struct sb_passes {
    /* sb_pressure_accelerate for the particles of one group. */
    void (*accelerate)(sb_sim *sim, const sb_group *group);
    /* sb_divergence for the particles of one group. */
    void (*diverge)(sb_sim *sim, const sb_group *group, const sb_f4 *field, float factor, float *out);
} sb_passes;

/* Two neighbours at a time, in vectors of 32 bytes: for any processor. */
extern const sb_passes sb_passes_narrow;
/* Four at a time, in vectors of 64 bytes; NULL if this processor or this build has no such vectors. */
const sb_passes *sb_passes_wide(void);
/* The implementation for this processor. */
const sb_passes *sb_passes_choose(void);

#endif
