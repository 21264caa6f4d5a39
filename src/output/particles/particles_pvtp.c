/* The format of particle files in pieces, one of each rank. */
#include "output/particles/particle_format.h"
#include "output/particles/pvd.h"
#include "output/particles/pvtp.h"

static sb_status write_one(const char *path, const sb_frame *frame, uint64_t number, sb_error *error)
{
    return sb_pvtp_write(path, frame, number, 1, error);
}

const sb_particle_format sb_particles_pvtp = {
    .name = "pvtp",
    .summary = "a file of each rank, listed in one .pvtp per time and in particles-pieces.pvd, for ParaView",
    .ending = ".pvtp",
    .start = "<?xml",
    .write = write_one,
    .read = sb_pvtp_read,
    .list_ending = "-pieces.pvd",
    .list_start = "<?xml",
    .write_list = sb_pvd_write,
    .read_list = sb_pvd_read,
};
