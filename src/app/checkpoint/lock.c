#include "app/checkpoint/lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

/* Tries for two seconds, because a process that is being killed may still hold the lock. */
sb_status sb_lock_directory(const char *directory, const char *expected, int *lock, sb_error *error)
{
    enum { TRIES = 20, PAUSE = 100000 }; /* microseconds between them */
    *lock = open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (*lock < 0) return sb_fail(error, SB_FAILED, "%.500s: cannot open: %s", directory, strerror(errno));
    for (int t = 0; t < TRIES; t++) {
        if (flock(*lock, LOCK_EX | LOCK_NB) == 0) return SB_OK;
        if (errno != EWOULDBLOCK && errno != EINTR) {
            fprintf(stderr,
                    "shorebreak: warning: %.500s: cannot be locked (%s): make sure that no other run writes there\n",
                    directory, strerror(errno));
            return SB_OK;
        }
        usleep(PAUSE);
    }
    return sb_fail(error, SB_BAD_INPUT, "%.500s: another run or render is writing there, expected %s", directory,
                   expected);
}
