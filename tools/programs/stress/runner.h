/* Runs trials as processes, several at a time, each with a time limit. */
#ifndef SB_BATTERY_RUNNER_H
#define SB_BATTERY_RUNNER_H

#include "stress.h"

#include <stdint.h>

typedef struct sb_trial_store {
    char out[SB_PATH_MAX];     /* absolute; OUT/runs/<case>/<trial>/ */
    char program[SB_PATH_MAX]; /* path of shorebreak */
    char assets[SB_PATH_MAX];  /* assets/stress */
    uint64_t build;            /* hash of shorebreak and of this tool */
    char commit[64], machine[128];
} sb_trial_store;

/* A requested trial and its case. */
typedef struct sb_job {
    const sb_stress *of;
    const sb_trial *trial;
} sb_job;

/* Makes the folder. SB_BAD_INPUT: program or assets do not exist. */
sb_status sb_trial_store_open(sb_trial_store *store, const char *out, const char *program, const char *own,
                              const char *source, sb_error *error);

/* Runs all trials that this build has not run, `jobs` at a time with one thread each. Prints on stdout how each ended.
   A trial that fails is an outcome, not an error. SB_INTERRUPTED after SIGINT or SIGTERM. */
sb_status sb_runner_run(const sb_trial_store *store, const sb_job *work, size_t count, int jobs, sb_error *error);

/* Reads the stored outcome of a trial, by this build or by another with the same scene and settings. */
sb_outcome sb_trial_store_read(const sb_trial_store *store, const sb_job *job);

#endif
