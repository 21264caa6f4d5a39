/* One run, disturbed or not. */
#ifndef SB_KILLING_ROUND_H
#define SB_KILLING_ROUND_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

/* What a run is made of. */
typedef struct sb_kill_run {
    const char *program, *scene, *out;
    bool pictures;
} sb_kill_run;

/* When to kill: uniform over [0, longest) s after each start. */
typedef struct sb_kill_moments {
    uint64_t seed, drawn;
    double longest;
} sb_kill_moments;

/* Runs to the end, undisturbed; *seconds of wall time. SB_FAILED when the run fails. */
sb_status sb_kill_none(const sb_kill_run *run, double *seconds, sb_error *error);

/* Runs into a folder that holds no run, kills and resumes until the run reaches its end by itself, or `most` kills
   are done, after which it may end. Adds to *kills. SB_FAILED when a resumed run fails. */
sb_status sb_kill_some(const sb_kill_run *run, sb_kill_moments *moments, int most, int *kills, sb_error *error);

#endif
