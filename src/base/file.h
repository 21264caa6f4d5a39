/* Writes files that are either complete or absent, reads files, and handles paths. */
#ifndef SB_BASE_FILE_H
#define SB_BASE_FILE_H

#include "base/status.h"

#include <stdio.h>
#include <sys/types.h>

#define SB_PATH_MAX 4096

/* A file that is written under a temporary name and renamed when it is complete. */
typedef struct sb_atomic_file {
    FILE *stream; /* write here; NULL when closed */
    char path[SB_PATH_MAX];
    char temporary[SB_PATH_MAX + 8];
} sb_atomic_file;

/* Returns the kind of file that a mode stands for, such as "a FIFO"; NULL for a regular file. */
const char *sb_file_kind(mode_t mode);

/* SB_FAILED if the path exists and is not a regular file: a new file would be renamed to it. */
sb_status sb_file_replaceable(const char *path, sb_error *error);

/* Opens a file for writing as fopen does with mode "w", "a" or "r+", but only a regular file with one name. A symbolic
   link or a second hard link is refused, so that a run writes only into its own directory. A FIFO or a device is
   refused because it could block the run. SB_FAILED names the path and the reason; *stream is then NULL, and errno is
   set, EEXIST if another kind of file is there. */
sb_status sb_file_open(const char *path, const char *mode, FILE **stream, sb_error *error);

/* Opens "<path>.tmp" for writing. SB_FAILED names the path and the system's reason. */
sb_status sb_atomic_open(sb_atomic_file *file, const char *path, sb_error *error);

/* The same for folder/name. */
sb_status sb_atomic_open_in(sb_atomic_file *file, const char *folder, const char *name, sb_error *error);

/* Flushes the file, syncs it and its folder if `durable`, closes it and renames it to the final name. On any failure it
   removes the temporary file and names the reason. */
sb_status sb_atomic_commit(sb_atomic_file *file, int durable, sb_error *error);

/* Closes and removes the temporary file. Has no effect on a closed file. */
void sb_atomic_abort(sb_atomic_file *file);

/* Reads the first bytes of a regular file, at most `size`, and returns their number; 0 for any other kind of file. */
size_t sb_file_start(const char *path, char *bytes, size_t size);

/* Flushes the system's cached data of a file, or of a folder's entries, to disk. Returns 0, or -1 with errno. */
int sb_file_sync(const char *path);

/* Makes the directory and all missing parents. SB_BAD_INPUT if one of them exists and is not a directory. */
sb_status sb_make_directories(const char *path, sb_error *error);

/* Writes directory/name to path and makes that directory with all missing parents. SB_FAILED if a component of `name`
   is a symbolic link or not a directory. */
sb_status sb_make_folder(char path[SB_PATH_MAX], const char *directory, const char *name, sb_error *error);

/* Returns whether the name consists of a number above `after`, of at least six digits, and the suffix; or of any such
   number, the suffix and ".tmp", as a killed run leaves it. */
int sb_is_numbered(const char *name, const char *suffix, unsigned long long after);

/* Removes the files of a folder whose names are so numbered. A missing folder is not an error. */
sb_status sb_remove_numbered(const char *folder, const char *suffix, unsigned long long after, sb_error *error);

/* Writes base/name to out, or `name` alone if it is absolute. SB_BAD_INPUT if the result is longer than SB_PATH_MAX. */
sb_status sb_path_join(char out[SB_PATH_MAX], const char *base, const char *name, sb_error *error);

/* Writes the folder part of path to out, "." if it has none. */
void sb_path_folder(char out[SB_PATH_MAX], const char *path);

/* Reads the whole file as a zero-terminated string of *length bytes, at most `limit`. The caller frees it with sb_free.
   If the system cannot read the file, errno is the system's reason; for any other error errno is 0. */
sb_status sb_file_read(const char *path, size_t limit, char **text, size_t *length, sb_error *error);

/* The same, without the byte-order mark that some editors and spreadsheets put before UTF-8. */
sb_status sb_text_read(const char *path, size_t limit, char **text, size_t *length, sb_error *error);

#endif
