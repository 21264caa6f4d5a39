/* Opens regular files for reading. */
#include "base/input.h"

#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static sb_status unreadable(const char *path, int reason, sb_error *error)
{
    sb_fail(error, SB_BAD_INPUT, "%.500s: cannot read: %s", path, strerror(reason));
    errno = reason;
    return SB_BAD_INPUT;
}

static sb_status irregular(const char *path, mode_t mode, sb_error *error)
{
    sb_fail(error, SB_BAD_INPUT, "%.500s: is %s, expected a regular file", path, sb_file_kind(mode));
    errno = 0;
    return SB_BAD_INPUT;
}

sb_status sb_input_descriptor(const char *path, int *file, sb_error *error)
{
    struct stat found;
    *file = -1;
    /* The kind is checked first, because opening a device may have an effect by itself. */
    if (stat(path, &found) != 0) return unreadable(path, errno, error);
    if (!S_ISREG(found.st_mode)) return irregular(path, found.st_mode, error);
    /* Another file may have taken its place, so the open must not block, and the kind is checked again. */
    const int opened = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (opened < 0) return unreadable(path, errno, error);
    const int reason = fstat(opened, &found) == 0 ? 0 : errno;
    if (reason == 0 && S_ISREG(found.st_mode)) {
        *file = opened;
        return SB_OK;
    }
    close(opened);
    return reason ? unreadable(path, reason, error) : irregular(path, found.st_mode, error);
}

sb_status sb_input_open(const char *path, FILE **stream, sb_error *error)
{
    int file;
    *stream = NULL;
    sb_status status = sb_input_descriptor(path, &file, error);
    if (status != SB_OK) return status;
    *stream = fdopen(file, "rb");
    if (*stream) return SB_OK;
    const int reason = errno;
    close(file);
    return unreadable(path, reason, error);
}
