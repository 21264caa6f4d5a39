/* Frames that came to no file and no picture: told when it happens, and kept from process to process of a run, so that
   one that misses any never ends as if all were there. */
#ifndef SB_APP_MISSED_H
#define SB_APP_MISSED_H

#include "base/archive.h"
#include "base/status.h"

#include <stdint.h>

typedef struct run run; /* app/run_state.h */

/* Of one consumer. */
typedef struct sb_missed {
    uint64_t count;
    char reason[sizeof((sb_error *)0)->text]; /* of the first one */
} sb_missed;

/* Warns of consumers that have begun to miss frames since it was last called, and of those that have ceased to. */
void sb_missed_tell(run *r);

/* Of all processes of the run so far. */
sb_missed sb_missed_sum(run *r, int consumer);

/* SB_FAILED when any are missing, or when the trouble of a consumer that is stopped never ended: why. */
sb_status sb_missed_judge(run *r, int consumer, sb_error *error);

/* Within a section of an archive, and back. */
void sb_missed_save(run *r, sb_archive_out *out);
void sb_missed_load(run *r, sb_archive_in *in);

#endif
