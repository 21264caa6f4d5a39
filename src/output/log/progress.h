/* Shows the progress of a run and its estimated end: one rewritten line on a terminal, plain lines elsewhere. */
#ifndef SB_OUTPUT_PROGRESS_H
#define SB_OUTPUT_PROGRESS_H

#include "frame/step_report.h"

#include <stdio.h>

/* Filled by sb_progress_begin. Use its members through the functions only. */
typedef struct sb_progress {
    FILE *stream;        /* NULL: quiet */
    bool terminal, open; /* open: an unfinished line is on the terminal */
    double duration;     /* s, simulated time of the whole run */
    double started, shown;
    double mark_wall[2], mark_time[2]; /* s; an older and a newer point, from which the recent speed follows */
    double eta;
    double settling_begun;        /* wall time at which this process began settling; 0: it has not */
    int settling_before;          /* settling steps that earlier processes made */
    double settling_steps, steps; /* expected numbers of settling steps and of steps of the run */
} sb_progress;

/* stream NULL: quiet, only the estimate is computed. A line is printed every 0.2 s on a terminal, every 10 s
   elsewhere. */
void sb_progress_begin(sb_progress *progress, FILE *stream, double duration);

/* The run continues from this simulated time, not from 0. */
void sb_progress_resume(sb_progress *progress, double time);

/* Sets the expected numbers of settling steps, of which earlier processes made `done`, and of steps of the run. Call it
   before the first sb_progress_settling. The estimate during settling assumes that all steps take the same time. */
void sb_progress_plan(sb_progress *progress, int settling, int done, double steps);

/* Call the first after each settling step (an sb_settle_watch; the context is the progress), and the second once at the
   end of settling. */
void sb_progress_settling(void *progress, int done, int most, double speed);
void sb_progress_settled(sb_progress *progress);

/* Call after each step; prints if a line is due. */
void sb_progress_update(sb_progress *progress, const sb_step_report *report);

/* The run was paused for so many seconds: the estimate leaves them out. */
void sb_progress_paused(sb_progress *progress, double seconds);

/* Ends an unfinished line, before another message is printed. */
void sb_progress_break(sb_progress *progress);

/* Seconds of wall time since the start, and estimated to the end (negative: unknown). */
double sb_progress_wall(const sb_progress *progress);
double sb_progress_eta(const sb_progress *progress);

/* Prints the last state and ends the line. Call it also before any other message on a terminal. */
void sb_progress_end(sb_progress *progress, const sb_step_report *report);

/* Writes a duration as "1h 02m", "3m 05s" or "12s" into out; "?" if it is not known. */
void sb_progress_duration(char out[32], double seconds);

/* Writes a difference in per cent with its sign and two digits into out; what rounds to 0 is "0.00". */
void sb_progress_percent(char out[32], double percent);

#endif
