/* Syncs the files that a run has written to disk, before a checkpoint relies on them. */
#ifndef SB_APP_WRITTEN_H
#define SB_APP_WRITTEN_H

#include "base/file.h"

#include <stdint.h>

/* Written files that someone removed. They are reported and then ignored. */
typedef struct sb_gone {
    uint64_t count;
    char first[SB_PATH_MAX];
} sb_gone;

/* Syncs directory/name, a file or a folder, to disk, and counts it in `gone` when it no longer exists. SB_FAILED when
   it cannot be synced. */
sb_status sb_written_sync(const char *directory, const char *name, sb_gone *gone, sb_error *error);

#endif
