/* The savings from terms that a scene does not need: their sum for the log's end and for the stage table. */
#ifndef SB_OUTPUT_SAVED_H
#define SB_OUTPUT_SAVED_H

#include "base/skipped.h"
#include "frame/stage_time.h"

typedef struct sb_saved {
    int passes;     /* over particle pairs, in each step */
    double seconds; /* estimate of the time that they would have taken so far in this process, including settling: each
                       as long as the stage `source`, which is exactly one such pass */
    size_t bytes;
} sb_saved;

/* Sums over `count` lists. Each ends with an entry without text, or is NULL. */
sb_saved sb_saved_sum(const sb_skipped *const *lists, size_t count, const sb_stage_time *stages, size_t stage_count);

#endif
