/* Stores finished runs, so that an interrupted set can continue and a report can be written again.
   OUT/runs/<case>/<spacing>-<preset>-<seed>-<request>/<build>/ contains the files of a run and, if it finished,
   record.txt. request: hash of the scene, its files and all settings. build: hash of the program. */
#ifndef SB_FRAMEWORK_RUN_STORE_H
#define SB_FRAMEWORK_RUN_STORE_H

#include "request.h"
#include "store.h"

/* The folder of the run of this request by this build. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_run_folder(const sb_store *store, const sb_request *request, char folder[SB_PATH_MAX], sb_error *error);
/* Finds the finished run of this build, or, with any_build, otherwise the newest one of another build. */
bool sb_run_find(const sb_store *store, const sb_request *request, bool any_build, char folder[SB_PATH_MAX]);

/* Adds to the processor time (s) of a run that was stopped and will continue. */
sb_status sb_run_spend(const char *folder, double cpu, sb_error *error);
/* Marks the run in a folder as finished and writes its record: commit (for a program from elsewhere the hash of its
   sources from the log), machine, cpu_s (processor time of all threads, including stopped parts) and load (the
   machine's mean over the last minute). A mark of a failure, as another tool leaves that tried to run in the same
   folder meanwhile, is removed. */
sb_status sb_run_finish(const sb_store *store, const char *folder, double cpu, sb_error *error);
/* Removes the marks that an earlier run left in the folder. */
sb_status sb_run_forget(const char *folder, sb_error *error);
/* Marks the run in a folder as failed; sb_run_failed reads the reason, and is false if it did not fail. */
sb_status sb_run_fail(const char *folder, const char *reason, sb_error *error);
bool sb_run_failed(const sb_store *store, const sb_request *request, char *reason, size_t size);

#endif
