/* Files that are either whole or absent, and the few path helpers around them. */
#ifndef SB_BASE_FILE_H
#define SB_BASE_FILE_H

#include "base/status.h"

#include <stdio.h>

#define SB_PATH_MAX 4096

/* A file written beside its final name and renamed when complete. */
typedef struct sb_atomic_file {
    FILE *stream; /* write here; NULL when closed */
    char path[SB_PATH_MAX];
    char temporary[SB_PATH_MAX + 8];
} sb_atomic_file;

/* A file to write, as fopen with mode "w", "a" or "r+" opens it, but never through a symbolic link: what a run writes
   stays in its directory. SB_FAILED names the path and the reason; *stream is then NULL, and errno the system's. */
sb_status sb_file_open(const char *path, const char *mode, FILE **stream, sb_error *error);

/* Opens "<path>.tmp" for writing. SB_FAILED names the path and the system's reason. */
sb_status sb_atomic_open(sb_atomic_file *file, const char *path, sb_error *error);

/* The same for folder/name. */
sb_status sb_atomic_open_in(sb_atomic_file *file, const char *folder, const char *name, sb_error *error);

/* Flushes, syncs (file and folder) when `durable`, closes and renames to the final name; on any failure removes the
   temporary and says why. */
sb_status sb_atomic_commit(sb_atomic_file *file, int durable, sb_error *error);

/* Closes and removes the temporary; fine on a closed file. */
void sb_atomic_abort(sb_atomic_file *file);

/* Puts what the system holds of a file, or of a folder's names, on disk. 0, or -1 with errno. */
int sb_file_sync(const char *path);

/* Makes the directory and all missing parents. */
sb_status sb_make_directories(const char *path, sb_error *error);

/* directory/name into path, and makes the directory and the folders below it that name goes through; SB_FAILED where
   one of those below is a symbolic link or no folder. */
sb_status sb_make_folder(char path[SB_PATH_MAX], const char *directory, const char *name, sb_error *error);

/* Removes the files "<digits><suffix>" of a folder whose number is above `after`, and what was being written when a
   run was killed: "<digits><suffix>.tmp". A missing folder is fine. */
sb_status sb_remove_numbered(const char *folder, const char *suffix, unsigned long long after, sb_error *error);

/* base/name into out; an absolute name stands alone. SB_BAD_INPUT when longer than SB_PATH_MAX. */
sb_status sb_path_join(char out[SB_PATH_MAX], const char *base, const char *name, sb_error *error);

/* The folder part of path ("." when it has none). */
void sb_path_folder(char out[SB_PATH_MAX], const char *path);

/* The whole file as a zero-terminated string of *length bytes, at most `limit`; free with sb_free. Where it cannot be
   read, errno is the system's reason, else 0. */
sb_status sb_file_read(const char *path, size_t limit, char **text, size_t *length, sb_error *error);

/* The same without the byte-order mark that some editors and spreadsheets put before UTF-8. */
sb_status sb_text_read(const char *path, size_t limit, char **text, size_t *length, sb_error *error);

#endif
