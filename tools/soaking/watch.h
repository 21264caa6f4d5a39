/* The subscriber, and the one process that it listens to. */
#ifndef SB_SOAKING_WATCH_H
#define SB_SOAKING_WATCH_H

#include "lives.h"

typedef struct sb_soak_watch sb_soak_watch;

/* A run that can be started again and again. */
typedef struct sb_soak_run {
    const char *program, *scene, *out; /* out: the run's folder */
    const char *said;                  /* file for what it says */
    double spacing, duration;
} sb_soak_run;

/* Opens the subscriber, who listens for this soak's runs alone. SB_FAILED with the remedy when there is no route. */
sb_status sb_soak_watch_create(const sb_soak_run *run, sb_soak_watch **watch, sb_error *error);
void sb_soak_watch_destroy(sb_soak_watch *watch);

/* Starts the run, resumed or anew, watches it for so many seconds of wall time after its first frame, unless it ends
   before, then stops it with SIGTERM; fills the life but for begun. A run that breaks is told in the life; SB_FAILED
   when it cannot even be watched, SB_INTERRUPTED when this program was told to stop. */
sb_status sb_soak_live(sb_soak_watch *watch, bool resume, double seconds, sb_soak_life *life, sb_error *error);

#endif
