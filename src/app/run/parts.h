/* The parts of a run, each in a file of its own, and its messages. Private to src/app. */
#ifndef SB_APP_RUN_PARTS_H
#define SB_APP_RUN_PARTS_H

#include "app/run/state.h"

struct sb_run_options; /* app/run.h */

/* run_start.c: prepares directory, log, model, simulation, measurements, consumers and tables. Begins from the newest
   usable checkpoint when the run is resumed and has one, else from the beginning. */
sb_status sb_run_start(run *r, const struct sb_run_options *options, sb_error *error);

/* run_obstacles.c: checks that a run with these options may write into its directory. The directory must be empty or
   hold a run that is resumed or overwritten, and no file of other origin or kind may be in the place of a file that the
   run writes. Fills r->earlier. SB_BAD_INPUT or SB_FAILED with the reason otherwise. */
sb_status sb_run_check_directory(run *r, const struct sb_run_options *options, sb_error *error);

/* run_obstacles.c: checks that the run can write into the folders that its scene needs. SB_FAILED names the first
   folder that is not a directory, is a symbolic link, or cannot be written to. */
sb_status sb_run_check_folders(const run *r, sb_error *error);

/* run_consumers.c: sets up particle files and stream, before anything of them is started. */
void sb_run_name_consumers(run *r);

/* run_consumers.c: starts the consumers that the scene asks for, and notes those that are off in r->off. In a new run
   it is called before settling, so that the renderer is made during settling; in a resumed run after the checkpoint was
   loaded, which lists the files that exist. SB_FAILED if the system refuses a thread. */
sb_status sb_run_start_consumers(run *r, sb_error *error);

/* run_finish.c: completes all files, however the run ended. *status and *error keep the first failure. */
void sb_run_finish(run *r, sb_status *status, sb_error *error);

/* run_stream.c: gives the stream, if there is one, the progress of the run and the rows of the last step. */
void sb_run_inform_stream(run *r);

/* steering_acts.c: replies to a command and logs it. Any thread may call it. */
void sb_steering_reply(run *r, const sb_command *command, uint64_t step, double time, bool refused, const char *text);

/* ---- run_report.c ---- */

/* The path of a file in the run's directory. */
sb_status sb_run_path(const run *r, const char *name, char path[SB_PATH_MAX], sb_error *error);
/* Prints a line on stdout, unless the run is quiet. */
void sb_run_report(const run *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Writes a warning to stderr and to the log. */
void sb_run_warn(run *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Makes the log again if it was removed, with a warning. */
void sb_run_ensure_log(run *r);
/* Writes the periodic line of the log, with the state hash. */
void sb_run_log_step(run *r);
/* Wall time of all processes of this run, s. */
double sb_run_wall(const run *r);

#endif
