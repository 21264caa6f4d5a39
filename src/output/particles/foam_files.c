#include "output/particles/foam_files.h"

#include "base/file.h"
#include "output/particles/pvd.h"
#include "output/particles/vtp.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

void sb_foam_file(uint64_t number, char name[SB_FOAM_NAME_MAX])
{
    snprintf(name, SB_FOAM_NAME_MAX, SB_FOAM_FOLDER "/%06" PRIu64 SB_FOAM_ENDING, number);
}

sb_status sb_foam_files_list(const char *directory, const sb_particle_list *particles, sb_error *error)
{
    char path[SB_PATH_MAX], name[SB_FOAM_NAME_MAX];
    sb_particle_list list = {0};
    sb_status status = sb_path_join(path, directory, SB_FOAM_LIST ".pvd", error);
    for (size_t i = 0; i < particles->count && status == SB_OK; i++) {
        sb_foam_file(i + 1, name);
        status = sb_particle_list_add(&list, particles->entries[i].time, name, strlen(name), error);
    }
    if (status == SB_OK) status = sb_pvd_write(path, &list, error);
    sb_particle_list_free(&list);
    return status;
}

sb_status sb_foam_files_open(const char *directory, const sb_particle_list *particles, uint64_t count, sb_error *error)
{
    char folder[SB_PATH_MAX], list[SB_PATH_MAX];
    sb_status status = sb_make_folder(folder, directory, SB_FOAM_FOLDER, error);
    /* The list comes first, so that it never names a file that does not exist. */
    if (status == SB_OK && count > 0) status = sb_foam_files_list(directory, particles, error);
    if (status == SB_OK && count == 0) {
        status = sb_path_join(list, directory, SB_FOAM_LIST ".pvd", error);
        if (status == SB_OK && unlink(list) != 0 && errno != ENOENT)
            status = sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", list, strerror(errno));
    }
    return status == SB_OK ? sb_remove_numbered(folder, SB_FOAM_ENDING, count, error) : status;
}

sb_status sb_foam_files_write(const char *directory, const sb_frame *frame, uint64_t number, sb_error *error)
{
    char path[SB_PATH_MAX], name[SB_FOAM_NAME_MAX];
    sb_foam_file(number, name);
    sb_status status = sb_path_join(path, directory, name, error);
    return status == SB_OK ? sb_vtp_write_foam(path, frame, error) : status;
}

sb_status sb_foam_files_read(const char *directory, uint64_t number, sb_frame *frame, sb_error *error)
{
    char path[SB_PATH_MAX], name[SB_FOAM_NAME_MAX];
    sb_foam_file(number, name);
    sb_status status = sb_path_join(path, directory, name, error);
    if (status == SB_OK && access(path, F_OK) != 0 && errno == ENOENT)
        return sb_fail(
            error, SB_BAD_INPUT,
            "%.500s: does not exist, but the scene has foam; expected the files of a run with foam, or --set "
            "foam.enabled=false",
            path);
    return status == SB_OK ? sb_vtp_read_foam(path, frame, error) : status;
}
