/* The insides of a run, seen by the files run*.c and checkpoint*.c only. */
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
    sb_scene resolved;     /* a shallow copy of the caller's, with what only the model can tell */
    const sb_scene *scene; /* it */
    const char *directory;
    int lock;          /* descriptor of the directory, locked for this run; -1: not yet */
    sb_run_files left; /* what the directory held before the run began */
    sb_model model;
    sb_sim *sim;
    sb_measure *measure;
    sb_csv *csv;
    sb_runlog *log;
    sb_progress progress;
    sb_recorder recorder;
    sb_pictures pictures;
    sb_streamer streamer;
    sb_consumer consumers[CONSUMERS]; /* those the scene asks for are started */
    double due[CONSUMERS];            /* s simulated, of their first frames */
    sb_missed missed[CONSUMERS];      /* by them, in earlier processes of this run */
    uint64_t told[CONSUMERS];         /* turns of their troubles that were told */
    sb_checkpoints checkpoints;
    sb_csv_marks tables; /* those that a resumed run goes on with */
    sb_energy first_energy;
    uint64_t iterations, capped, frames;
    double compression, compression_max; /* sum over the steps, and the worst: as in sb_step_report */
    size_t departures;                   /* of the first few, those that the log has */
    sb_spent before;                     /* what earlier processes of this run took; of this one, what settling did */
    uint64_t steps, iterations_before;   /* steps of this process; iterations before it */
    double particle_steps, setup_seconds, settling_seconds;
    sb_skipped off[SB_RUN_OFF_MAX + 1]; /* what else than simulation and measurements is left out */
    bool inside_known;
    uint64_t inside, crossed; /* particles within solids at the end */
};

/* run_start.c: directory, log, model, simulation, measurements, consumers, tables; from nothing, or, to resume and
   where there are checkpoints, from the newest that can be used. */
sb_status sb_run_start(run *r, const sb_run_manner *manner, sb_error *error);

/* run_obstacles.c: whether a run that begins in this manner may write into its directory: that is empty, or holds a run
   that it resumes or overwrites; nothing of another kind, and no other file, stands where it would write. Fills
   r->left. SB_BAD_INPUT or SB_FAILED says what stands against it. */
sb_status sb_run_admit(run *r, const sb_run_manner *manner, sb_error *error);

/* run_obstacles.c: whether any run could write into the folders that its scene needs. SB_FAILED says which is no folder
   of the run's own, or closed to it. */
sb_status sb_run_folders_free(const run *r, sb_error *error);

/* run_finish.c: whatever came before, leaves whole files; the first failure stays in *status and *error. */
void sb_run_finish(run *r, sb_status *status, sb_error *error);

/* ---- run_tell.c ---- */

/* A name within the run's directory. */
sb_status sb_run_path(const run *r, const char *name, char path[SB_PATH_MAX], sb_error *error);
/* A line on stdout, unless the run is quiet. */
void sb_run_say(const run *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A line on stderr and in the log. */
void sb_run_warn(run *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A log that was removed is made anew, with a warning. */
void sb_run_keep_log(run *r);
/* The log's periodic line, with the state's hash. */
void sb_run_log_step(run *r);
/* Seconds of wall time, earlier processes of this run included. */
double sb_run_wall(const run *r);

#endif
