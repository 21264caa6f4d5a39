/* Publishes a recorded run again. */
#ifndef SB_STREAM_REPLAY_H
#define SB_STREAM_REPLAY_H

#include "stream/live.h"

typedef struct sb_replay sb_replay;

typedef struct sb_replay_options {
    const char *url;    /* LCM provider; NULL or empty: LCM_DEFAULT_URL, else LCM's default */
    const char *prefix; /* of the run's channels; NULL: of the first run in the log */
    double speed;       /* of the recorded time; 0: as fast as subscribers can receive */
} sb_replay_options;

/* Opens the log and the provider. SB_BAD_INPUT if the log has no valid message of such a run. */
sb_status sb_replay_create(const char *log, const sb_replay_options *options, sb_replay **replay, sb_error *error);
void sb_replay_destroy(sb_replay *replay);

/* Publishes for about so many seconds of wall time. SB_INTERRUPTED: all is published. The run gets a new id and new
   sequence numbers; invalid messages are left out. The scene and the last status are repeated as a run does, at any
   speed. */
sb_status sb_replay_run(sb_replay *replay, double seconds);

/* What was published so far, checked as by a subscriber. */
const sb_live *sb_replay_view(const sb_replay *replay);
uint64_t sb_replay_left_out(const sb_replay *replay); /* bytes of the log that are not messages (sb_log_left_out) */
uint64_t sb_replay_errors(const sb_replay *replay);   /* messages that LCM refused */

#endif
