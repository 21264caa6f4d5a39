/* What a directory holds that a run would write into: the files of an earlier run, told by name and by how they begin,
   and whatever else is there. */
#ifndef SB_APP_RUN_FILES_H
#define SB_APP_RUN_FILES_H

#include "base/file.h"
#include "scene/scene.h"

#include <stddef.h>

/* The mark of a run's directory is its log, run.jsonl, or its scene.yaml. */
typedef enum sb_run_holds {
    SB_HOLDS_NOTHING,    /* hidden files do not count */
    SB_HOLDS_OTHERS,     /* files, and no mark of a run */
    SB_HOLDS_CLAIM,      /* an empty log: a run that has not begun */
    SB_HOLDS_UNFINISHED, /* a run that did not come to its end */
    SB_HOLDS_FINISHED,
} sb_run_holds;

#define SB_RUN_LOG_START "{\"event\":" /* how run.jsonl begins */

enum { SB_RUN_NAME_MAX = 320 }; /* of a file below the directory, cut to fit */

/* name: the first of the other files, for SB_HOLDS_OTHERS. */
sb_run_holds sb_run_directory_holds(const char *directory, char name[SB_RUN_NAME_MAX]);

typedef struct sb_run_files {
    char **own; /* paths of a run's files, checkpoints first, without the log and scene.yaml */
    size_t count, capacity;
    size_t others; /* files and folders that no run writes */
    char first_other[SB_RUN_NAME_MAX];
    char foreign[SB_RUN_NAME_MAX]; /* the first file where this scene's run would write that no run wrote; "": none */
} sb_run_files;

/* Looks through the directory. SB_FAILED also when something else than a regular file stands where a run writes one,
   or, for a table or the log, a file that has further names. scene: of the run that would write;
   NULL: none, the files are read only. */
sb_status sb_run_files_find(const char *directory, const sb_scene *scene, sb_run_files *files, sb_error *error);

/* The same for the pictures and films of the scene's cameras alone. camera: of one of them; < 0: of all. */
sb_status sb_run_files_find_pictures(const char *directory, const sb_scene *scene, int camera, sb_run_files *files,
                                     sb_error *error);

/* Removes a run's files, and the folders that are empty then. */
sb_status sb_run_files_remove(const char *directory, const sb_run_files *files, sb_error *error);

void sb_run_files_free(sb_run_files *files);

#endif
