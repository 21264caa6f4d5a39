/* Stores finished runs, so that an interrupted set can continue and a report can be written again.
   OUT/runs/<case>/<spacing>-<preset>-<seed>-<request>/<build>/ contains the files of a run and, if it finished,
   record.txt. request: hash of the scene, its files and all settings. build: hash of the program. */
#ifndef SB_VALIDATION_STORE_H
#define SB_VALIDATION_STORE_H

#include "base/file.h"
#include "request.h"

typedef struct sb_store {
    char out[SB_PATH_MAX];     /* absolute */
    char program[SB_PATH_MAX]; /* path of shorebreak */
    char assets[SB_PATH_MAX];  /* assets/validation */
    uint64_t build;            /* hash of the program */
    char commit[64]; /* of the source tree; "unknown": git does not report it; "": the program is from elsewhere */
    char machine[128];
} sb_store;

/* Makes the folder. SB_BAD_INPUT: the program or the assets do not exist. */
sb_status sb_store_open(sb_store *store, const char *out, const char *program, const char *source, sb_error *error);

/* The folder of the run of this request by this build. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_store_folder(const sb_store *store, const sb_request *request, char folder[SB_PATH_MAX], sb_error *error);

/* Hash of the request, in hexadecimal. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_store_request_hash(const sb_store *store, const sb_request *request, char hash[17], sb_error *error);

/* sb_scene_defaults_hash of its scene for the defaults of this program. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_store_defaults_hash(const sb_store *store, const sb_request *request, uint64_t *hash, sb_error *error);

/* Finds the finished run of this build, or, with any_build, otherwise the newest one of another build. */
bool sb_store_find(const sb_store *store, const sb_request *request, bool any_build, char folder[SB_PATH_MAX]);

/* Adds to the processor time (s) of a run that was stopped and will continue. */
sb_status sb_store_spend(const char *folder, double cpu, sb_error *error);
/* Marks the run in a folder as finished and writes its record: commit (for a program from elsewhere the hash of its
   sources from the log), machine, cpu_s (processor time of all threads, including stopped parts) and load (the
   machine's mean over the last minute). */
sb_status sb_store_finish(const sb_store *store, const char *folder, double cpu, sb_error *error);

/* Removes the marks that an earlier run left in the folder. */
sb_status sb_store_forget(const char *folder, sb_error *error);
/* Marks the run in a folder as failed; sb_store_failed reads the reason, and is false if it did not fail. */
sb_status sb_store_fail(const char *folder, const char *reason, sb_error *error);
bool sb_store_failed(const sb_store *store, const sb_request *request, char *reason, size_t size);

#endif
