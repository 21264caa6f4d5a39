/* Files that a run has written, put on disk before a checkpoint relies on them. */
#ifndef SB_APP_WRITTEN_H
#define SB_APP_WRITTEN_H

#include "base/file.h"

#include <stdint.h>

/* Those that someone took away before: they are no longer the run's concern. */
typedef struct sb_gone {
    uint64_t count;
    char first[SB_PATH_MAX];
} sb_gone;

/* Puts directory/name, a file or the names of a folder, on disk; notes one that is not there any more. SB_FAILED when
   the disk refuses. */
sb_status sb_written_sync(const char *directory, const char *name, sb_gone *gone, sb_error *error);

#endif
