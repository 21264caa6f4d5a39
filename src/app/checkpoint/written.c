#include "app/checkpoint/written.h"

#include <errno.h>
#include <string.h>

sb_status sb_written_sync(const char *directory, const char *name, sb_gone *gone, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_path_join(path, directory, name, error);
    if (status != SB_OK || sb_file_sync(path) == 0) return status;
    if (errno != ENOENT)
        return sb_fail(error, SB_FAILED, "%.500s: cannot be synced to disk: %s", path, strerror(errno));
    if (gone->count++ == 0) memcpy(gone->first, path, sizeof path);
    return SB_OK;
}
