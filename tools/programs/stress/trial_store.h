/* Stores trials and their outcomes in OUT/runs/<case>/<trial>/. */
#ifndef SB_STRESS_TRIAL_STORE_H
#define SB_STRESS_TRIAL_STORE_H

#include "store.h"
#include "stress.h"

/* A requested trial and its case. */
typedef struct sb_job {
    const sb_stress *of;
    const sb_trial *trial;
} sb_job;

sb_status sb_trial_folder(const sb_store *store, const sb_job *job, char folder[SB_PATH_MAX], sb_error *error);
/* Whether the stored outcome is by this build. */
bool sb_trial_is_stored(const sb_store *store, const sb_job *job);
/* Writes record.txt. */
sb_status sb_trial_write(const sb_store *store, const sb_job *job, const sb_outcome *outcome, sb_error *error);
/* Reads the stored outcome of a trial, by this build or by another with the same scene and settings. */
sb_outcome sb_trial_read(const sb_store *store, const sb_job *job);

#endif
