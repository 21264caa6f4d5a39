/* The time that a run has taken, summed over all its processes: a resumed run continues the sums. */
#ifndef SB_APP_SPENT_H
#define SB_APP_SPENT_H

#include "app/run/state.h"

/* Records the time of the stages so far as time of settling. Call it at the end of settling. */
void sb_spent_settled(run *r);

/* The sums so far. */
sb_spent sb_spent_sum(const run *r);

/* Write the sums to a checkpoint and read them as the time of earlier processes. */
void sb_spent_save(const run *r, sb_archive_out *out);
void sb_spent_load(run *r, sb_archive_in *in);

#endif
