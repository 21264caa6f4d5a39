/* The format of particle files for ParaView. */
#include "output/particles/particle_format.h"
#include "output/particles/pvd.h"
#include "output/particles/vtp.h"

const sb_particle_format sb_particles_vtp = {
    .name = "vtp",
    .summary = "VTK PolyData with binary values, listed in particles.pvd, for ParaView",
    .ending = ".vtp",
    .start = "<?xml",
    .write = sb_vtp_write,
    .read = sb_vtp_read,
    .list_ending = ".pvd",
    .list_start = "<?xml",
    .write_list = sb_pvd_write,
    .read_list = sb_pvd_read,
};
