/* The subscriber and the process that it watches. */
#ifndef SB_SOAK_WATCH_H
#define SB_SOAK_WATCH_H

#include "lives.h"

typedef struct sb_soak_watch sb_soak_watch;

/* A run that can be started repeatedly. */
typedef struct sb_soak_run {
    const char *program, *scene, *out; /* out: the run's folder */
    const char *output;                /* file for its output */
    double spacing, duration;
} sb_soak_run;

/* Opens the subscriber to the runs of this soak. SB_FAILED: there is no network route; the error names the remedy. */
sb_status sb_soak_watch_create(const sb_soak_run *run, sb_soak_watch **watch, sb_error *error);
void sb_soak_watch_destroy(sb_soak_watch *watch);

/* Starts the run, new or resumed. Watches it for so many seconds of run time after its first frame, unless it ends
   earlier, then stops it with SIGTERM. Fills in the life, except `begun`. A failed run is recorded in the life.
   SB_FAILED: the run cannot be watched. SB_INTERRUPTED: this program was stopped. */
sb_status sb_soak_live(sb_soak_watch *watch, bool resume, double seconds, sb_soak_life *life, sb_error *error);

#endif
