/* Makes the runs of a study: runs that are not stored yet are made, then all are read. A trial is an sb_result with a
   request; the request's case and plan belong to the caller. */
#ifndef SB_STUDY_TRIALS_H
#define SB_STUDY_TRIALS_H

#include "results.h"

#include <stdio.h>

/* Makes the runs that are not stored (unless report_only) and reads all that are. Runs are in order, but grouped by
   start seed (1, 2, ...), so that a temporarily slower machine affects all choices alike. Statuses and *failed as of
   sb_launch. With report_only, runs of other builds count, too. */
sb_status sb_trials_make(const sb_store *store, sb_result *trials, size_t count, int jobs, bool report_only,
                         size_t *failed, sb_error *error);

/* Writes machines, commits and load in Markdown; names the runs with provisional times. */
void sb_trials_where(FILE *out, const sb_store *store, const sb_result *trials, size_t count);
/* The same after a line with the command. */
void sb_trials_origin(FILE *out, const sb_store *store, const sb_result *trials, size_t count, const char *command);

/* If a trial has no figures, writes a list item with the reason and returns true. */
bool sb_trial_problem(FILE *out, const sb_result *trial);

/* Opens the store in `out` for `program`; NULL: the shorebreak beside this program. */
sb_status sb_trials_store(sb_store *store, const char *out, const char *program, const char *source, sb_error *error);

/* Settings that switch off pictures, stream and particle files, ended by NULL. */
extern const char *const sb_trial_settings[];
enum { SB_TRIAL_SETTINGS = 3 };

#endif
