/* Where trials and their outcomes are kept. */
#ifndef SB_BATTERY_WORKBENCH_H
#define SB_BATTERY_WORKBENCH_H

#include "crew.h"

sb_status sb_workbench_folder(const sb_workbench *bench, const sb_job *job, char folder[SB_PATH_MAX], sb_error *error);
/* What is asked, as a number: the scene's text, the files it names, all that is set. */
uint64_t sb_workbench_request_hash(const sb_workbench *bench, const sb_job *job);
/* Whether this very build has an outcome for it. */
bool sb_workbench_has(const sb_workbench *bench, const sb_job *job);
/* Empties the trial's folder and makes it anew. */
sb_status sb_workbench_clear(const char *folder, sb_error *error);
/* Writes outcome.txt. */
sb_status sb_workbench_keep(const sb_workbench *bench, const sb_job *job, const sb_outcome *outcome, sb_error *error);

#endif
