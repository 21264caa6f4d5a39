/* Who writes into a directory is alone there: a run, or `shorebreak render`. */
#ifndef SB_APP_LOCK_H
#define SB_APP_LOCK_H

#include "base/status.h"

/* Locks the directory, which exists, until *lock is closed or the process ends, however it does. `expected` is what a
   user may do about SB_BAD_INPUT, which says that another one writes there. *lock is -1 when it cannot be opened.
   Where the file system knows no locks there are none. */
sb_status sb_lock_directory(const char *directory, const char *expected, int *lock, sb_error *error);

#endif
