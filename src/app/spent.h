/* The time that a run has taken, in all the processes that worked on it: one that is resumed goes on counting. */
#ifndef SB_APP_SPENT_H
#define SB_APP_SPENT_H

#include "base/archive.h"
#include "output/summary.h"

struct run;

/* Notes what the stages have taken when the water has come to rest. */
void sb_spent_settled(struct run *r);

/* All of it so far. */
sb_spent sb_spent_sum(const struct run *r);

/* The same in a checkpoint; loaded, it is what earlier processes took. */
void sb_spent_save(const struct run *r, sb_archive_out *out);
void sb_spent_load(struct run *r, sb_archive_in *in);

#endif
