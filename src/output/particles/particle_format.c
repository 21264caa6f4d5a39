#include "output/particles/particle_format.h"

#include "base/file.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <unistd.h>

/* To add a format, define sb_particles_<name> in a file of its own and add one ROW here. */
#define ROWS(ROW) ROW(vtp) ROW(pvtp)

#define DECLARE(name) extern const sb_particle_format sb_particles_##name;
#define POINT(name) &sb_particles_##name,

ROWS(DECLARE)

const sb_particle_format *const sb_particle_formats[] = {ROWS(POINT) NULL};

const sb_particle_format *sb_particle_format_in(const char *folder)
{
    char name[SB_PARTICLE_NAME_MAX], path[SB_PATH_MAX];
    for (const sb_particle_format *const *row = sb_particle_formats; *row; row++)
        if (sb_particle_format_list(*row, name) && sb_path_join(path, folder, name, NULL) == SB_OK &&
            access(path, F_OK) == 0)
            return *row;
    return sb_particle_formats[0];
}

void sb_particle_format_file(const sb_particle_format *format, uint64_t number, char name[SB_PARTICLE_NAME_MAX])
{
    if (number == 0)
        snprintf(name, SB_PARTICLE_NAME_MAX, SB_PARTICLE_FOLDER "/" SB_PARTICLE_LAST_GOOD "%s", format->ending);
    else
        snprintf(name, SB_PARTICLE_NAME_MAX, SB_PARTICLE_FOLDER "/%06" PRIu64 "%s", number, format->ending);
}

bool sb_particle_format_list(const sb_particle_format *format, char name[SB_PARTICLE_NAME_MAX])
{
    if (format->list_ending) snprintf(name, SB_PARTICLE_NAME_MAX, SB_PARTICLE_LIST "%s", format->list_ending);
    return format->list_ending;
}

sb_status sb_particle_format_read_list(const sb_particle_format *format, const char *folder, sb_particle_list *list,
                                       sb_error *error)
{
    char name[SB_PARTICLE_NAME_MAX], path[SB_PATH_MAX];
    if (!format->read || !sb_particle_format_list(format, name))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: has no particle files that can be read; those of the format %s cannot", folder,
                       format->name);
    sb_status status = sb_path_join(path, folder, name, error);
    if (status == SB_OK && access(path, F_OK) != 0 && errno == ENOENT)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: the run has no particle files; expected one with output.particle_interval", folder);
    return status == SB_OK ? format->read_list(path, list, error) : status;
}
