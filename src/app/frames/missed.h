/* Missed frames: frames of which no particle file or picture could be written. They are reported when they occur and
   saved in checkpoints, so that a run with missed frames ends as failed even after it was resumed. */
#ifndef SB_APP_MISSED_H
#define SB_APP_MISSED_H

#include "app/run/state.h"

/* Warns of consumers that began to fail, or worked again, since the last call. */
void sb_missed_report(run *r);

/* The sum over all processes of the run so far. */
sb_missed sb_missed_sum(run *r, int consumer);

/* SB_FAILED with the reason when frames are missing, or when the consumer, which is stopped, ended in trouble. */
sb_status sb_missed_check(run *r, int consumer, sb_error *error);

/* Write and read the missed frames within a section of an archive. */
void sb_missed_save(run *r, sb_archive_out *out);
void sb_missed_load(run *r, sb_archive_in *in);

#endif
