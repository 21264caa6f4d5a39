#include "surface/mesh_format.h"

#include "base/file.h"

#include <assert.h>
#include <string.h>
#include <sys/stat.h>

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files are little-endian");

const sb_mesh_format *const sb_mesh_formats[] = {&sb_mesh_ply, &sb_mesh_vtp, NULL};

sb_status sb_mesh_write(const sb_mesh_format *format, const char *path, const sb_water_mesh *mesh, double time,
                        const char *made, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    fprintf(file.stream, "%s%s%s", format->before, made, format->after);
    format->write(file.stream, mesh, time);
    return sb_atomic_commit(&file, 0, error);
}

sb_mesh_there sb_mesh_look(const sb_mesh_format *format, const char *path, const char *made)
{
    char bytes[512], start[512];
    struct stat found;
    if (lstat(path, &found) != 0) return SB_MESH_NONE;
    const size_t got = sb_file_start(path, bytes, sizeof bytes);
    snprintf(start, sizeof start, "%s%s%s", format->before, made, format->after);
    if (got >= strlen(start) && memcmp(bytes, start, strlen(start)) == 0) return SB_MESH_SAME;
    snprintf(start, sizeof start, "%s%s", format->before, SB_MESH_MADE);
    return got >= strlen(start) && memcmp(bytes, start, strlen(start)) == 0 ? SB_MESH_DIFFERENT : SB_MESH_FOREIGN;
}
