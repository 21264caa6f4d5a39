/* Files that are either whole or absent, and the few path helpers around them. */
#ifndef SB_BASE_FILE_H
#define SB_BASE_FILE_H

#include "base/status.h"

#include <stdio.h>
#include <sys/types.h>

#define SB_PATH_MAX 4096

/* A file written beside its final name and renamed when complete. */
typedef struct sb_atomic_file {
    FILE *stream; /* write here; NULL when closed */
    char path[SB_PATH_MAX];
    char temporary[SB_PATH_MAX + 8];
} sb_atomic_file;

/* What stands at a path, by its mode, as "a FIFO"; NULL: a regular file. */
const char *sb_file_kind(mode_t mode);

/* SB_FAILED where something else than a regular file stands at the path: what is written there is renamed to it. */
sb_status sb_file_replaceable(const char *path, sb_error *error);

/* A file to write, as fopen with mode "w", "a" or "r+" opens it, but regular files of one name only: never through a
   symbolic link or another name, for what a run writes stays in its directory; never a FIFO or a device, which could
   keep it waiting. SB_FAILED names the path and the reason; *stream is then NULL, and errno the system's, or EEXIST for
   what stands there. */
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

/* The first bytes of a regular file, as many as there are; none of anything else. */
size_t sb_file_start(const char *path, char *bytes, size_t size);

/* Puts what the system holds of a file, or of a folder's names, on disk. 0, or -1 with errno. */
int sb_file_sync(const char *path);

/* Makes the directory and all missing parents. SB_BAD_INPUT when one of them is there and is no directory. */
sb_status sb_make_directories(const char *path, sb_error *error);

/* directory/name into path, and makes the directory and the folders below it that name goes through; SB_FAILED where
   one of those below is a symbolic link or no folder. */
sb_status sb_make_folder(char path[SB_PATH_MAX], const char *directory, const char *name, sb_error *error);

/* Whether the name is a number above `after`, of six digits at least, and the suffix; or that of any number and
   ".tmp", which was being written. */
int sb_is_numbered(const char *name, const char *suffix, unsigned long long after);

/* Removes the files of a folder that are so named. A missing folder is fine. */
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
