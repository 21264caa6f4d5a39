/* A lock on a directory, so that only one process, `run` or `render`, writes there. */
#ifndef SB_APP_LOCK_H
#define SB_APP_LOCK_H

#include "base/status.h"

/* Locks an existing directory until *lock is closed or the process ends. SB_BAD_INPUT when another process holds the
   lock; `expected` is the part of the message that says what the user may do. *lock is -1 when the directory cannot be
   opened. On a file system without locks, warns and returns SB_OK. */
sb_status sb_lock_directory(const char *directory, const char *expected, int *lock, sb_error *error);

#endif
