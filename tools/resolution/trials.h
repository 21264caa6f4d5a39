/* Many runs of the real program for a study: what is wanted and not kept yet is run, then all is
   read. A trial is an sb_result whose request is filled in; the request's case and plan belong to
   the caller. */
#ifndef SB_STUDY_TRIALS_H
#define SB_STUDY_TRIALS_H

#include "results.h"

#include <stdio.h>

/* Runs what the store lacks (unless report_only) and reads what is there. In order, but one start seed (1, 2, ...)
 after the other: a machine that is slower for an hour meets all choices alike. Statuses and *failed as sb_launch. With
 report_only, runs of other builds count, too. */
sb_status sb_trials_make(const sb_store *store, sb_result *trials, size_t count, int jobs, bool report_only,
                         size_t *failed, sb_error *error);

/* Lines of Markdown: machines, commits, load; names the runs whose times are provisional. */
void sb_trials_where(FILE *out, const sb_store *store, const sb_result *trials, size_t count);
/* The same behind the command. */
void sb_trials_origin(FILE *out, const sb_store *store, const sb_result *trials, size_t count, const char *command);

/* A row of a Markdown table that says why a trial has no figures; true when it has none. */
bool sb_trial_problem(FILE *out, const sb_result *trial);

/* The store in `out` for the program beside this one, or `program`. */
sb_status sb_trials_store(sb_store *store, const char *out, const char *program, const char *source, sb_error *error);

/* Settings that switch off what a study has no use for, ended by NULL: pictures, stream, particles. */
extern const char *const sb_trial_settings[];
enum { SB_TRIAL_SETTINGS = 3 };

#endif
