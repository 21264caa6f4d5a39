/* Stores trials and their outcomes. */
#ifndef SB_BATTERY_TRIAL_STORE_H
#define SB_BATTERY_TRIAL_STORE_H

#include "runner.h"

sb_status sb_trial_store_folder(const sb_trial_store *store, const sb_job *job, char folder[SB_PATH_MAX],
                                sb_error *error);
/* Hash of a request: the scene's text, the files that it names, and all settings. */
uint64_t sb_trial_store_request_hash(const sb_trial_store *store, const sb_job *job);
/* Whether the stored outcome is by this build. */
bool sb_trial_store_has(const sb_trial_store *store, const sb_job *job);
/* Makes an empty folder for the trial. */
sb_status sb_trial_store_clear(const char *folder, sb_error *error);
/* Writes record.txt. */
sb_status sb_trial_store_write(const sb_trial_store *store, const sb_job *job, const sb_outcome *outcome,
                               sb_error *error);

#endif
