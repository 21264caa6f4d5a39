/* The two passes of a pressure iteration over one group of particles: where a run spends its time. There are two forms,
   which give the same bits; which one is faster is the processor's matter (docs/decisions/0029). */
#ifndef SB_SIM_PASSES_H
#define SB_SIM_PASSES_H

#include "sim/around.h"

typedef struct sb_passes {
    /* sim->acceleration of the group, as sb_pressure_accelerate has it. */
    void (*accelerate)(sb_sim *sim, const sb_group *group);
    /* out of the group, as sb_divergence has it. */
    void (*diverge)(sb_sim *sim, const sb_group *group, const sb_f4 *field, float factor, float *out);
} sb_passes;

/* Two neighbours at a time, in vectors of 32 bytes: for any processor. */
extern const sb_passes sb_passes_narrow;
/* Four at a time, in vectors of 64 bytes; NULL where this processor, or this build, has none. */
const sb_passes *sb_passes_wide(void);
/* The form for this machine. */
const sb_passes *sb_passes_choose(void);

#endif
