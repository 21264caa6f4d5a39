/* A text file to which lines are appended, with a running hash of its content. A run that continues the file later can
   check that it is unchanged. Private to src/output. */
#ifndef SB_OUTPUT_HASHED_FILE_H
#define SB_OUTPUT_HASHED_FILE_H

#include "base/file.h"
#include "base/hash.h"

/* Must not be moved in memory while it is open. */
typedef struct sb_hashed_file {
    FILE *stream; /* to write to; NULL: closed */
    FILE *file;   /* the underlying file */
    uint64_t length;
    uint64_t complete;    /* length up to the end of the last complete line */
    sb_running_hash hash; /* of what was flushed, like the lengths */
    int failed;           /* errno of the first write error, after which nothing is written; 0: none */
} sb_hashed_file;

/* Creates the file. SB_FAILED names the path and the reason. */
sb_status sb_hashed_open(sb_hashed_file *file, const char *path, sb_error *error);

/* Checks that the file's first `length` bytes have this hash. SB_BAD_INPUT says why not. */
sb_status sb_hashed_check(const char *path, uint64_t length, uint64_t hash, sb_error *error);

/* Opens the file to continue after its first `length` bytes; the rest is removed. */
sb_status sb_hashed_resume(sb_hashed_file *file, const char *path, uint64_t length, sb_error *error);

/* Returns 0, or EOF with errno if something could not be written; the file then ends with its last complete line.
   Allowed on a closed file. */
int sb_hashed_close(sb_hashed_file *file);

#endif
