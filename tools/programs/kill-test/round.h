/* One run, killed or undisturbed. */
#ifndef SB_KILL_TEST_ROUND_H
#define SB_KILL_TEST_ROUND_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

/* Program, scene and folder of a run. */
typedef struct sb_kill_run {
    const char *program, *scene, *out;
    bool pictures;
} sb_kill_run;

/* Random times of kills, uniform over [0, longest) s after each start. */
typedef struct sb_kill_moments {
    uint64_t seed, drawn;
    double longest;
} sb_kill_moments;

/* Makes an undisturbed run. *seconds: its run time. SB_FAILED: the run fails. */
sb_status sb_kill_none(const sb_kill_run *run, double *seconds, sb_error *error);

/* Runs in a folder without a run. Kills and resumes until the run finishes or has been killed `most` times, after which
   it may finish. Adds to *kills. SB_FAILED: a resumed run fails. */
sb_status sb_kill_some(const sb_kill_run *run, sb_kill_moments *moments, int most, int *kills, sb_error *error);

#endif
