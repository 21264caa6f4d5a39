/* How far a run is and when it will end: one rewritten line on a terminal, plain lines elsewhere.
 */
#ifndef SB_OUTPUT_PROGRESS_H
#define SB_OUTPUT_PROGRESS_H

#include "sim/sim.h"

#include <stdio.h>

/* Filled by sb_progress_begin; read nothing but through the functions. */
typedef struct sb_progress {
    FILE *stream;        /* NULL: quiet */
    bool terminal, open; /* open: an unfinished line is on the terminal */
    double duration;     /* s simulated in all */
    double started, shown;
    double mark_wall[2], mark_time[2]; /* an older and a newer point, to tell the recent speed */
    double eta;
    double settling_begun;        /* wall, when this process began to settle; 0: it has not */
    int settling_before;          /* steps of settling that were done by then */
    double settling_steps, steps; /* as many as are expected, of settling and of the run */
} sb_progress;

/* stream NULL: quiet, only the ETA is kept. Lines come every 0.2 s on a terminal,
   every 10 s elsewhere. */
void sb_progress_begin(sb_progress *progress, FILE *stream, double duration);

/* The run goes on from this time, not from 0. */
void sb_progress_resume(sb_progress *progress, double time);

/* What is to come: steps of settling, of which `done` were made by earlier processes, then steps of the run. Before the
   first call of sb_progress_settling, for the ETA while the water settles; a step of either counts alike. */
void sb_progress_plan(sb_progress *progress, int settling, int done, double steps);

/* Call after each step of the settling before t = 0 (sb_settle_watch; the context is the progress), then once when it
   is over. */
void sb_progress_settling(void *progress, int done, int most, double speed);
void sb_progress_settled(sb_progress *progress);

/* Call after each step; prints when it is time to. */
void sb_progress_update(sb_progress *progress, const sb_step_report *report);

/* Seconds of wall time since the start, and estimated to the end (negative: unknown). */
double sb_progress_wall(const sb_progress *progress);
double sb_progress_eta(const sb_progress *progress);

/* Prints the last state and ends the line. Also before any other message on a terminal. */
void sb_progress_end(sb_progress *progress, const sb_step_report *report);

/* "1h 02m", "3m 05s", "12s" into out. */
void sb_progress_duration(char out[32], double seconds);

#endif
