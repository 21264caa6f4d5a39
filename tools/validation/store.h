/* Where finished runs are kept, so that an interrupted set goes on and a
   report can be made again. OUT/runs/<case>/<spacing>-<preset>-<seed>-<what was asked>/<build>/
   holds a run's files and, once it has ended well, record.txt. What was asked: a hash of the scene,
   its files and all settings; build: a hash of the program. */
#ifndef SB_VALIDATION_STORE_H
#define SB_VALIDATION_STORE_H

#include "base/file.h"
#include "request.h"

typedef struct sb_store {
    char out[SB_PATH_MAX];     /* absolute */
    char program[SB_PATH_MAX]; /* the shorebreak that runs */
    char assets[SB_PATH_MAX];  /* assets/validation */
    uint64_t build;            /* hash of the program */
    char commit[64]; /* of the source tree, "unknown" where git cannot tell; "": of a program from elsewhere */
    char machine[128];
} sb_store;

/* Makes the folder. SB_BAD_INPUT when the program or the assets are not there. */
sb_status sb_store_open(sb_store *store, const char *out, const char *program, const char *source, sb_error *error);

/* The folder for this request's run by this build. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_store_folder(const sb_store *store, const sb_request *request, char folder[SB_PATH_MAX], sb_error *error);

/* What the request asks for, in hexadecimal. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_store_asked(const sb_store *store, const sb_request *request, char asked[17], sb_error *error);

/* Its scene with every default of this program, as sb_scene_meaning. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_store_meant(const sb_store *store, const sb_request *request, uint64_t *meant, sb_error *error);

/* Whether the run of this build is there; with any_build, failing that, the newest of another. */
bool sb_store_find(const sb_store *store, const sb_request *request, bool any_build, char folder[SB_PATH_MAX]);

/* Adds to the processor time (s) of a run that was stopped and will go on. */
sb_status sb_store_spend(const char *folder, double cpu, sb_error *error);
/* Marks a folder's run as finished, with what is to be remembered of it: commit (of a program from elsewhere the hash
   of its sources, as its log has it), machine, cpu_s (s of
   processor time, all threads, stopped parts too) and load (the machine's mean over the last minute). */
sb_status sb_store_finish(const sb_store *store, const char *folder, double cpu, sb_error *error);

/* Takes away what a former run has left as marks in the folder. */
sb_status sb_store_forget(const char *folder, sb_error *error);
/* Marks a folder's run as failed; its reason, false when it did not fail. */
sb_status sb_store_fail(const char *folder, const char *reason, sb_error *error);
bool sb_store_failed(const sb_store *store, const sb_request *request, char *reason, size_t size);

#endif
