/* A file of lines that grows at its end and hashes what it is given: one that goes on later can tell whether what is
   there is what was written. Inside src/output. */
#ifndef SB_OUTPUT_HASHED_FILE_H
#define SB_OUTPUT_HASHED_FILE_H

#include "base/file.h"
#include "base/hash.h"

/* Must stay where it is while it is open. */
typedef struct sb_hashed_file {
    FILE *stream; /* write here; NULL: closed */
    FILE *file;   /* the file behind it */
    uint64_t length;
    uint64_t whole;       /* up to the end of the last line */
    sb_running_hash hash; /* of what was flushed, as the lengths */
    int failed;           /* errno of the first failure to write, after which nothing is; 0: none */
} sb_hashed_file;

/* From nothing. SB_FAILED names the path and the reason. */
sb_status sb_hashed_open(sb_hashed_file *file, const char *path, sb_error *error);

/* Whether the file begins with so many bytes of this hash. SB_BAD_INPUT says why not. */
sb_status sb_hashed_check(const char *path, uint64_t length, uint64_t hash, sb_error *error);

/* After its first `length` bytes; what comes later goes. */
sb_status sb_hashed_resume(sb_hashed_file *file, const char *path, uint64_t length, sb_error *error);

/* 0, or EOF with errno when something could not be written: then the file ends with its last whole line. Fine on a
   closed file. */
int sb_hashed_close(sb_hashed_file *file);

#endif
