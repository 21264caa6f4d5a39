/* What came of leaving things out: the sum for the log's end and the stage table. */
#ifndef SB_OUTPUT_SAVED_H
#define SB_OUTPUT_SAVED_H

#include "base/skipped.h"
#include "sim/sim.h"

typedef struct sb_saved {
    int passes;     /* over pairs, in each step */
    double seconds; /* about what they would have taken so far in this process, settling included: each as the stage
                       `source`, which is one such pass and nothing else */
    size_t bytes;
} sb_saved;

/* Of so many lists, each ended by an entry without text, or NULL. */
sb_saved sb_saved_sum(const sb_skipped *const *lists, size_t count, const sb_stage_time *stages, size_t stage_count);

#endif
