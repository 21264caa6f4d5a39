/* The contents of a directory before a run writes into it: the files of an earlier run, which are recognised by their
   name and first bytes, and other files. */
#ifndef SB_APP_RUN_FILES_H
#define SB_APP_RUN_FILES_H

#include "base/file.h"
#include "scene/scene.h"

#include <stddef.h>

/* A run directory is recognised by its log, run.jsonl, or by its scene.yaml. */
typedef enum sb_run_holds {
    SB_HOLDS_NOTHING,    /* hidden files are ignored */
    SB_HOLDS_OTHERS,     /* files, but no log or scene.yaml of a run */
    SB_HOLDS_CLAIM,      /* an empty log: a run that has not begun */
    SB_HOLDS_UNFINISHED, /* a run that did not finish */
    SB_HOLDS_FINISHED,
} sb_run_holds;

#define SB_RUN_LOG_START "{\"event\":" /* the first bytes of run.jsonl */

enum { SB_RUN_NAME_MAX = 320 }; /* a path below the directory, cut to fit */

/* name: for SB_HOLDS_OTHERS, one of the other files. */
sb_run_holds sb_run_directory_holds(const char *directory, char name[SB_RUN_NAME_MAX]);

typedef struct sb_run_files {
    char **own; /* paths of a run's files, checkpoints first, without the log and scene.yaml */
    size_t count, capacity;
    size_t others; /* files and folders that no run writes */
    char first_other[SB_RUN_NAME_MAX];
    char foreign[SB_RUN_NAME_MAX]; /* the first file that this scene's run would overwrite and that no run wrote; "":
                                      none */
} sb_run_files;

/* Lists the files in the directory. SB_FAILED also when something other than a regular file has the name of a file that
   a run writes, or when a table or the log has several names (hard links). scene: the scene of the run that will write;
   NULL: the files are only read. */
sb_status sb_run_files_find(const char *directory, const sb_scene *scene, sb_run_files *files, sb_error *error);

/* Lists only the pictures and films of the scene's cameras. only: by camera, whether to list its; NULL: of all. */
sb_status sb_run_files_find_pictures(const char *directory, const sb_scene *scene, const bool *only,
                                     sb_run_files *files, sb_error *error);

/* Removes a run's files, and folders that are empty afterwards. */
sb_status sb_run_files_remove(const char *directory, const sb_run_files *files, sb_error *error);

void sb_run_files_free(sb_run_files *files);

#endif
