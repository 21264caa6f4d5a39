/* The internal state of a run. Private to src/app. */
#ifndef SB_APP_RUN_STATE_H
#define SB_APP_RUN_STATE_H

#include "app/checkpoint.h"
#include "app/consumers.h"
#include "app/missed.h"
#include "app/run.h"
#include "app/run_files.h"
#include "app/spent.h"
#include "measure/measure.h"
#include "output/csv.h"
#include "output/progress.h"
#include "sim/sim.h"

enum { RECORDER, PICTURES, STREAMER, CONSUMERS };
enum { SB_RUN_OFF_MAX = 6 };

struct run {
    sb_scene resolved;     /* a shallow copy of the caller's scene, with values that depend on the model */
    const sb_scene *scene; /* points to resolved */
    const char *directory;
    int lock;             /* descriptor of the locked directory; -1: not locked yet */
    sb_run_files earlier; /* the files in the directory before the run began */
    sb_model model;
    sb_sim *sim;
    sb_measure *measure;
    sb_csv *csv;
    sb_runlog *log;
    sb_progress progress;
    sb_recorder recorder;
    sb_pictures pictures;
    sb_streamer streamer;
    sb_consumer consumers[CONSUMERS]; /* those that the scene requests are started */
    double due[CONSUMERS];            /* simulated time of their first frames, s */
    sb_missed missed[CONSUMERS];      /* frames missed in earlier processes of this run */
    uint64_t reported[CONSUMERS];     /* changes of their trouble that were reported */
    sb_checkpoints checkpoints;
    sb_csv_marks tables; /* lengths and hashes of the tables that a resumed run continues */
    sb_energy first_energy;
    uint64_t iterations, capped, frames;
    double compression, compression_max; /* sum over the steps and maximum, as in sb_step_report */
    size_t departures;                   /* number of departures that were reported */
    sb_spent before; /* time of earlier processes of this run; and of this one's settling, per stage */
    uint64_t steps, iterations_before; /* steps of this process; iterations before it */
    double particle_steps, setup_seconds, settling_seconds;
    sb_skipped off[SB_RUN_OFF_MAX + 1]; /* parts other than simulation and measurements that are left out */
    bool inside_known;
    uint64_t inside, crossed; /* particles within solids at the end */
};

/* run_start.c: prepares directory, log, model, simulation, measurements, consumers and tables. Begins from the newest
   usable checkpoint when the run is resumed and has one, else from the beginning. */
sb_status sb_run_start(run *r, const sb_run_options *options, sb_error *error);

/* run_obstacles.c: checks that a run with these options may write into its directory. The directory must be empty or
   hold a run that is resumed or overwritten, and no file of other origin or kind may be in the place of a file that the
   run writes. Fills r->earlier. SB_BAD_INPUT or SB_FAILED with the reason otherwise. */
sb_status sb_run_check_directory(run *r, const sb_run_options *options, sb_error *error);

/* run_obstacles.c: checks that the run can write into the folders that its scene needs. SB_FAILED names the first
   folder that is not a directory, is a symbolic link, or cannot be written to. */
sb_status sb_run_check_folders(const run *r, sb_error *error);

/* run_finish.c: completes all files, however the run ended. *status and *error keep the first failure. */
void sb_run_finish(run *r, sb_status *status, sb_error *error);

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
